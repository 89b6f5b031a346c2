# Builds and installs the core without the program, then configures, builds and runs a consumer in a clean folder. The
# core needs no GoogleTest and no C compiler.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH}/prefix ${SCRATCH}/consumer)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/library -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
  -D CMAKE_BUILD_TYPE=${TYPE} -D MOBBSCOPE_PROGRAM=OFF -D CMAKE_INSTALL_PREFIX=${SCRATCH}/prefix
  -D CMAKE_DISABLE_FIND_PACKAGE_GTest=ON -D CMAKE_C_COMPILER=${SCRATCH}/none)
run(${CMAKE_COMMAND} --build ${SCRATCH}/library)
run(${CMAKE_COMMAND} --install ${SCRATCH}/library)
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/install/consumer -B ${SCRATCH}/consumer -G ${GENERATOR}
  -D CMAKE_BUILD_TYPE=${TYPE} -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${SCRATCH}/prefix)
run(${CMAKE_COMMAND} --build ${SCRATCH}/consumer)
run(${SCRATCH}/consumer/consumer)
if(NOT output MATCHES "they meet at 2.5 s")
  message(FATAL_ERROR "unexpected output: ${output}")
endif()
run(${SCRATCH}/consumer/blocks)
if(NOT output STREQUAL "they meet at 2.5 s\n")
  message(FATAL_ERROR "unexpected output: ${output}")
endif()
run(${SCRATCH}/consumer/engine ${SCRATCH}/consumer/plugin.so)
if(NOT output STREQUAL "the first that meets: 2\n")
  message(FATAL_ERROR "unexpected output: ${output}")
endif()
