/// The picture tests that are looked at, in place of the scene.
#pragma once

#include <app/commands/command.h>
#include <review/review.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::app {

class ReviewScreen final : public Screen {
  public:
    explicit ReviewScreen(Session& session) : session_(session) {}

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
    bool shown() const { return session_.screen == this; }
    /// Shows what was open before the picture tests; asks about unsaved changes of a case's scene.
    void leave();
    /// Shows them again. Requires review().
    void back();
    void tell(const ReviewNews& news);
    /// Opens what a case draws as a scene; what is open is suspended until that scene is left.
    void open_case(std::size_t index);

    const ScreenWords& words() const override;
    std::string title() const override { return review_->title(); }
    std::string counts() const override;
    std::vector<Command> commands() const override;
    const Situation& situation() const override;
    std::vector<NamedThing> things() const override;
    std::array<ScreenPanel, 3> panels() override;
    void draw_above_scene(Ui& ui) override;
    /// While there are picture tests: "review": {"shown", "folder", "cases": {NAME: outcome, "waiting" or "not drawn"},
    /// "listed": [NAME], "marked": [NAME], "case", "outcome", "accepted", "mode", "blink_seconds", "divider", "zoom",
    /// "middle", "failed_only", "order", "drawing", "undo", "redo", "open_case"}.
    void add_state(nlohmann::ordered_json& state) const override;
    std::any look() const override { return review_->look; }
    void restore(const std::any& look) override { review_->look = std::any_cast<const ReviewLook&>(look); }
    void poll() override;
    const Job* work() const override { return review_ ? review_->run.job() : nullptr; }
    void cancel() override;
    void end_work() override;

  private:
    Session& session_;
    std::shared_ptr<Review> review_;
    std::optional<glm::ivec2> pixel_;  ///< of the pictures, under the mouse
};

/// Its rows of the table of commands.
std::vector<Command> review_commands();

/// The session can show picture tests from now on.
ReviewScreen& add_review(Session& session);
/// All commands of such a session, for scripts that are read before there is one.
std::span<const Command> commands_with_review();

}  // namespace mobbscope::app
