#include <app/session/what_if_inspector.h>

#include <algorithm>
#include <array>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr const char* kTrying = "Trying others in place of a node";  // the job is known by it

}  // namespace

std::shared_ptr<const mobb::Tree> WhatIfInspector::tree() const {
    const Selection& selection = workspace_.selection;
    if (selection.kind != Selection::Kind::node) return nullptr;
    const auto who = placed_agent_of(workspace_.fitted(), selection.path);
    return who ? workspace_.fitted().shared_tree(who->clip) : nullptr;
}

std::string_view WhatIfInspector::why_not() const {
    const auto of = tree();
    if (!of) return "no node is selected";
    return of->blocks() ? "all blocks are built alike" : "";
}

void WhatIfInspector::measure() {
    // One for another node could end after this one.
    std::erase_if(workspace_.jobs, [](const RunningJob& running) { return running.job->title() == kTrying; });
    if (found()) return;
    tried_tree_ = tree();
    tried_node_ = workspace_.selection.index;
    jobs_.start(kTrying, [this, of = tried_tree_, node = tried_node_](JobControl& control) -> Job::Finish {
        const QueryWorkload workload = standard_workload(std::array{of->shared_clip()}, kWhatIfQueries, kWhatIfSeed);
        WhatIf measured = what_if(workload, std::array{of}, 0, node, progress_of(control));
        return [this, measured = std::move(measured)]() mutable { found_ = std::move(measured); };
    });
}

bool WhatIfInspector::is_under_way() const {
    if (tried_node_ != workspace_.selection.index || tried_tree_ != tree()) return false;
    return std::ranges::any_of(workspace_.jobs,
                               [](const RunningJob& running) { return running.job->title() == kTrying; });
}

const WhatIf* WhatIfInspector::found() const {
    const bool is_of_this =
        found_ && found_->node == workspace_.selection.index && found_->variants.front().tree == tree();
    return is_of_this ? &*found_ : nullptr;
}

}  // namespace mobbscope::app
