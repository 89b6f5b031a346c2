#include <app/document/visited_steps.h>

#include <cstddef>
#include <cstdlib>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostVisits = 500;

/// 1 or -1 of a single step, else 0.
int way_of(const std::optional<VisitedStep>& from, const std::optional<VisitedStep>& to) {
    if (!from || !to || from->of != to->of) return 0;
    const int by = to->step - from->step;
    return std::abs(by) == 1 ? by : 0;
}

}  // namespace

void VisitedSteps::moved(const std::optional<VisitedStep>& from, const std::optional<VisitedStep>& to, bool goes_on) {
    if (from == to) return;
    const int way = way_of(from, to);
    const bool joins = from && from == arrived_ && (goes_on || (way != 0 && way == way_));
    way_ = way;
    arrived_ = to;
    after.clear();
    if (!from || joins || (!before.empty() && before.back() == *from)) return;
    before.push_back(*from);
    if (before.size() > kMostVisits) before.erase(before.begin());
}

}  // namespace mobbscope::app
