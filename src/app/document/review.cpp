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
using picture_tests::GoldenChange;
using picture_tests::NamedResult;
using picture_tests::PackedResult;

namespace {

/// Cases that are drawn quickly are waited for.
constexpr std::chrono::milliseconds kPatienceWithCases(20);

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

bool same_size(const Image& a, const Image& b) { return a.width == b.width && a.height == b.height; }

bool same_picture(const std::string& a, const std::string& b) {
    if (a == b) return true;
    if (a.empty() || b.empty()) return false;
    const Image first = read_png_bytes(a);
    const Image second = read_png_bytes(b);
    return same_size(first, second) && first.rgba == second.rgba;
}

/// Which of the case's two goldens a picture was held against: the one of its size.
std::filesystem::path golden_like(const CaseFile& file, const std::shared_ptr<const Image>& actual) {
    std::error_code ignored;
    if (!actual || !std::filesystem::exists(file.plain(), ignored)) return file.golden();
    try {
        const auto golden = picture_of(file.golden());
        const auto plain = picture_of(file.plain());
        if (plain && same_size(*plain, *actual) && !(golden && same_size(*golden, *actual))) return file.plain();
    } catch (const InputError&) {
        // What cannot be read is told where it is shown.
    }
    return file.golden();
}

PackedResult read_output_of(const CaseFile& file, const std::filesystem::path& picture) {
    PackedResult out;
    try {
        out.tolerance = picture_tests::read_terms(file).tolerance;
        out.actual = read_file(picture);
        const auto actual = picture_of(picture);
        const std::filesystem::path golden_file = golden_like(file, actual);
        if (golden_file == file.plain()) out.tolerance = picture_tests::Tolerance::loose;
        const auto golden = picture_of(golden_file);
        if (!golden) {
            out.outcome = CaseOutcome::missing_golden;
            out.message = "there is no golden " + golden_file.string();
            return out;
        }
        out.golden = read_file(golden_file);
        const ImageDiff found = diff(*actual, *golden, diff_options(out.tolerance));
        out.figures = picture_tests::figures_of(found);
        if (found.same) return out;
        out.outcome = CaseOutcome::different;
        out.message = what_differs(found);
        out.findings.push_back({golden_file, out.message, {}});
    } catch (const InputError& error) {
        out = {};
        out.outcome = CaseOutcome::failed;
        out.message = error.what();
    }
    return out;
}

}  // namespace

// --- a case

CaseOutcome ReviewCase::outcome() const { return accepted ? CaseOutcome::passed : result.outcome; }

bool ReviewCase::failing() const {
    return drawn() && outcome() != CaseOutcome::passed && outcome() != CaseOutcome::skipped;
}

double ReviewCase::difference() const {
    if (!failing()) return 0;
    return result.figures && result.figures->same_size ? result.figures->fraction() : 1;
}

// --- the review

Review::Review(std::filesystem::path folder, std::filesystem::path output, Surroundings surroundings)
    : folder_(std::move(folder)), output_(std::move(output)), surroundings_(std::move(surroundings)) {
    check(folder_, output_);
    for (CaseFile& file : picture_tests::find_cases(folder_)) cases_.push_back({.file = std::move(file)});
    if (!output_.empty()) read_output();
}

void Review::check(const std::filesystem::path& folder, const std::filesystem::path& output) {
    picture_tests::find_cases(folder);
    std::error_code ignored;
    if (output.empty() || std::filesystem::is_directory(output, ignored)) return;
    throw InputError(output.string(), "",
                     "is no folder; give one that mobbscope test --output wrote, or leave --output out");
}

void Review::read_output() {
    std::error_code ignored;
    for (ReviewCase& one : cases_) {
        const std::filesystem::path picture = output_ / (one.file.name + ".actual.png");
        if (!std::filesystem::exists(picture, ignored)) continue;
        one.result = read_output_of(one.file, picture);
        one.state = ReviewCase::State::drawn;
        one.from_output = true;
    }
}

picture_tests::Summary Review::summary() const {
    picture_tests::Summary sum;
    for (const ReviewCase& one : cases_) {
        if (one.drawn()) ++sum[one.outcome()];
    }
    return sum;
}

void Review::show(std::size_t index) {
    if (index < cases_.size()) current_ = index;
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

std::optional<std::size_t> Review::next(int by, bool failing_only) const {
    const std::vector<std::size_t> rows = listed();
    const auto now = std::ranges::find(rows, current_);
    const auto count = static_cast<std::ptrdiff_t>(rows.size());
    for (std::ptrdiff_t row = (now - rows.begin()) + by; row >= 0 && row < count; row += by) {
        const std::size_t index = rows[static_cast<std::size_t>(row)];
        if (!failing_only || cases_[index].failing()) return index;
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

std::vector<std::size_t> Review::viewed_failing() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
        if (cases_[i].viewed && cases_[i].failing()) out.push_back(i);
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
        if (!pictures_.golden || !pictures_.actual) return pictures_;
        if (!one.result.findings.empty() || one.from_output) {
            pictures_.golden_file = golden_like(one.file, pictures_.actual);
        }
        ImageDiff found = diff(*pictures_.actual, *pictures_.golden, diff_options(one.result.tolerance));
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
    if (job_) throw std::invalid_argument("wait for the run, or cancel it");
    std::vector<CaseFile> files;
    for (const std::size_t index : indices) {
        files.push_back(cases_[index].file);
        cases_[index].state = ReviewCase::State::waiting;
        changed(index);
    }
    news_ = std::make_shared<News>();
    const auto work = [files, folder = folder_, drawer = surroundings_.drawer, news = news_,
                       wake = surroundings_.wake](JobControl& control) -> Job::Finish {
        std::size_t done = 0;
        const auto tell = [&](const NamedResult& result) {
            {
                const std::scoped_lock lock(news->mutex);
                news->results.push_back(result);
            }
            control.step(++done, files.size());
            if (wake) wake();
        };
        draw_cases(drawer, folder, files, tell, [&] { control.step(done, files.size()); });
        return {};
    };
    job_ = std::make_unique<Job>("Drawing " + counted(files.size(), "case", "cases"), work, surroundings_.wake);
    job_->wait(surroundings_.attended ? kPatienceWithCases : std::chrono::hours(24));
}

void Review::cancel() {
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
        one.accept_if.reset();
        changed(i);
    }
}

std::vector<std::string> Review::poll() {
    std::vector<std::string> to_tell;
    if (!job_) return to_tell;
    const bool done = job_->done();
    std::vector<NamedResult> results;
    {
        const std::scoped_lock lock(news_->mutex);
        results.swap(news_->results);
    }
    for (const NamedResult& result : results) take_in(result, to_tell);
    if (!done) return to_tell;
    const std::unique_ptr<Job> job = std::move(job_);
    try {
        job->finish();
    } catch (const std::exception& error) {
        to_tell.push_back(error.what());
    }
    end_run();
    return to_tell;
}

void Review::take_in(const NamedResult& result, std::vector<std::string>& to_tell) {
    const std::size_t index = index_of(result.name);
    ReviewCase& one = cases_[index];
    const std::optional<std::string> accept_if = std::exchange(one.accept_if, std::nullopt);
    one.result = result.result;
    one.state = ReviewCase::State::drawn;
    one.from_output = false;
    one.accepted = false;
    // Another picture than the one that was seen.
    if (!accept_if) one.viewed = false;
    changed(index);
    if (!accept_if) return;
    try {
        if (!same_picture(*accept_if, one.result.actual)) {
            one.viewed = false;
            throw std::invalid_argument("is drawn otherwise here than in " + output_.string() + "; look at it again");
        }
        to_tell.push_back(accept({index}));
    } catch (const std::exception& error) {
        to_tell.push_back(one.file.name + ": " + error.what());
    }
}

// --- goldens

std::string Review::why_not_accept(std::size_t index) const {
    const ReviewCase& one = cases_[index];
    if (!one.drawn()) return "it is not drawn yet";
    if (one.accepted) return "it is accepted";
    const CaseOutcome outcome = one.outcome();
    if (outcome == CaseOutcome::passed) return "its picture is the golden's";
    if (outcome == CaseOutcome::skipped) return "it was skipped";
    if (outcome == CaseOutcome::failed) return "there is no picture of it";
    if (!can_be_taken(outcome, one.result.other_here)) {
        return "its goldens are from elsewhere: here are " + one.result.other_here;
    }
    return "";
}

std::string Review::accept(const std::vector<std::size_t>& indices) {
    std::vector<std::size_t> at_once;
    std::vector<std::size_t> anew;
    for (const std::size_t index : indices) {
        if (!why_not_accept(index).empty()) continue;
        if (surroundings_.check_may_write) surroundings_.check_may_write(cases_[index].file.golden());
        (cases_[index].from_output ? anew : at_once).push_back(index);
    }
    if (at_once.empty() && anew.empty()) {
        throw std::invalid_argument(indices.size() == 1
                                        ? cases_[indices.front()].file.name + ": " + why_not_accept(indices.front())
                                        : "none of them can be accepted");
    }
    if (!anew.empty() && job_) throw std::invalid_argument("wait for the run, or cancel it");
    std::string said;
    if (!at_once.empty()) said = write(at_once);
    if (anew.empty()) return said;
    for (const std::size_t index : anew) cases_[index].accept_if = cases_[index].result.actual;
    draw(anew);
    return said + (said.empty() ? "" : "; ") + "drawing " + counted(anew.size(), "case", "cases") +
           " anew, to take what is still the same";
}

std::string Review::write(const std::vector<std::size_t>& indices) {
    Step step;
    std::string refused;
    std::exception_ptr first_refusal;
    for (const std::size_t index : indices) {
        ReviewCase& one = cases_[index];
        try {
            picture_tests::write_goldens(one.result.fresh);
        } catch (const std::exception& error) {
            if (!first_refusal) first_refusal = std::current_exception();
            refused += std::string("; ") + error.what();
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
    steps_.resize(done_);
    const std::string said =
        "Accepted " + step.title.substr(std::string_view("accepting ").size()) + "; undo gives the golden back";
    steps_.push_back(std::move(step));
    ++done_;
    return said + refused;
}

namespace {

/// What a step writes, as one change: all or nothing.
template <class Taken>
std::vector<GoldenChange> changes_of(const std::vector<Taken>& taken) {
    std::vector<GoldenChange> out;
    for (const Taken& one : taken) out.insert(out.end(), one.before.fresh.begin(), one.before.fresh.end());
    return out;
}

}  // namespace

void Review::require_not_waiting(const Step& step) const {
    for (const Step::Taken& taken : step.taken) {
        const ReviewCase& one = cases_[taken.index];
        // It is held against the golden that is there.
        if (one.state != ReviewCase::State::waiting) continue;
        throw std::invalid_argument(one.file.name + " is being drawn: wait for the run, or cancel it");
    }
}

void Review::undo() {
    const Step& step = steps_[done_ - 1];
    require_not_waiting(step);
    picture_tests::write_goldens(picture_tests::taken_back(changes_of(step.taken)));
    for (const Step::Taken& taken : step.taken) {
        ReviewCase& one = cases_[taken.index];
        one.result = taken.before;
        one.accepted = false;
        changed(taken.index);
    }
    --done_;
    current_ = step.taken.front().index;
}

void Review::redo() {
    const Step& step = steps_[done_];
    require_not_waiting(step);
    picture_tests::write_goldens(changes_of(step.taken));
    for (const Step::Taken& taken : step.taken) {
        ReviewCase& one = cases_[taken.index];
        one.result = taken.before;
        one.accepted = true;
        changed(taken.index);
    }
    ++done_;
    current_ = step.taken.front().index;
}

}  // namespace mobbscope::app
