#include <app/document/node_figures.h>

#include <utility>

namespace mobbscope::app {

const std::shared_ptr<SceneFigures>& NodeFigures::known() {
    const Workspace& now = workspace_;
    const auto take = [&](const std::shared_ptr<const FittedScene>& fitted) {
        figures_->take(fitted, now.counted(*fitted), now.blame(*fitted));
    };
    take(now.document().fitted);
    for (const SceneView& other : now.document().beside) take(other.fitted);
    return figures_;
}

std::span<const double> NodeFigures::column(int clip, NodeField field) {
    return known()->of(workspace_.document().fitted, clip, field).column(field);
}

const std::shared_ptr<const ColoredValues>& NodeFigures::boxes() const {
    static const std::shared_ptr<const ColoredValues> none;
    const std::size_t active = workspace_.document().place;
    return active < shown_.size() ? shown_[active] : none;
}

bool NodeFigures::show(std::size_t place, const std::shared_ptr<const ColoredValues>& boxes) {
    shown_.resize(workspace_.document().beside.size() + 1);
    return place < shown_.size() && std::exchange(shown_[place], boxes) != boxes;
}

std::vector<std::shared_ptr<const std::vector<double>>> NodeFigures::beside(std::size_t place,
                                                                            const ColoredFigure& figure) const {
    std::vector<std::shared_ptr<const std::vector<double>>> out;
    if (!workspace_.document().links.level) return out;
    for (std::size_t i = 0; i < shown_.size(); ++i) {
        if (i != place && i <= workspace_.document().beside.size() && shown_[i] && shown_[i]->scale.figure == figure)
            out.push_back(shown_[i]->range);
    }
    return out;
}

}  // namespace mobbscope::app
