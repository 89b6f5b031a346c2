#include <app/session/query_answers.h>

#include <algorithm>
#include <chrono>
#include <mutex>

namespace mobbscope::app {

namespace {

constexpr std::size_t kAskedAtOnce = 500;  // queries between two looks of the window

}  // namespace

struct QueryAnswers::Made {
    mutable std::mutex mutex;
    Known known;
};

void QueryAnswers::update() {
    const std::shared_ptr<const FittedScene>& now = workspace_.document().fitted;
    if (of_ == now) return;
    of_ = now;
    made_ = std::make_shared<Made>();
    known_ = std::make_shared<const Known>();
    job_ = std::make_unique<Job>(
        "Answering queries",
        [fitted = now, made = made_](JobControl& control) -> Job::Finish {
            const std::size_t count = fitted->queries().size();
            for (std::size_t first = 0; first < count; first += kAskedAtOnce) {
                const std::size_t end = std::min(first + kAskedAtOnce, count);
                std::vector<int> hits;
                for (std::size_t i = first; i < end; ++i) {
                    control.step(i, count);
                    if (answer(*fitted, fitted->queries()[i], {}).contact) hits.push_back(static_cast<int>(i));
                }
                {
                    const std::scoped_lock lock(made->mutex);
                    made->known.asked = end;
                    made->known.hits.insert(made->known.hits.end(), hits.begin(), hits.end());
                }
                control.tell_news();
            }
            return {};
        },
        [&at = *desktop_] { at.wake(); });
    if (!options_.attended) job_->wait(std::chrono::hours(24));
}

const std::shared_ptr<const QueryAnswers::Known>& QueryAnswers::known() const {
    if (made_) {
        const std::scoped_lock lock(made_->mutex);
        if (known_->asked != made_->known.asked) known_ = std::make_shared<const Known>(made_->known);
    }
    return known_;
}

void QueryAnswers::end_work() {
    job_.reset();
    made_.reset();
    known_ = std::make_shared<const Known>();
    of_.reset();
}

}  // namespace mobbscope::app
