#include <crowd/graph_walk.h>
#include <crowd/move_set.h>

namespace mobbscope {

MoveSet::MoveSet(const FittedScene& fitted) : fitted_(&fitted), by_hub_(moves_by_hub(graph())) {
    outlines_.reserve(fitted.scene().clips.size());
    for (const SceneClip& clip : fitted.scene().clips) outlines_.emplace_back(*clip.clip);
}

mobb::Placement MoveSet::following(int before, const mobb::Placement& placed, int next, double turn_deg) const {
    Stance exit = move(before).exit;
    exit.heading_deg += turn_deg;
    return mobbscope::following(placed, exit, duration(before), move(next).entry);
}

}  // namespace mobbscope
