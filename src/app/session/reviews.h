/// The picture tests that are looked at, in place of the scene.
#pragma once

#include <app/document/review.h>
#include <app/session/files.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace mobbscope::app {

class Reviews : public Screen {
  public:
    Reviews(Files& files, Jobs& jobs, Playback& playback, Notifications& notifications, const SessionOptions& options,
            Desktop*& desktop, Screen*& screen)
        : files_(files),
          jobs_(jobs),
          playback_(playback),
          notifications_(notifications),
          options_(options),
          desktop_(desktop),
          screen_(screen) {}

    picture_tests::CaseDrawer case_drawer;  ///< what draws the cases
    /// Shows picture tests in place of the scene, and draws them, unless an `output` of theirs is to be looked at.
    /// Those of a folder that was looked at before begin at the case that was chosen then, if one was.
    void open(const ReviewFolder& found);
    /// Throws InputError as find_review does.
    void open(const std::filesystem::path& folder, const std::filesystem::path& output = {}) {
        open(find_review(folder, output));
    }
    /// Those that are looked at, shown or not; null if there are none.
    Review* review() { return review_.get(); }
    const Review* review() const { return review_.get(); }
    /// Whether they are shown: commands and panels are about them then, not about the scene.
    bool shown() const { return screen_ == this; }
    std::string title() const override { return review_->title(); }
    /// Shows what was open before the picture tests; asks about unsaved changes of a case's scene.
    void leave();
    /// Shows them again. Requires review().
    void back();
    /// Ends their run, if there is one, and says so.
    void cancel_run();
    /// Opens what a case draws as a scene; what is open is put aside until that scene is left.
    void open_case(std::size_t index);
    /// Takes in what was drawn.
    void poll();

  private:
    Files& files_;
    Jobs& jobs_;
    Playback& playback_;
    Notifications& notifications_;
    const SessionOptions& options_;
    Desktop*& desktop_;
    Screen*& screen_;
    std::shared_ptr<Review> review_;
};

}  // namespace mobbscope::app
