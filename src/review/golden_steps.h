/// Goldens that are taken and given back, in steps.
#pragma once

#include <review/case_run.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mobbscope::app {

class GoldenSteps {
  public:
    GoldenSteps(Review& review, const ReviewSurroundings& surroundings)
        : review_(review), surroundings_(surroundings) {}

    /// Those that can be (Review::why_not_accept): their pictures become goldens, as `mobbscope test --update` makes
    /// them, and undo takes all back at once. A case that a report brings itself is taken only where it alone is
    /// accepted, while it is shown. Returns what it did. Throws std::invalid_argument if it can be done with none;
    /// InputError and MachineError if nothing could be written.
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

    /// Writes the goldens of the cases, as one step; those that refuse are left out of it, and said.
    std::vector<ReviewNews> write(const std::vector<std::size_t>& indices);
    bool waits(const Step& step) const;
    /// The step's cases stand as before it, or after; one of them is shown. Returns what to say in place of what was
    /// said of the step before.
    ReviewNews stand(Step& step, bool accepted, const std::string& what);

    Review& review_;
    const ReviewSurroundings& surroundings_;
    std::vector<Step> steps_;
    std::size_t done_ = 0;  ///< steps that are not undone
};

}  // namespace mobbscope::app
