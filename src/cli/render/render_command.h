/// `render --list-backends`: what this machine can draw with.
#pragma once

namespace mobbscope::cli {

/// On standard output, in words or as JSON. Throws MachineError if none works.
void list_backends(bool json);

}  // namespace mobbscope::cli
