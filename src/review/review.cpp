#include <base/error.h>
#include <base/text.h>
#include <render/image/png.h>
#include <review/review.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mobbscope::app {

using picture_tests::CaseFile;
using picture_tests::CaseOutcome;
using picture_tests::CaseResult;

namespace {

std::shared_ptr<const Image> picture_of(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return nullptr;
    return std::make_shared<const Image>(read_png(file));
}

/// Those that are there, or would be.
std::vector<std::filesystem::path> number_files_of(const ReviewCase& one) {
    using picture_tests::Held;
    std::vector<std::filesystem::path> out;
    for (const Held held : {Held::answers, Held::trace, Held::fit}) {
        const std::filesystem::path golden = one.file.golden_of(held);
        std::error_code ignored;
        if (std::filesystem::exists(golden, ignored) ||
            std::ranges::find(one.result.findings, golden, &picture_tests::Finding::golden) !=
                one.result.findings.end()) {
            out.push_back(golden);
        }
    }
    return out;
}

/// The picture of packed bytes, which the program made itself.
std::shared_ptr<const Image> picture_from(const std::string& png) {
    if (png.empty()) return nullptr;
    return std::make_shared<const Image>(read_png_bytes(png));
}

}  // namespace

// --- a case

CaseOutcome ReviewCase::outcome() const {
    if (!accepted) return result.outcome;
    if (stays_different(result)) return CaseOutcome::different;
    return lacks_opengl(result) ? CaseOutcome::skipped : CaseOutcome::passed;
}

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
    if (output.empty()) return {folder, output, picture_tests::find_cases(folder), {}};
    ReviewFolder found{folder, output, picture_tests::cases_there(folder), {}};
    found.report = picture_tests::read_case_report(output, folder, found.cases);
    // A test may have asked for others, which are no files yet.
    for (const CaseResult& read : found.report.results) {
        if (std::ranges::find(found.cases, read.file.name, &CaseFile::name) == found.cases.end())
            found.cases.push_back(read.file);
    }
    std::ranges::sort(found.cases, {}, &CaseFile::name);
    if (found.cases.empty()) found.cases = picture_tests::find_cases(folder);
    return found;
}

Review::Review(ReviewFolder found, ReviewSurroundings surroundings)
    : run(*this, surroundings_),
      goldens(*this, surroundings_),
      surroundings_(std::move(surroundings)),
      folder_(std::move(found.folder)),
      output_(std::move(found.output)) {
    for (CaseFile& file : found.cases) cases_.push_back({.file = std::move(file)});
    for (const CaseResult& read : found.report.results) {
        ReviewCase& one = cases_[index_of(read.file.name)];
        one.result = read;
        one.state = ReviewCase::State::drawn;
        one.from_output = true;
    }
    show_first_failing();
}

Review::~Review() { run.cancel(); }

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

std::string Review::why_not_accept(std::size_t index) const {
    const ReviewCase& one = cases_[index];
    if (!one.drawn()) return "it is not drawn yet";
    if (one.accepted) return "it is the golden already";
    const CaseOutcome outcome = one.outcome();
    if (outcome == CaseOutcome::passed) return "it passed";
    if (outcome == CaseOutcome::skipped) return "it was skipped";
    if (outcome == CaseOutcome::failed) return "it failed, so there is no golden to take";
    if (!can_be_taken(one.result)) return "no golden differs, but its scene expects another answer; correct the scene";
    return "";
}

std::vector<std::size_t> Review::viewed() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
        if (cases_[i].viewed && why_not_accept(i).empty()) out.push_back(i);
    }
    return out;
}

ReviewCase& Review::change(std::size_t index) {
    if (unpacked_ == index) unpacked_.reset();
    return cases_[index];
}

const ReviewPictures& Review::pictures() {
    if (unpacked_ == current_) return pictures_;
    unpacked_ = current_;
    pictures_ = {};
    ReviewCase& one = cases_[current_];
    pictures_.golden_file = one.file.golden();
    if (one.drawn()) one.viewed = true;
    pictures_.number_files = number_files_of(one);
    for (const picture_tests::GoldenChange& fresh : one.result.fresh) {
        const bool is_held = std::ranges::find(pictures_.number_files, fresh.file) != pictures_.number_files.end();
        if (is_held && fresh.bytes) pictures_.numbers[fresh.file] = held_rows(fresh.replaces, *fresh.bytes);
    }
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
        if (draws_nothing(one.result)) pictures_.golden_file.clear();
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

}  // namespace mobbscope::app
