#include <app/session/fit_costs.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <optional>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::chrono::milliseconds kAtOnce{15};           // no frame is later by more
constexpr std::size_t kCountedByItself = 2000;             // queries; more are counted in the active view, by a button
constexpr std::size_t kUnattended = std::size_t{1} << 17;  // placements: tests and pictures start thousands of sessions

}  // namespace

bool FitCosts::Task::operator==(const Task& other) const {
    if (counts != other.counts) return false;
    if (counts) return in == other.in || ask_the_same(*in, *other.in);
    return in->shared_tree(clip) == other.in->shared_tree(other.clip);
}

std::size_t FitCosts::most_counted() const {
    const std::size_t most = mobbscope::most_counted(workspace_.scene().clips.size());
    return options_.attended ? most : std::min(most, kUnattended);
}

bool FitCosts::has_failed(const Task& task) const { return std::ranges::find(failed_, task) != failed_.end(); }

bool FitCosts::is_known(const Task& task) const {
    return task.counts ? workspace_.counted(*task.in) != nullptr : workspace_.cost_of(*task.in, task.clip) != nullptr;
}

std::optional<FitCosts::Task> FitCosts::next_wanted(int clip) const {
    const bool counts = workspace_.workload() == QueryWorkload::Kind::queries;
    // Of the active view somebody asks for it (wants_count).
    if (counts && (!workspace_.derived().costs || !counts_unasked())) return std::nullopt;
    std::optional<Task> more;
    for (const SceneView& seen : views_of(workspace_.document())) {
        const Task task{seen.fitted, clip, counts};
        if (has_failed(task)) continue;
        if (!is_known(task)) return task;
        if (!counts && !more && !workspace_.cost_of(*task.in, clip)->count.is_enough(most_counted())) more = task;
    }
    return more;
}

bool FitCosts::is_shown(const Task& task) const {
    if (task.counts != (workspace_.workload() == QueryWorkload::Kind::queries)) return false;
    const auto shows = [&](const SceneView& seen) {
        const auto clip = static_cast<std::size_t>(task.clip);
        return clip < seen.fitted->scene().clips.size() && task == Task{seen.fitted, task.clip, task.counts};
    };
    return std::ranges::any_of(views_of(workspace_.document()), shows);
}

void FitCosts::begin(const Task& task, std::chrono::milliseconds patience) {
    task_ = task;
    std::shared_ptr<const TreeCost> so_far;
    if (!task.counts) so_far = workspace_.cost_of(*task.in, task.clip);
    job_ = std::make_unique<Job>(
        "Costs of a tree",
        [this, task, so_far, most = most_counted()](JobControl& control) -> Job::Finish {
            if (task.counts) {
                auto costs = std::make_shared<const SceneCosts>(scene_costs(*task.in, progress_of(control)));
                return [this, of = task.in, costs = std::move(costs)] { workspace_.keep_counted(of, costs); };
            }
            auto cost = counted_on(task.in->shared_tree(task.clip), so_far.get(), most, progress_of(control));
            return [this, task, cost = std::move(cost)] {
                cost ? workspace_.keep_standard_cost(cost) : failed_.push_back(task);
            };
        },
        [&at = *desktop_] { at.wake(); });
    job_->wait(options_.attended ? std::min(patience, options_.patience) : std::chrono::hours(24));
}

void FitCosts::take_result() {
    if (!job_ || !job_->done()) return;
    try {
        job_->finish();
    } catch (const std::exception& error) {
        failed_.push_back(task_);
        notifications_.tell(MessageLevel::error, error.what());
    }
    end_work();
}

void FitCosts::update(int clip) {
    take_result();
    std::erase_if(failed_, [&](const Task& task) { return !is_shown(task); });
    if (job_ && !is_shown(task_)) end_work();
    while (const std::optional<Task> task = next_wanted(clip)) {
        // That of another clip gives way.
        if (job_ && (task_.counts || task_.clip == clip)) return;
        begin(*task, is_known(*task) ? std::chrono::milliseconds(0) : kAtOnce);
        take_result();
    }
}

void FitCosts::find_when_idle(int clip) {
    take_result();
    const Task task{workspace_.document().fitted, clip, false};
    if (job_ || workspace_.workload() != QueryWorkload::Kind::placements || is_known(task) || has_failed(task)) return;
    begin(task, std::chrono::milliseconds(0));
    take_result();
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

bool FitCosts::counts_unasked() const { return workspace_.document().fitted->queries().size() <= kCountedByItself; }

bool FitCosts::wants_count() {
    const std::shared_ptr<const FittedScene>& now = workspace_.document().fitted;
    if (workspace_.workload() != QueryWorkload::Kind::queries || workspace_.derived().costs) return false;
    if (!counts_unasked() || counted_in_ == now) return false;
    counted_in_ = now;
    return true;
}

void FitCosts::end_work() {
    job_.reset();
    task_ = {};
}

}  // namespace mobbscope::app
