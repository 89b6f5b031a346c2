/// The way back, and forward again, through the steps of queries that were looked at. A run of single steps in one
/// direction is one visit, and so is a drag: the way leads to where they began and ended.
#pragma once

#include <app/document/document.h>

#include <optional>
#include <vector>

namespace mobbscope::app {

struct VisitedStep {
    StepKey of;
    int step = 0;
    friend bool operator==(const VisitedStep&, const VisitedStep&) = default;
};

struct VisitedSteps {
    std::vector<VisitedStep> before{}, after{};  ///< the nearest last

    /// One looks at another step now; none: at no query. `goes_on`: in the interaction of the last move.
    void moved(const std::optional<VisitedStep>& from, const std::optional<VisitedStep>& to, bool goes_on);

  private:
    int way_ = 0;                           ///< of the run that the last move was of; 0: of none
    std::optional<VisitedStep> arrived_{};  ///< where it led
};

}  // namespace mobbscope::app
