# Writes OUT: the commit of the source tree, and whether its files differ from it.
execute_process(COMMAND git -C ${SOURCE} rev-parse HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
set(is_dirty false)
if(NOT "${changes}" STREQUAL "")
  set(is_dirty true)
endif()
file(WRITE ${OUT} "{\"commit\": \"${commit}\", \"dirty\": ${is_dirty}}\n")
