#include <app/document/measuring.h>
#include <app/document/workspace.h>
#include <scene/arrangement.h>

namespace mobbscope::app {

bool can_measure(const Workspace& workspace) {
    return !workspace.empty() && !workspace.view().projection && !is_in_grid(workspace.scene(), workspace.view());
}

std::optional<MeasuredLine> measured_in_view(const Workspace& workspace) {
    return can_measure(workspace) ? workspace.measuring.line() : std::nullopt;
}

}  // namespace mobbscope::app
