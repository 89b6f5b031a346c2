#include <app/command.h>

namespace mobbscope::app {

std::span<const Command> edit_commands() { return {}; }

}  // namespace mobbscope::app
