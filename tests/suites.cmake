# add_suites(program folder): one test of ctest per suite of a test program, named after it and run from `folder`. Read
# by ctest when it runs, after the program is built. The tests of a suite share a process, for each process pays again
# for the driver, the validation layer, the compiling of shaders and tables: 0.2 s and more, most of what a small test
# costs. One test alone: PROGRAM --gtest_filter=SUITE.TEST, with SSRLAB_VALIDATE=1.
function(add_suites program folder)
  set(slow_suites StudyTest CommandLine NoiseCoverage TracersTest StabilityTest ExactTracers SeedDependence CompiledShaders
    estimator EstimatesOfSamples FrostbiteEstimators FourModeTest FrostbiteTruth ShaderWorkTest Faults ExternalImagesTest
    GpuEstimates Registry DiligentTechnique Needs ExportedShaders)
  get_filename_component(name ${program} NAME)
  if(NOT EXISTS ${program})
    add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)
    return()
  endif()
  execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "[][;]" "," listing "\n${listing}")  # characters of types and values that mean lists here
  string(REGEX MATCHALL "\n[^ \n]+\\.[^\n]*(\n  [^\n]+)+" suites "${listing}")
  foreach(lines IN LISTS suites)
    string(REGEX MATCH "[^ \n]+\\." suite "${lines}")
    string(REGEX MATCHALL "\n  " tests "${lines}")
    list(LENGTH tests count)
    string(REGEX REPLACE "\\.$" "" test "${suite}")
    add_test(${test} ${program} --gtest_filter=${suite}*)
    # The longest suites start first, so that none of them runs on alone in the end: those above 10 s by name, as
    # tests/run.sh reports, the others by how many tests they have.
    list(FIND slow_suites ${test} place)
    if(place GREATER -1)
      math(EXPR count "1000 - ${place}")
    endif()
    set_tests_properties(${test} PROPERTIES WORKING_DIRECTORY ${folder} TIMEOUT 600 COST ${count}
      ENVIRONMENT "SSRLAB_VALIDATE=1")
    # What every technique and tracer must keep, over the tables of both: ctest -L contract.
    if(test MATCHES "^(Registry|TracersTest|TracersInRoom|TracersInWebgl2|Webgl2Technique|SeedDependence|ExactTracers)$")
      set_tests_properties(${test} PROPERTIES LABELS contract)
    endif()
    if(test STREQUAL "Clock")  # what measures time runs alone
      set_tests_properties(${test} PROPERTIES RUN_SERIAL TRUE COST 10000)  # and first, when nothing else runs
    endif()
  endforeach()
endfunction()
