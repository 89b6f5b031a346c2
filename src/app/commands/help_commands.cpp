#include <app/command.h>

namespace mobbscope::app {

std::span<const Command> help_commands() { return {}; }

}  // namespace mobbscope::app
