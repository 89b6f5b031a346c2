# cmake -D NAME=... -D PROGRAM=... -D RUNNER=... -D TIMES=... -D OUT=... -P list_suites.cmake: writes for CTest one test a
# suite of a GoogleTest program, "NAME.Suite". TIMES: "Suite=seconds ..." of those that take long, as CTest starts these first.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${listed}")
set(tests "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ]+)\\.( |$)")
    set(suite ${CMAKE_MATCH_1})
    string(APPEND tests "add_test([=[${NAME}.${suite}]=] \"${RUNNER}\" \"${PROGRAM}\" [=[${suite}]=])\n"
      "set_tests_properties([=[${NAME}.${suite}]=] PROPERTIES TIMEOUT 1200 SKIP_RETURN_CODE 77")
    if(TIMES MATCHES "(^| )${suite}=([0-9]+)")
      string(APPEND tests " COST ${CMAKE_MATCH_2}")
    endif()
    string(APPEND tests ")\n")
  endif()
endforeach()
file(WRITE ${OUT} "${tests}")
