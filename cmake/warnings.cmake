# Every target of ours links mobbscope_warnings privately; third-party headers come in as SYSTEM.
add_library(mobbscope_warnings INTERFACE)
target_compile_options(mobbscope_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual
  -Werror=switch  # a kind without a row is an error wherever this is built
  $<$<BOOL:${MOBBSCOPE_WERROR}>:-Werror>)
# GCC 12 sees overlapping, endless and misplaced copies in its own std::string at -O3 (its bugs 105651, 105329 and 105762).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(mobbscope_warnings INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
endif()
# In a unity build GCC takes the sources for headers, whose types ought not to use anonymous namespaces.
if(CMAKE_UNITY_BUILD)
  target_compile_options(mobbscope_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
