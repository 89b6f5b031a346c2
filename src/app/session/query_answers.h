/// Which queries of the scene hit, found out beside the window: a scene may ask hundreds of thousands.
#pragma once

#include <app/document/workspace.h>
#include <app/session/desktop.h>
#include <app/session/session_options.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace mobbscope::app {

class QueryAnswers {
  public:
    QueryAnswers(Workspace& workspace, const SessionOptions& options, Desktop*& desktop)
        : workspace_(workspace), options_(options), desktop_(desktop) {}
    ~QueryAnswers() { end_work(); }
    QueryAnswers(const QueryAnswers&) = delete;
    QueryAnswers& operator=(const QueryAnswers&) = delete;

    /// Whoever shows the list calls this before each frame: a changed scene is asked anew.
    void update();
    struct Known {
        std::size_t asked = 0;  ///< the first so many
        std::vector<int> hits;  ///< of these, in order
    };
    /// As far as it is known, never null. The same pointer as long as nothing more is known.
    const std::shared_ptr<const Known>& known() const;
    void end_work();

  private:
    struct Made;

    Workspace& workspace_;
    const SessionOptions& options_;
    Desktop*& desktop_;
    std::shared_ptr<const FittedScene> of_;
    std::shared_ptr<Made> made_;
    mutable std::shared_ptr<const Known> known_ = std::make_shared<const Known>();  ///< as somebody last asked
    std::unique_ptr<Job> job_;
};

}  // namespace mobbscope::app
