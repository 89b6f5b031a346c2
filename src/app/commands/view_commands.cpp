#include <app/command.h>

namespace mobbscope::app {

std::span<const Command> view_commands() { return {}; }

}  // namespace mobbscope::app
