/// Cases that are drawn anew, beside the window.
#pragma once

#include <app/document/job.h>
#include <app/document/message_level.h>
#include <cases/case_result.h>
#include <cases/drawing_child.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace mobbscope::app {

class Review;

/// What a review needs of the program around it.
struct ReviewSurroundings {
    bool attended = true;                                                 ///< false: runs are waited for
    std::function<void()> wake{};                                         ///< from any thread: there is news
    std::function<void(const std::filesystem::path&)> check_may_write{};  ///< throws if that file may not be
    picture_tests::CaseDrawer drawer{};
    bool may_draw = true;  ///< false: in the window of a picture test, which must not start others
};

/// A line for the person.
struct ReviewNews {
    MessageLevel level = MessageLevel::info;
    std::string text;
    std::string instead_of{};  ///< an earlier line that is over with this one; empty: none
};

class CaseRun {
  public:
    CaseRun(Review& review, const ReviewSurroundings& surroundings) : review_(review), surroundings_(surroundings) {}

    const picture_tests::CaseDrawer& drawer() const { return surroundings_.drawer; }
    /// Draws them anew, beside the window. Throws std::invalid_argument if others are being drawn, InputError where
    /// none may be.
    void draw(const std::vector<std::size_t>& indices);
    void draw_all();
    /// Null: none is under way.
    const Job* job() const { return job_.get(); }
    bool drawing() const { return job_ != nullptr; }
    /// Ends the run and the process that draws.
    void cancel();
    /// Takes in what was drawn; call it before each frame. Returns what to tell the person.
    std::vector<ReviewNews> poll();

  private:
    /// What a run's thread hands over.
    struct Results {
        std::mutex mutex;
        std::vector<picture_tests::CaseResult> ready;
    };

    void take_in(const picture_tests::CaseResult& result);
    void end();

    Review& review_;
    const ReviewSurroundings& surroundings_;
    std::shared_ptr<Results> results_;
    std::unique_ptr<Job> job_;
};

}  // namespace mobbscope::app
