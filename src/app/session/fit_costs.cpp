#include <app/session/fit_costs.h>

#include <chrono>
#include <cstddef>
#include <exception>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::chrono::milliseconds kAtOnce{15};  // no frame is later by more
constexpr std::size_t kCountedByItself = 2000;    // queries; more are counted where somebody asks for it

}  // namespace

void FitCosts::update(int clip) {
    if (job_ && job_->done()) {
        try {
            job_->finish();
        } catch (const std::exception& error) {
            notifications_.tell(MessageLevel::error, error.what());
        }
        job_.reset();
    }
    const std::shared_ptr<const mobb::Tree> tree = workspace_.fitted().shared_tree(clip);
    if (workspace_.workload() != QueryWorkload::Kind::placements || of_ == tree || workspace_.cost_of(clip)) return;
    of_ = tree;
    job_ = std::make_unique<Job>(
        "Costs of a tree",
        [this, tree](JobControl& control) -> Job::Finish {
            auto cost = std::make_shared<const TreeCost>(standard_cost(tree, progress_of(control)));
            return [this, cost = std::move(cost)] {
                of_.reset();
                workspace_.keep_standard_cost(cost);
            };
        },
        [&at = *desktop_] { at.wake(); });
    if (!job_->wait(options_.attended ? kAtOnce : std::chrono::hours(24))) return;
    update(clip);
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
