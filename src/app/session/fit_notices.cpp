#include <app/session/fit_notices.h>
#include <explain/expected_cost.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::size_t kTreesKept = 16;  // so that undo and a second view find theirs

}  // namespace

FitNotices::Noticed* FitNotices::of(int clip) {
    const auto known = std::ranges::find(known_, workspace_.fitted().shared_tree(clip), &Noticed::tree);
    return known == known_.end() ? nullptr : &*known;
}

void FitNotices::look(int clip, std::function<void()> then) {
    if (of(clip)) return then ? then() : void();
    if (options_.attended && then) then_ = std::move(then);
    if (job_) return;
    job_ = std::make_unique<Job>(
        "Looking at a fit",
        [this, tree = workspace_.fitted().shared_tree(clip)](JobControl&) -> Job::Finish {
            std::vector<FitFinding> found = fit_findings(*tree, expected_cost(*tree, *tree));
            return [this, tree, found = std::move(found)]() mutable {
                if (known_.size() == kTreesKept) known_.pop_front();
                known_.push_back({tree, std::move(found)});
            };
        },
        [&at = *desktop_] { at.wake(); });
    if (options_.attended) return;
    job_->wait(std::chrono::hours(24));
    poll();
    if (then && of(clip)) then();
}

void FitNotices::poll() {
    if (!job_ || !job_->done()) return;
    const std::unique_ptr<Job> job = std::move(job_);
    const std::function<void()> then = std::exchange(then_, nullptr);
    try {
        job->finish();
        if (then) then();
    } catch (const std::exception& error) {
        notifications_.tell(MessageLevel::error, error.what());
    }
}

}  // namespace mobbscope::app
