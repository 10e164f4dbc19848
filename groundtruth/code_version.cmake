# Writes OUT, a header with the hash of all that the numbers of a reference depend on when the path tracer is compiled, so
# that a changed one never takes over references of an older one: of every source below ROOT that the path tracer and the
# scene code consist of, and of BUILD (compiler, its flags). The sources are not listed: they are those of both folders,
# with what they include and the sources of those headers. SOURCES, if given, is a file that gets their names.
cmake_minimum_required(VERSION 3.25)
file(GLOB todo RELATIVE ${ROOT} ${ROOT}/groundtruth/*/*.h ${ROOT}/groundtruth/*/*.cpp ${ROOT}/core/scene/*.h
  ${ROOT}/core/scene/*.cpp ${ROOT}/core/scene/*/*.h ${ROOT}/core/scene/*/*.cpp)
set(sources "")
while(todo)
  list(POP_FRONT todo source)
  if(source IN_LIST sources OR NOT EXISTS ${ROOT}/${source})  # not ours, or generated
    continue()
  endif()
  list(APPEND sources ${source})
  file(STRINGS ${ROOT}/${source} lines REGEX "^#include \"[^\"]+\"")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
    list(APPEND todo ${included})
  endforeach()
  if(source MATCHES "[.]h$")
    string(REGEX REPLACE "[.]h$" ".cpp" implementation ${source})
    list(APPEND todo ${implementation})
  endif()
endwhile()
list(SORT sources)
set(hashes "${BUILD}\n")
foreach(source IN LISTS sources)
  file(SHA256 ${ROOT}/${source} hash)
  string(APPEND hashes "${source} ${hash}\n")
endforeach()
string(SHA256 version "${hashes}")
string(SUBSTRING ${version} 0 16 version)
file(CONFIGURE OUTPUT ${OUT} @ONLY
  CONTENT "#pragma once\n#include <string_view>\ninline constexpr std::string_view code_version = \"@version@\";\n")
if(SOURCES)
  list(JOIN sources "\n" sources)
  file(WRITE ${SOURCES} "${sources}\n")
endif()
