# mobbscope_room(NAME): the library mobbscope_NAME of every source in this folder and those below it.
function(mobbscope_room name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_main\\.cpp$")
  add_library(mobbscope_${name} STATIC ${sources})
endfunction()
