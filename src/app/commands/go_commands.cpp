#include <app/command.h>

namespace mobbscope::app {

std::span<const Command> go_commands() { return {}; }

}  // namespace mobbscope::app
