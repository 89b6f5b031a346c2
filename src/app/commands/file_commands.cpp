#include <app/command.h>

namespace mobbscope::app {

std::span<const Command> file_commands() { return {}; }

}  // namespace mobbscope::app
