#include <base/error.h>
#include <base/text.h>
#include <review/case_run.h>
#include <review/review.h>

#include <chrono>
#include <exception>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

using picture_tests::CaseResult;

namespace {

/// Cases that are drawn quickly are waited for.
constexpr std::chrono::milliseconds kPatienceWithCases(20);
/// A run that is ended is over in a moment (draw_cases), unless the machine hangs.
constexpr std::chrono::seconds kPatienceWithItsEnd(2);

}  // namespace

void CaseRun::draw_all() {
    std::vector<std::size_t> all(review_.cases().size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    draw(all);
}

void CaseRun::draw(const std::vector<std::size_t>& indices) {
    if (job_) throw std::invalid_argument("wait for the run, or stop it");
    if (!surroundings_.may_draw) {
        throw InputError("no case is drawn here: a picture test starts no other; remove this from its script");
    }
    std::vector<picture_tests::CaseOrder> orders;
    for (const std::size_t index : indices) {
        orders.push_back({review_.cases()[index].file});
        review_.change(index).state = ReviewCase::State::waiting;
    }
    results_ = std::make_shared<Results>();
    const auto work = [orders, folder = review_.folder(), drawer = surroundings_.drawer,
                       results = results_](JobControl& control) -> Job::Finish {
        std::size_t done = 0;
        const auto tell = [&](const CaseResult& result) {
            {
                const std::scoped_lock lock(results->mutex);
                results->ready.push_back(result);
            }
            control.step(++done, orders.size());
            control.tell_news();
        };
        const std::vector<std::string> complaints =
            draw_cases(drawer, folder, orders, tell, [&] { control.step(done, orders.size()); });
        if (!complaints.empty()) throw MachineError(complaints.front());
        return {};
    };
    job_ = std::make_unique<Job>("Drawing " + counted(orders.size(), "case", "cases"), work, surroundings_.wake);
    job_->wait(surroundings_.attended ? kPatienceWithCases : std::chrono::hours(24));
}

void CaseRun::cancel() {
    if (!job_) return;
    job_->cancel();
    // Its process has ended then: the program may end now, and nothing else would end that one.
    job_->wait(kPatienceWithItsEnd);
    job_.reset();
    end();
}

/// What was not drawn stands as it was before.
void CaseRun::end() {
    for (std::size_t i = 0; i < review_.cases().size(); ++i) {
        if (review_.cases()[i].state != ReviewCase::State::waiting) continue;
        ReviewCase& one = review_.change(i);
        const bool was_drawn = !one.result.actual.empty() || !one.result.message.empty();
        one.state = was_drawn ? ReviewCase::State::drawn : ReviewCase::State::not_drawn;
    }
}

std::vector<ReviewNews> CaseRun::poll() {
    std::vector<ReviewNews> to_tell;
    if (!job_) return to_tell;
    const bool done = job_->done();
    std::vector<CaseResult> results;
    {
        const std::scoped_lock lock(results_->mutex);
        results.swap(results_->ready);
    }
    for (const CaseResult& result : results) take_in(result);
    review_.show_first_failing();
    if (!done) return to_tell;
    const std::unique_ptr<Job> job = std::move(job_);
    try {
        job->finish();
    } catch (const std::exception& error) {
        to_tell.push_back({MessageLevel::error, error.what()});
    }
    end();
    return to_tell;
}

void CaseRun::take_in(const CaseResult& result) {
    ReviewCase& one = review_.change(review_.index_of(result.file.name));
    // Another picture than the one that was seen.
    if (one.result.actual != result.actual) one.viewed = false;
    one.result = result;
    one.state = ReviewCase::State::drawn;
    one.from_output = false;
    one.accepted = false;
}

}  // namespace mobbscope::app
