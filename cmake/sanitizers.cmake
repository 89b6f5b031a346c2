# MOBBSCOPE_SANITIZE reaches every target, ours and generated: a mix reports faults that are none.
if(MOBBSCOPE_SANITIZE)
  # Null and what lies beyond an object AddressSanitizer sees too; a fifth of the time to compile goes into looking twice.
  add_compile_options(-fsanitize=${MOBBSCOPE_SANITIZE} -fno-sanitize=null,object-size -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${MOBBSCOPE_SANITIZE})
  # C libraries that are opened at run time know no types of ours.
  add_compile_options($<$<CXX_COMPILER_ID:Clang>:-fno-sanitize=function>)
  add_compile_definitions(MOBBSCOPE_SANITIZED)  # for tests of signals and of memory, which sanitizers change
endif()
if(MOBBSCOPE_SANITIZE MATCHES "thread")
  include_directories(BEFORE ${CMAKE_CURRENT_LIST_DIR}/thread_sanitizer)
endif()
