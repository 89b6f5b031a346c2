/// Picture tests that are looked at: their results, which one is shown and how.
#pragma once

#include <base/file.h>
#include <cases/case_report.h>
#include <review/golden_steps.h>
#include <review/review_case.h>
#include <review/review_look.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

/// A folder of picture tests, and what an earlier `mobbscope test` left of them, the folder of its --output or the page
/// of its --html; empty: nothing.
struct ReviewFolder {
    std::filesystem::path folder, output;
    std::vector<picture_tests::CaseFile> cases;
    picture_tests::CaseReport report;
};
/// Throws InputError if there are no cases or no such report.
ReviewFolder find_review(const std::filesystem::path& folder, const std::filesystem::path& output = {});

class Review {
  public:
    Review(ReviewFolder found, ReviewSurroundings surroundings);
    /// Ends the run and the process that draws.
    ~Review();
    Review(const Review&) = delete;
    Review& operator=(const Review&) = delete;

    ReviewLook look;
    CaseRun run;
    GoldenSteps goldens;

    const std::filesystem::path& folder() const { return folder_; }
    std::string title() const { return own_name(folder_); }
    const std::filesystem::path& output() const { return output_; }
    const std::vector<ReviewCase>& cases() const { return cases_; }
    picture_tests::Summary summary() const;  ///< of those that are drawn

    // Which one: until somebody chooses one, the first that fails.
    std::size_t current() const { return current_; }
    const ReviewCase& shown() const { return cases_[current_]; }
    void show(std::size_t index);
    /// The first that fails, unless somebody has chosen one, or one has failed already.
    void show_first_failing();
    /// If `before` is of the same folder and somebody chose a case there, that one is shown, if it is still there.
    void begin_as(const Review& before);
    /// The cases of the list, in its order.
    std::vector<std::size_t> listed() const;
    /// The listed case one row further (`by` 1) or back (-1); none behind the ends.
    std::optional<std::size_t> next(int by) const;
    /// The next listed case that fails, or back to one; behind the end it goes on at the other. None if no other fails.
    std::optional<std::size_t> next_failing(int by) const;
    /// Throws std::invalid_argument if there is none of that name.
    std::size_t index_of(const std::string& name) const;
    void mark(std::size_t index, bool marked) { cases_[index].marked = marked; }
    std::vector<std::size_t> marked() const;
    /// Why the case's picture cannot become its golden; empty if it can.
    std::string why_not_accept(std::size_t index) const;
    /// Those that somebody has looked at and that can be accepted.
    std::vector<std::size_t> viewed() const;
    /// Of the case that is shown, unpacked; counts as seen.
    const ReviewPictures& pictures();
    /// To change what is known of it: its pictures are unpacked anew.
    ReviewCase& change(std::size_t index);

  private:
    ReviewSurroundings surroundings_;
    std::filesystem::path folder_, output_;
    std::vector<ReviewCase> cases_;
    std::size_t current_ = 0;
    bool chosen_ = false;         ///< somebody wants that one
    bool found_failing_ = false;  ///< ... or it is the first that failed: it stays when an earlier one fails too
    std::optional<std::size_t> unpacked_;
    ReviewPictures pictures_;
};

}  // namespace mobbscope::app
