# mobbscope_room(NAME [HOT]): the library mobbscope_NAME of every source in this folder and those below it. HOT: its loops are
# what people wait for, so that a Release build optimises it fully whatever the preset says. To optimise the others under
# sanitizers takes longer than their tests gain.
function(mobbscope_room name)
  cmake_parse_arguments(arg "HOT" "" "" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_main\\.cpp$")
  add_library(mobbscope_${name} STATIC ${sources})
  if(arg_HOT)
    target_compile_options(mobbscope_${name} PRIVATE $<$<CONFIG:Release>:-O3>)
    mobbscope_precompile(mobbscope_${name} mobbscope_base)
  else()
    mobbscope_loops_little(mobbscope_${name})
  endif()
endfunction()

function(mobbscope_loops_little target)
  if(MOBBSCOPE_SANITIZE AND CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE -O0)
  endif()
  mobbscope_precompile(${target} mobbscope_scene)
endfunction()

# mobbscope_precompile(TARGET OWNER [HEADER...]): what most sources include is parsed once, with OWNER, for all targets that are
# optimised alike: GCC 12 takes the level from the precompiled header, whatever the command line says. Only where sources
# are compiled together: elsewhere a missing include is to be seen.
set(often_included
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <optional> <set> <span>
  <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>
  <glm/common.hpp> <glm/geometric.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <nlohmann/json.hpp>)
function(mobbscope_precompile target owner)
  if(NOT CMAKE_UNITY_BUILD)
    return()
  endif()
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${often_included} ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# A unit of many sources takes memory, not time, if GCC tidies up seldom.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:--param ggc-min-heapsize=500000>")
endif()
