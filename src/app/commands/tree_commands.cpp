#include <app/command.h>

namespace mobbscope::app {

std::span<const Command> tree_commands() { return {}; }

}  // namespace mobbscope::app
