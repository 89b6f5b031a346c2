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

void FitNotices::look(int clip, const std::function<void()>& then) {
    if (of(clip)) return then ? then() : void();
    const std::shared_ptr<const mobb::Tree> tree = workspace_.fitted().shared_tree(clip);
    if (!then && tree == failed_) return;
    if (options_.attended && then) {
        then_ = then;
        then_for_ = clip;
    }
    if (job_) return;
    of_ = tree;
    failed_.reset();
    job_ = std::make_unique<Job>(
        "Looking at a fit",
        [this, tree](JobControl& control) -> Job::Finish {
            std::vector<FitFinding> found = fit_findings(*tree, expected_shares(*tree), progress_of(control));
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
    try {
        job->finish();
    } catch (const std::exception& error) {
        failed_ = of_;
        notifications_.tell(MessageLevel::error, error.what());
    }
    const std::function<void()> then = std::exchange(then_, nullptr);
    const FittedScene& fitted = workspace_.fitted();
    if (!then || then_for_ >= static_cast<int>(fitted.scene().clips.size())) return;
    // It said so already.
    if (failed_ == of_ && fitted.shared_tree(then_for_) == of_) return;
    try {
        // The job was for another clip, or the clip was fitted anew meanwhile.
        look(then_for_, then);
    } catch (const std::exception& error) {
        notifications_.tell(MessageLevel::error, error.what());
    }
}

void FitNotices::end_work() {
    job_.reset();
    then_ = nullptr;
}

}  // namespace mobbscope::app
