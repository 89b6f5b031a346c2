#include <app/command.h>

namespace mobbscope::app {

std::span<const Command> query_commands() { return {}; }

}  // namespace mobbscope::app
