/// Picture tests that are looked at: their results, which one is shown and how, and goldens that are taken and given
/// back.
#pragma once

#include <app/document/job.h>
#include <app/document/message_level.h>
#include <base/file.h>
#include <cases/case_file.h>
#include <cases/case_report.h>
#include <cases/case_result.h>
#include <cases/drawing_child.h>
#include <cases/golden_change.h>
#include <render/image/image.h>
#include <render/image/image_diff.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// How the pictures of a case are laid out.
enum class ReviewMode { side_by_side, golden, actual, difference, slider, blink };
struct ReviewModeWords {
    std::string_view name;   ///< for scripts
    std::string_view title;  ///< on its button
    std::string_view doc;    ///< of its command
    std::string_view shortcut;
};
inline constexpr std::array<ReviewModeWords, 6> kReviewModes{
    {{"side", "Side by side", "Shows golden, actual picture and difference beside one another.", "1"},
     {"golden", "Golden", "Shows the golden.", "2"},
     {"actual", "Actual", "Shows the picture as it is drawn now.", "3"},
     {"difference", "Difference", "Shows where the pictures differ: the brighter, the more.", "4"},
     {"slider", "Slider", "Shows the golden left of a line and the actual picture right of it; drag the line.", "5"},
     {"blink", "Blink", "Shows golden and actual picture in turn.", "6 B"}}};

enum class ReviewOrder { name, difference, outcome };
inline constexpr std::array<std::string_view, 3> kReviewOrders{"name", "difference", "outcome"};

inline constexpr double kLeastReviewZoom = 1.0 / 32;
inline constexpr double kMostReviewZoom = 64;

/// How the cases are looked at; any value may be set at any time.
struct ReviewLook {
    ReviewMode mode = ReviewMode::side_by_side;
    double blink_seconds = 0.5;  ///< that each picture stays
    double divider = 0.5;        ///< of the slider: share of the picture's width that shows the golden
    double zoom = 0;             ///< pixels of the window for one of the picture; 0: all of it is seen
    double fits = 1;             ///< the zoom at which all is seen, as the panel last had it
    glm::dvec2 middle{0.5};      ///< what is in the middle, as shares of width and height
    bool failed_only = false;    ///< of the list
    ReviewOrder order = ReviewOrder::name;

    double scale() const { return zoom > 0 ? zoom : fits; }
};

/// One case, and what is known of it.
struct ReviewCase {
    enum class State { not_drawn, waiting, drawn };

    picture_tests::CaseFile file;
    State state = State::not_drawn;
    picture_tests::CaseResult result{};  ///< of what is drawn
    bool from_output = false;            ///< the picture is one that an earlier run left
    bool accepted = false;               ///< its fresh goldens are written
    bool viewed = false;                 ///< somebody has seen its pictures
    bool marked = false;                 ///< chosen, among several

    bool drawn() const { return state == State::drawn; }
    /// Passed, if its goldens were taken; only of what is drawn.
    picture_tests::CaseOutcome outcome() const;
    /// Drawn, and neither passed nor skipped.
    bool failing() const;
    /// Share of the pixels that differ, 0..1, also of one that passed; 1 where there is nothing to compare.
    double difference() const;
};

/// The pictures of one case. Null where there is none.
struct ReviewPictures {
    std::shared_ptr<const Image> golden, actual, difference;
    std::optional<ImageDiff> diff;      ///< without its heat map
    std::filesystem::path golden_file;  ///< that is compared: the case's own, or the one without text
    std::string why_not;                ///< a picture cannot be read; else empty
};

/// A folder of picture tests, and what an earlier `mobbscope test` left of them, the folder of its --output or the page
/// of its --html; empty: nothing.
struct ReviewFolder {
    std::filesystem::path folder, output;
    std::vector<picture_tests::CaseFile> cases;
    picture_tests::CaseReport report;
};
/// Throws InputError if there are no cases or no such report.
ReviewFolder find_review(const std::filesystem::path& folder, const std::filesystem::path& output = {});

/// A line for the person.
struct ReviewNews {
    MessageLevel level = MessageLevel::info;
    std::string text;
    std::string instead_of{};  ///< an earlier line that is over with this one; empty: none
};

class Review {
  public:
    /// What a review needs of the program around it.
    struct Surroundings {
        bool attended = true;                                                 ///< false: runs are waited for
        std::function<void()> wake{};                                         ///< from any thread: there is news
        std::function<void(const std::filesystem::path&)> check_may_write{};  ///< throws if that file may not be
        picture_tests::CaseDrawer drawer{};
        bool may_draw = true;  ///< false: in the window of a picture test, which must not start others
    };

    Review(ReviewFolder found, Surroundings surroundings);
    /// Ends the run and the process that draws.
    ~Review();
    Review(const Review&) = delete;
    Review& operator=(const Review&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    std::string title() const { return own_name(folder_); }
    const std::filesystem::path& output() const { return output_; }
    const picture_tests::CaseDrawer& drawer() const { return surroundings_.drawer; }
    const std::vector<ReviewCase>& cases() const { return cases_; }
    picture_tests::Summary summary() const;  ///< of those that are drawn
    ReviewLook look;

    // Which one: until somebody chooses one, the first that fails.
    std::size_t current() const { return current_; }
    const ReviewCase& shown() const { return cases_[current_]; }
    void show(std::size_t index);
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
    /// Those that somebody has looked at and that can be accepted.
    std::vector<std::size_t> viewed() const;
    /// Of the case that is shown, unpacked; counts as seen.
    const ReviewPictures& pictures();

    // Runs.
    /// Draws them anew, beside the window.
    void draw(const std::vector<std::size_t>& indices);
    void draw_all();
    /// The run; null: none is under way.
    const Job* run() const { return job_.get(); }
    bool drawing() const { return job_ != nullptr; }
    /// Ends the run and the process that draws.
    void cancel();
    /// Takes in what was drawn; call it before each frame. Returns what to tell the person.
    std::vector<ReviewNews> poll();

    // Goldens.
    /// Why the case's picture cannot become its golden; empty if it can.
    std::string why_not_accept(std::size_t index) const;
    /// Those that can be: their pictures become goldens, as `mobbscope test --update` makes them, and undo takes all
    /// back at once. Returns what it did. Throws std::invalid_argument if it can be done with none; InputError and
    /// MachineError if nothing could be written.
    std::vector<ReviewNews> accept(const std::vector<std::size_t>& indices);
    bool has_undo() const { return done_ > 0; }
    bool has_redo() const { return done_ < steps_.size(); }
    /// ... and none of the step's cases is being drawn: it would be held against goldens that are not there any more.
    bool can_undo() const { return has_undo() && !waits(steps_[done_ - 1]); }
    bool can_redo() const { return has_redo() && !waits(steps_[done_]); }
    std::string undo_title() const { return has_undo() ? steps_[done_ - 1].title : ""; }
    std::string redo_title() const { return has_redo() ? steps_[done_].title : ""; }
    /// The very bytes of before, or of after. Require can_undo() or can_redo(). Throw InputError if a golden was
    /// changed by somebody else meanwhile, MachineError: nothing is changed then. Return what was done.
    ReviewNews undo();
    ReviewNews redo();

  private:
    /// Goldens that were taken together.
    struct Step {
        std::string title;
        std::string said;  ///< of it last
        struct Taken {
            std::size_t index;
            picture_tests::CaseResult before;  ///< whose fresh goldens were written
        };
        std::vector<Taken> taken;
    };
    /// What a run's thread hands over.
    struct Results {
        std::mutex mutex;
        std::vector<picture_tests::CaseResult> ready;
    };

    void read_output(const picture_tests::CaseReport& report);
    void show_first_failing();
    void take_in(const picture_tests::CaseResult& result);
    /// Writes the goldens of the cases, as one step; those that refuse are left out of it, and said.
    std::vector<ReviewNews> write(const std::vector<std::size_t>& indices);
    void show_some_of(const Step& step);
    bool waits(const Step& step) const;
    void end_run();
    void changed(std::size_t index);

    std::filesystem::path folder_, output_;
    Surroundings surroundings_;
    std::vector<ReviewCase> cases_;
    std::size_t current_ = 0;
    bool chosen_ = false;         ///< somebody wants that one
    bool found_failing_ = false;  ///< ... or it is the first that failed: it stays when an earlier one fails too
    std::optional<std::size_t> unpacked_;
    ReviewPictures pictures_;
    std::vector<Step> steps_;
    std::size_t done_ = 0;  ///< steps that are not undone
    std::shared_ptr<Results> results_;
    std::unique_ptr<Job> job_;
};

}  // namespace mobbscope::app
