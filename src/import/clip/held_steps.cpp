#include <base/text.h>
#include <import/clip/held_steps.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace mobbscope {

namespace {

constexpr double kStepSlack = 1e-9;  // of rounding, as a share of the radius

std::string to_millimetres_or_less(double metres) {
    return brief(metres >= 0.01 ? std::round(metres * 1000) / 1000 : metres) + " m";
}

}  // namespace

std::optional<HeldStep> longest_held_step(const mobb::Clip& clip) {
    std::optional<HeldStep> longest;
    if (clip.motion() != mobb::Motion::held) return longest;
    const std::span<const mobb::Disk> samples = clip.samples();
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const mobb::Disk& from = samples[i - 1];
        const HeldStep step{static_cast<int>(i - 1), std::hypot(samples[i].x - from.x, samples[i].y - from.y), from.r};
        if (step.length <= step.radius * (1 + kStepSlack)) continue;
        if (!longest || step.length - step.radius > longest->length - longest->radius) longest = step;
    }
    return longest;
}

void warn_of_long_held_step(const mobb::Clip& clip, std::vector<ImportWarning>& warnings) {
    const std::optional<HeldStep> step = longest_held_step(clip);
    if (!step) return;
    warnings.push_back({"its disks are held, but it moves " + to_millimetres_or_less(step->length) + " from sample " +
                            std::to_string(step->sample) + " to the next, more than its radius of " +
                            to_millimetres_or_less(step->radius) +
                            ": what it meets in between goes unseen; give motion linear (--motion linear, or "
                            "\"motion\": \"linear\" in the scene)",
                        "motion"});
}

}  // namespace mobbscope
