# Every target of ours links mobbscope_warnings privately; third-party headers come in as SYSTEM.
add_library(mobbscope_warnings INTERFACE)
target_compile_options(mobbscope_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${MOBBSCOPE_WERROR}>:-Werror>)
