#include <app/document/node_figures.h>

#include <optional>
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

bool NodeFigures::are_colored_now() const {
    if (revision_ != figures_->revision() || linked_ != workspace_.document().links.level) return false;
    if (colored_.size() != views_.count()) return false;
    for (std::size_t i = 0; i < colored_.size(); ++i) {
        if (colored_[i].fitted != views_.fitted(i) || !are_colored_alike(colored_[i].view, views_.view(i)))
            return false;
    }
    return true;
}

const std::shared_ptr<const BoxColors>& NodeFigures::boxes(std::size_t place) {
    known();
    if (are_colored_now()) return colored_[place].boxes;
    std::vector<Colored> now;
    std::vector<std::optional<BoxColors>> found;
    for (std::size_t i = 0; i < views_.count(); ++i) {
        now.push_back({views_.fitted(i), views_.view(i)});
        found.push_back(box_colors(*figures_, now[i].fitted, now[i].view));
    }
    std::vector<BoxColors*> beside;
    for (auto& one : found) beside.push_back(one ? &*one : nullptr);
    revision_ = figures_->revision();
    linked_ = workspace_.document().links.level;
    if (linked_) share_scale(beside);
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i]) now[i].boxes = std::make_shared<const BoxColors>(std::move(*found[i]));
    }
    colored_ = std::move(now);
    return colored_[place].boxes;
}

}  // namespace mobbscope::app
