#include <app/session/fit_costs.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::chrono::milliseconds kAtOnce{15};  // no frame is later by more
constexpr std::size_t kCountedByItself = 2000;    // queries; more are counted where somebody asks for it

}  // namespace

std::shared_ptr<const FittedScene> FitCosts::next_unknown(int clip) const {
    const bool counts = workspace_.workload() == QueryWorkload::Kind::queries;
    for (const SceneView& seen : views_of(workspace_.document())) {
        if (seen.fitted->shared_tree(clip) == of_ || workspace_.cost_of(*seen.fitted, clip)) continue;
        // Of the active view somebody asks for it (wants_count).
        if (counts && !workspace_.cost_of(clip)) continue;
        return seen.fitted;
    }
    return nullptr;
}

void FitCosts::update(int clip) {
    if (job_ && job_->done()) {
        try {
            job_->finish();
        } catch (const std::exception& error) {
            notifications_.tell(MessageLevel::error, error.what());
        }
        job_.reset();
    }
    const auto views = views_of(workspace_.document());
    const auto is_shown = [&](const SceneView& seen) { return seen.fitted->shared_tree(clip) == of_; };
    if (std::ranges::none_of(views, is_shown)) end_work();
    const std::shared_ptr<const FittedScene> of = job_ ? nullptr : next_unknown(clip);
    if (!of) return;
    of_ = of->shared_tree(clip);
    const bool counts = workspace_.workload() == QueryWorkload::Kind::queries;
    job_ = std::make_unique<Job>(
        "Costs of a tree",
        [this, of, clip, counts](JobControl& control) -> Job::Finish {
            if (counts) {
                auto costs = std::make_shared<const SceneCosts>(scene_costs(*of, progress_of(control)));
                return [this, of, costs = std::move(costs)] {
                    of_.reset();
                    workspace_.keep_counted(of, costs);
                };
            }
            auto cost = std::make_shared<const TreeCost>(standard_cost(of->shared_tree(clip), progress_of(control)));
            return [this, cost = std::move(cost)] {
                of_.reset();
                workspace_.keep_standard_cost(cost);
            };
        },
        [&at = *desktop_] { at.wake(); });
    if (!job_->wait(options_.attended ? kAtOnce : std::chrono::hours(24))) return;
    update(clip);
}

const ComparedFits& FitCosts::compared(int clip) {
    Compared now;
    for (const SceneView& seen : views_of(workspace_.document())) {
        now.trees.push_back(seen.fitted->shared_tree(clip));
        now.costs.push_back(workspace_.cost_of(*seen.fitted, clip));
    }
    if (now.trees != compared_.trees || now.costs != compared_.costs) {
        now.fits = mobbscope::compared(now.trees, now.costs);
        compared_ = std::move(now);
    }
    return compared_.fits;
}

bool FitCosts::wants_count() {
    const std::shared_ptr<const FittedScene>& now = workspace_.document().fitted;
    if (workspace_.workload() != QueryWorkload::Kind::queries || workspace_.derived().costs) return false;
    if (now->queries().size() > kCountedByItself || counted_in_ == now) return false;
    counted_in_ = now;
    return true;
}

void FitCosts::end_work() {
    job_.reset();
    of_.reset();
}

}  // namespace mobbscope::app
