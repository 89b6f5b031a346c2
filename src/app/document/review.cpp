#include <app/document/review.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <render/image/png.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mobbscope::app {

using picture_tests::CaseFile;
using picture_tests::CaseOutcome;
using picture_tests::CaseResult;
using picture_tests::GoldenChange;

namespace {

/// Cases that are drawn quickly are waited for.
constexpr std::chrono::milliseconds kPatienceWithCases(20);
/// A run that is ended is over in a moment (draw_cases), unless the machine hangs.
constexpr std::chrono::seconds kPatienceWithItsEnd(2);

std::shared_ptr<const Image> picture_of(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return nullptr;
    return std::make_shared<const Image>(read_png(file));
}

/// The picture of packed bytes, which the program made itself.
std::shared_ptr<const Image> picture_from(const std::string& png) {
    if (png.empty()) return nullptr;
    return std::make_shared<const Image>(read_png_bytes(png));
}

}  // namespace

// --- a case

CaseOutcome ReviewCase::outcome() const { return accepted ? CaseOutcome::passed : result.outcome; }

bool ReviewCase::failing() const {
    return drawn() && outcome() != CaseOutcome::passed && outcome() != CaseOutcome::skipped;
}

double ReviewCase::difference() const {
    if (!drawn() || accepted) return 0;
    if (!failing() && !result.image) return 0;
    return result.image && result.image->same_size ? result.image->fraction() : 1;
}

// --- the review

ReviewFolder find_review(const std::filesystem::path& folder, const std::filesystem::path& output) {
    ReviewFolder found{folder, output, picture_tests::find_cases(folder), {}};
    if (!output.empty()) found.report = picture_tests::read_case_report(output, found.cases);
    return found;
}

Review::Review(ReviewFolder found, Surroundings surroundings)
    : folder_(std::move(found.folder)), output_(std::move(found.output)), surroundings_(std::move(surroundings)) {
    for (CaseFile& file : found.cases) cases_.push_back({.file = std::move(file)});
    read_output(found.report);
}

Review::~Review() { cancel(); }

void Review::read_output(const picture_tests::CaseReport& report) {
    for (const CaseResult& read : report.results) {
        ReviewCase& one = cases_[index_of(read.file.name)];
        one.result = read;
        one.state = ReviewCase::State::drawn;
        one.from_output = true;
    }
    show_first_failing();
}

picture_tests::Summary Review::summary() const {
    picture_tests::Summary sum;
    for (const ReviewCase& one : cases_) {
        if (one.drawn()) ++sum[one.outcome()];
    }
    return sum;
}

void Review::show(std::size_t index) {
    if (index >= cases_.size()) return;
    current_ = index;
    chosen_ = true;
}

void Review::begin_as(const Review& before) {
    if (!before.chosen_ || before.folder_ != folder_) return;
    const auto at =
        std::ranges::find(cases_, before.shown().file.name, [](const ReviewCase& one) { return one.file.name; });
    if (at != cases_.end()) show(static_cast<std::size_t>(at - cases_.begin()));
}

void Review::show_first_failing() {
    if (chosen_ || found_failing_) return;
    const std::vector<std::size_t> rows = listed();
    const auto failing = std::ranges::find_if(rows, [&](std::size_t index) { return cases_[index].failing(); });
    if (failing == rows.end()) return;
    current_ = *failing;
    found_failing_ = true;
}

std::vector<std::size_t> Review::listed() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
        // What has just been accepted stays in view while it is shown.
        if (!look.failed_only || cases_[i].failing() || i == current_) out.push_back(i);
    }
    const auto rank = [&](std::size_t i) {
        const ReviewCase& one = cases_[i];
        if (look.order == ReviewOrder::difference) return -one.difference();
        constexpr std::array<int, picture_tests::kOutcomeWords.size()> kRanks{3, 1, 2, 0, 4};
        return one.drawn() ? static_cast<double>(kRanks[static_cast<std::size_t>(one.outcome())]) : 5.0;
    };
    if (look.order != ReviewOrder::name) {
        std::ranges::stable_sort(out, [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    }
    return out;
}

std::optional<std::size_t> Review::next(int by) const {
    const std::vector<std::size_t> rows = listed();
    const std::ptrdiff_t row = (std::ranges::find(rows, current_) - rows.begin()) + by;
    if (row < 0 || row >= std::ssize(rows)) return std::nullopt;
    return rows[static_cast<std::size_t>(row)];
}

std::optional<std::size_t> Review::next_failing(int by) const {
    const std::vector<std::size_t> rows = listed();
    const std::ptrdiff_t now = std::ranges::find(rows, current_) - rows.begin();
    const std::ptrdiff_t count = std::ssize(rows);
    for (std::ptrdiff_t away = 1; away < count; ++away) {
        const std::size_t index = rows[static_cast<std::size_t>((now + (by > 0 ? away : count - away)) % count)];
        if (cases_[index].failing()) return index;
    }
    return std::nullopt;
}

std::size_t Review::index_of(const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
        if (cases_[i].file.name == name) return i;
        names.push_back(cases_[i].file.name);
    }
    throw std::invalid_argument("there is no case " + in_quotes(name) + did_you_mean(name, names));
}

std::vector<std::size_t> Review::marked() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
        if (cases_[i].marked) out.push_back(i);
    }
    return out;
}

std::vector<std::size_t> Review::viewed() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
        if (cases_[i].viewed && why_not_accept(i).empty()) out.push_back(i);
    }
    return out;
}

void Review::changed(std::size_t index) {
    if (unpacked_ == index) unpacked_.reset();
}

const ReviewPictures& Review::pictures() {
    if (unpacked_ == current_) return pictures_;
    unpacked_ = current_;
    pictures_ = {};
    ReviewCase& one = cases_[current_];
    pictures_.golden_file = one.file.golden();
    if (one.drawn()) one.viewed = true;
    try {
        if (one.drawn()) pictures_.actual = picture_from(one.result.actual);
        if (one.accepted) {
            pictures_.golden = pictures_.actual;
        } else if (one.drawn() && !one.result.golden.empty()) {
            pictures_.golden = picture_from(one.result.golden);
        } else if (!one.drawn() || one.outcome() != CaseOutcome::missing_golden) {
            // Of what passed, and of what there is no other picture of, the file.
            pictures_.golden = picture_of(one.file.golden());
        }
        if (!one.result.shown.empty()) pictures_.golden_file = one.result.shown;
        if (!pictures_.golden || !pictures_.actual) return pictures_;
        ImageDiff found = compared_again(one.result, *pictures_.actual, *pictures_.golden);
        Image heat = std::exchange(found.heat, {});
        if (!heat.rgba.empty()) pictures_.difference = std::make_shared<const Image>(std::move(heat));
        pictures_.diff = std::move(found);
    } catch (const InputError& error) {
        pictures_.why_not = error.what();
    }
    return pictures_;
}

// --- runs

void Review::draw_all() {
    std::vector<std::size_t> all(cases_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    draw(all);
}

void Review::draw(const std::vector<std::size_t>& indices) {
    if (job_) throw std::invalid_argument("wait for the run, or stop it");
    if (!surroundings_.may_draw) {
        throw InputError("no case is drawn here: a picture test starts no other; remove this from its script");
    }
    std::vector<picture_tests::CaseOrder> orders;
    for (const std::size_t index : indices) {
        orders.push_back({cases_[index].file});
        cases_[index].state = ReviewCase::State::waiting;
        changed(index);
    }
    results_ = std::make_shared<Results>();
    const auto work = [orders, folder = folder_, drawer = surroundings_.drawer,
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

void Review::cancel() {
    if (!job_) return;
    job_->cancel();
    // Its process has ended then: the program may end now, and nothing else would end that one.
    job_->wait(kPatienceWithItsEnd);
    job_.reset();
    end_run();
}

/// What was not drawn stands as it was before.
void Review::end_run() {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
        ReviewCase& one = cases_[i];
        if (one.state != ReviewCase::State::waiting) continue;
        const bool was_drawn = !one.result.actual.empty() || !one.result.message.empty();
        one.state = was_drawn ? ReviewCase::State::drawn : ReviewCase::State::not_drawn;
        changed(i);
    }
}

std::vector<ReviewNews> Review::poll() {
    std::vector<ReviewNews> to_tell;
    if (!job_) return to_tell;
    const bool done = job_->done();
    std::vector<CaseResult> results;
    {
        const std::scoped_lock lock(results_->mutex);
        results.swap(results_->ready);
    }
    for (const CaseResult& result : results) take_in(result);
    show_first_failing();
    if (!done) return to_tell;
    const std::unique_ptr<Job> job = std::move(job_);
    try {
        job->finish();
    } catch (const std::exception& error) {
        to_tell.push_back({MessageLevel::error, error.what()});
    }
    end_run();
    return to_tell;
}

void Review::take_in(const CaseResult& result) {
    const std::size_t index = index_of(result.file.name);
    ReviewCase& one = cases_[index];
    // Another picture than the one that was seen.
    if (one.result.actual != result.actual) one.viewed = false;
    one.result = result;
    one.state = ReviewCase::State::drawn;
    one.from_output = false;
    one.accepted = false;
    changed(index);
}

// --- goldens

std::string Review::why_not_accept(std::size_t index) const {
    const ReviewCase& one = cases_[index];
    if (!one.drawn()) return "it is not drawn yet";
    if (one.accepted) return "it is accepted";
    const CaseOutcome outcome = one.outcome();
    if (outcome == CaseOutcome::passed) return "it passed";
    if (outcome == CaseOutcome::skipped) return "it was skipped";
    if (outcome == CaseOutcome::failed) return "there is no picture of it";
    if (!can_be_taken(outcome, one.result.other_here)) {
        return "its goldens are from elsewhere: here are " + one.result.other_here;
    }
    return "";
}

std::vector<ReviewNews> Review::accept(const std::vector<std::size_t>& indices) {
    std::vector<std::size_t> ready;
    std::string not_accepted;
    for (const std::size_t index : indices) {
        if (const std::string why = why_not_accept(index); !why.empty()) {
            not_accepted += (not_accepted.empty() ? "" : "; ") + cases_[index].file.name + ": " + why;
            continue;
        }
        if (surroundings_.check_may_write) surroundings_.check_may_write(cases_[index].file.golden());
        ready.push_back(index);
    }
    if (ready.empty()) {
        throw std::invalid_argument(indices.empty() ? "there is no case to accept" : not_accepted);
    }
    std::vector<ReviewNews> news = write(ready);
    if (!not_accepted.empty()) news.push_back({MessageLevel::warning, "Not accepted: " + not_accepted});
    return news;
}

std::vector<ReviewNews> Review::write(const std::vector<std::size_t>& indices) {
    Step step;
    std::vector<ReviewNews> refused;
    std::exception_ptr first_refusal;
    for (const std::size_t index : indices) {
        ReviewCase& one = cases_[index];
        try {
            if (one.from_output) picture_tests::check_bytes(one.result.fresh, output_);
            picture_tests::write_goldens(one.result.fresh);
        } catch (const std::exception& error) {
            if (!first_refusal) first_refusal = std::current_exception();
            refused.push_back({MessageLevel::error, error.what()});
            continue;
        }
        step.taken.push_back({index, one.result});
        one.accepted = true;
        one.marked = false;
        changed(index);
    }
    if (step.taken.empty()) std::rethrow_exception(first_refusal);
    step.title = step.taken.size() == 1 ? "accepting " + cases_[step.taken.front().index].file.name
                                        : "accepting " + counted(step.taken.size(), "picture", "pictures");
    step.said = "Accepted " + step.title.substr(std::string_view("accepting ").size()) + "; undo gives the golden" +
                (step.taken.size() == 1 ? "" : "s") + " back";
    steps_.resize(done_);
    std::vector<ReviewNews> said{{MessageLevel::info, step.said}};
    steps_.push_back(std::move(step));
    ++done_;
    said.insert(said.end(), refused.begin(), refused.end());
    return said;
}

void Review::show_some_of(const Step& step) {
    if (std::ranges::find(step.taken, current_, &Step::Taken::index) == step.taken.end()) {
        show(step.taken.front().index);
    }
}

bool Review::waits(const Step& step) const {
    return std::ranges::any_of(
        step.taken, [&](const Step::Taken& taken) { return cases_[taken.index].state == ReviewCase::State::waiting; });
}

namespace {

/// What a step writes, as one change: all or nothing.
template <class Taken>
std::vector<GoldenChange> changes_of(const std::vector<Taken>& taken) {
    std::vector<GoldenChange> out;
    for (const Taken& one : taken) out.insert(out.end(), one.before.fresh.begin(), one.before.fresh.end());
    return out;
}

/// In place of what was said of the step before.
template <class Step>
ReviewNews said_now(Step& step, const std::string& what) {
    const std::string before = std::exchange(step.said, what + step.title);
    return {MessageLevel::info, step.said, before};
}

}  // namespace

ReviewNews Review::undo() {
    Step& step = steps_[done_ - 1];
    picture_tests::write_goldens(picture_tests::taken_back(changes_of(step.taken)));
    for (const Step::Taken& taken : step.taken) {
        ReviewCase& one = cases_[taken.index];
        one.result = taken.before;
        one.accepted = false;
        changed(taken.index);
    }
    --done_;
    show_some_of(step);
    return said_now(step, "Undone: ");
}

ReviewNews Review::redo() {
    Step& step = steps_[done_];
    picture_tests::write_goldens(changes_of(step.taken));
    for (const Step::Taken& taken : step.taken) {
        ReviewCase& one = cases_[taken.index];
        one.result = taken.before;
        one.accepted = true;
        changed(taken.index);
    }
    ++done_;
    show_some_of(step);
    return said_now(step, "Done again: ");
}

}  // namespace mobbscope::app
