# Writes OUT, the record of the build: the commit of the source tree SOURCE, whether its files differ from it, and the
# hash of PROGRAM with the shaders it reads at run time, so that it can tell later whether they are still the same.
set(git git --no-optional-locks -C ${SOURCE})
execute_process(COMMAND ${git} rev-parse HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND ${git} status --porcelain --untracked-files=no OUTPUT_VARIABLE changed ERROR_QUIET)
execute_process(COMMAND ${git} ls-files --others --exclude-standard core variants groundtruth metrics experiments
  OUTPUT_VARIABLE untracked ERROR_QUIET)
set(is_dirty false)
if(NOT "${changed}${untracked}" STREQUAL "")
  set(is_dirty true)
endif()
execute_process(COMMAND ${PROGRAM} --version OUTPUT_VARIABLE build_info COMMAND_ERROR_IS_FATAL ANY)
string(JSON code GET "${build_info}" code)
file(WRITE ${OUT} "{\"commit\": \"${commit}\", \"dirty\": ${is_dirty}, \"code\": \"${code}\"}\n")
