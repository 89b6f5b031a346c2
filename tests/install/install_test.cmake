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

# What a program captures. It must write these files, and say so or crash; the program says the rest of the last one.
function(capture program options files expected_output expected_status expected_words)
  file(REMOVE_RECURSE ${SCRATCH}/run)
  file(MAKE_DIRECTORY ${SCRATCH}/run)
  execute_process(COMMAND ${SCRATCH}/${program} ${options} WORKING_DIRECTORY ${SCRATCH}/run
    OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  file(GLOB written RELATIVE ${SCRATCH}/run ${SCRATCH}/run/*)
  if(NOT output MATCHES "${expected_output}" OR NOT written STREQUAL files)
    message(FATAL_ERROR "${program} ${options} wrote ${written} and said: ${output}${errors}")
  endif()
  if(PROGRAM)
    list(GET files -1 file)
    execute_process(COMMAND ${PROGRAM} query ${SCRATCH}/run/${file} --check RESULT_VARIABLE status
      OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT status EQUAL expected_status OR NOT output MATCHES "${expected_words}")
      message(FATAL_ERROR "${program} ${options}: query ${file} --check exits with ${status}: ${output}")
    endif()
  endif()
endfunction()
capture(consumer/capture "" "last.json;missed.json" "they miss" 0 "1 answer.*all agree")

# examples/, against the library and against one with a fault: boxes that are turned against each other are taken for
# smaller.
function(build_example name prefix)
  file(REMOVE_RECURSE ${SCRATCH}/${name})
  run(${CMAKE_COMMAND} -S ${SOURCE}/examples -B ${SCRATCH}/${name} -G ${GENERATOR} -D CMAKE_BUILD_TYPE=${TYPE}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${prefix})
  run(${CMAKE_COMMAND} --build ${SCRATCH}/${name})
endfunction()
build_example(example ${SCRATCH}/prefix)
capture(example/crowd "" last.json "every answer is right" 0 "64 answers.*all agree")
capture(example/crowd --crash crash.json "^$" 0 "64 answers.*all agree")
capture(example/crowd --fault wrong.json "an answer is wrong" 1 "expected no collision, but A0 and B0 collide.*; [0-9]+ events agree with the stored trace")

file(REMOVE_RECURSE ${SCRATCH}/faulty)
file(COPY ${SCRATCH}/prefix/ DESTINATION ${SCRATCH}/faulty)
set(header ${SCRATCH}/faulty/include/mobb/separation.h)
file(READ ${header} right)
string(REPLACE " + half_b[1] * sc" "" wrong "${right}")
if(wrong STREQUAL right)
  message(FATAL_ERROR "separation.h has not what becomes the fault")
endif()
file(WRITE ${header} "${wrong}")
build_example(faulty_example ${SCRATCH}/faulty)
capture(faulty_example/crowd "" wrong.json "an answer is wrong" 1 "expected .*; the traces differ at step [0-9]+ in")
