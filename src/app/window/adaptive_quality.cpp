#include <app/window/adaptive_quality.h>

#include <algorithm>

namespace mobbscope::app {

namespace {

/// The least that keeps within kCoarse if one by `divisor` took so long: pixels are what it costs.
int divisor_for(double seconds, int divisor) {
    int out = 1;
    const double all = seconds * divisor * divisor;
    while (out < AdaptiveQuality::kCoarsest && all / (out * out) > AdaptiveQuality::kCoarse) ++out;
    return out;
}

}  // namespace

void AdaptiveQuality::painted_fine(Needs needed, double seconds) {
    fine_seconds_[index(needed)] = seconds;
    coarse_shown_ = false;
}

void AdaptiveQuality::painted_coarse(double seconds) {
    const int wanted = divisor_for(seconds, divisor_);
    // Within a drag pictures become coarser if they must, but not finer again: that would flicker.
    divisor_ = coarse_shown_ ? std::max(divisor_, wanted) : wanted;
    coarse_shown_ = true;
}

void AdaptiveQuality::gave_up_fine(Needs needed, double seconds) {
    double& expected = fine_seconds_[index(needed)];
    expected = std::max(expected, seconds);
}

}  // namespace mobbscope::app
