/// How bad it is what the window tells.
#pragma once

namespace mobbscope::app {

enum class MessageLevel { info, warning, error };

}  // namespace mobbscope::app
