# Writes OUT, one source that is all SOURCES: first what they include, and then each in a namespace named after it, in which
# its includes do nothing any more. So tests can name their helpers alike. All of it is local to the unit, as it would be to
# the source.
set(includes "")
set(bodies "")
foreach(source ${SOURCES})
  file(STRINGS ${source} lines REGEX "^#include")
  list(APPEND includes ${lines})
  get_filename_component(name ${source} NAME_WE)
  file(RELATIVE_PATH inside ${ROOT} ${source})
  string(APPEND bodies "namespace {\nnamespace ${name} {\n#include \"${inside}\"\n}\n}\n")
endforeach()
list(REMOVE_DUPLICATES includes)
list(JOIN includes "\n" includes)
file(WRITE ${OUT} "${includes}\n\n${bodies}")
