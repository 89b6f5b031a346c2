#include <app/document/node_figures.h>

#include <utility>

namespace mobbscope::app {

const std::shared_ptr<SceneFigures>& NodeFigures::known() {
    const Workspace& now = workspace_;
    const auto& costs = now.derived().costs;
    std::shared_ptr<const BlameInScene> blame = now.blame() ? now.counted_blame : nullptr;
    figures_->take(now.document().fitted, costs ? &*costs : nullptr, std::move(blame));
    return figures_;
}

std::span<const double> NodeFigures::column(int clip, NodeField field) {
    return known()->of(workspace_.document().fitted, clip, field).column(field);
}

}  // namespace mobbscope::app
