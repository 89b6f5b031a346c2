#include <base/median.h>
#include <base/text.h>
#include <import/skeleton/motion_clips.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace mobbscope {

namespace {

// Found on 74 published captures: what was never a motion lies far beyond these, what people do lies well within.
constexpr double kJump = 0.1;           // m that a step exceeds the steps around it by, at least
constexpr double kJumpSpeed = 3;        // m/s likewise; people gain 0.9 from step to step at 30 Hz
constexpr std::size_t kJumpWindow = 4;  // steps looked at on each side
constexpr double kPoseChange = 0.12;    // m that a T-pose is wider than the next pose; people: 0.07
constexpr double kPoseShare = 1.35;     // and wider than the median pose by that factor
constexpr double kPoseTime = 1.0 / 30;  // s until the next pose
constexpr double kInPlace = 0.1;        // m: the extent of a path that goes nowhere
constexpr double kFastest = 12.5;       // m/s: a sprinter's peak
constexpr double kMinRadius = 0.1;      // m: of the median pose
constexpr double kMaxRadius = 1.5;
constexpr double kBelowFloor = 0.1;  // m
constexpr double kMinHeight = 1.1;   // m: of a body whose height gave the unit
constexpr double kMaxHeight = 2.3;

/// Three decimals: millimetres, milliseconds.
std::string rounded(double value) { return format_double(std::round(value * 1000) / 1000); }

/// The sample that shows what comes after the first pose.
std::size_t next_pose(const mobb::Clip& clip) {
    return std::max<std::size_t>(static_cast<std::size_t>(std::lround(kPoseTime / clip.dt())), 1);
}

class Inspection {
  public:
    Inspection(const mobb::Clip& clip, double begin, SourceFacts& facts)
        : clip_(clip), samples_(clip.samples()), begin_(begin), facts_(facts) {
        for (std::size_t i = 1; i < samples_.size(); ++i) {
            steps_.push_back(std::hypot(samples_[i].x - samples_[i - 1].x, samples_[i].y - samples_[i - 1].y));
        }
        for (const mobb::Disk& disk : samples_) radii_.push_back(disk.r);
    }

    void first_pose() {
        if (!begins_in_other_pose(clip_)) return;
        const std::size_t next = next_pose(clip_);
        say("sample 0" + file_frames(0, 0) +
                " is a pose that the motion does not begin with, such as a T-pose: its radius is " +
                rounded(radii_.front()) + " m, that of sample " + std::to_string(next) + " " + rounded(radii_[next]) +
                " m; begin later with trim",
            "trim");
    }

    void jumps() {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            if (steps_[i] - usual_step(i) <= std::max(kJump, kJumpSpeed * clip_.dt())) continue;
            // A jump in the middle of a sampling step, or one there and back, shows in two steps.
            if (found.empty() || found.back() + 1 < i) {
                found.push_back(i);
            } else if (steps_[i] > steps_[found.back()]) {
                found.back() = i;
            }
        }
        if (found.empty()) return;
        const std::size_t largest = *std::max_element(
            found.begin(), found.end(), [this](std::size_t a, std::size_t b) { return steps_[a] < steps_[b]; });
        const std::string where = rounded(steps_[largest]) + " m from sample " + std::to_string(largest) + " to " +
                                  std::to_string(largest + 1) + file_frames(largest, largest + 1) + ", at " +
                                  rounded(begin_ + static_cast<double>(largest) * clip_.dt()) + " s";
        if (found.size() == 1) {
            say("the path jumps " + where, "trim");
        } else {
            say("the path jumps " + std::to_string(found.size()) + " times, first after sample " +
                    std::to_string(found.front()) + file_frames(found.front(), found.front()) + ", farthest " + where,
                "trim");
        }
    }

    void in_place() {
        if (samples_.size() < 2) return;
        const auto [left, right] = std::minmax_element(samples_.begin(), samples_.end(),
                                                       [](const auto& a, const auto& b) { return a.x < b.x; });
        const auto [front, back] = std::minmax_element(samples_.begin(), samples_.end(),
                                                       [](const auto& a, const auto& b) { return a.y < b.y; });
        const double extent = std::hypot(right->x - left->x, back->y - front->y);
        if (extent < kInPlace) say("the path stays within " + rounded(extent) + " m: an animation in place");
    }

    void speed() {
        if (steps_.empty()) return;
        const double usual = median(steps_) / clip_.dt();
        if (usual > kFastest) {
            say("the usual speed is " + rounded(usual) + " m/s, which no person reaches; check unit and frame time",
                "unit");
        }
    }

    void size() {
        const double radius = median(radii_);
        if (radius < kMinRadius || radius > kMaxRadius) {
            say("the usual radius is " + rounded(radius) + " m, which no person has; check unit and root", "unit");
        }
        const std::optional<double>& height = facts_.guessed_from_height;
        if (height && (*height < kMinHeight || *height > kMaxHeight)) {
            say("no usual unit makes the body's height plausible (" + rounded(*height) +
                    " m with that taken); give unit",
                "unit");
        }
    }

    void height(const Skeleton& skeleton) {
        std::vector<double> heights;
        for (int i = 0; i < clip_.count(); ++i) {
            heights.push_back(skeleton.at(i)[static_cast<std::size_t>(skeleton.root)].z);
        }
        const double usual = median(std::move(heights));
        if (usual < -kBelowFloor)
            say("the root is usually " + rounded(-usual) + " m below the floor; check up and root", "up");
    }

  private:
    /// `option`: the one that mends it.
    void say(std::string warning, const char* option = "") { facts_.warnings.push_back({std::move(warning), option}); }

    /// " (file frames 0 and 4)" where the file's frames are uniform.
    std::string file_frames(std::size_t first, std::size_t last) const {
        if (!facts_.dt) return "";
        const auto frame = [this](std::size_t sample) {
            return std::to_string(std::lround((begin_ + static_cast<double>(sample) * clip_.dt()) / *facts_.dt));
        };
        return first == last ? " (file frame " + frame(first) + ")"
                             : " (file frames " + frame(first) + " and " + frame(last) + ")";
    }

    /// The median of the steps around a step, metres.
    double usual_step(std::size_t step) const {
        const std::size_t from = step - std::min(step, kJumpWindow);
        const std::size_t to = std::min(step + kJumpWindow + 1, steps_.size());
        std::vector<double> around;
        for (std::size_t i = from; i < to; ++i) {
            if (i != step) around.push_back(steps_[i]);
        }
        return around.empty() ? 0 : median(std::move(around));
    }

    const mobb::Clip& clip_;
    std::span<const mobb::Disk> samples_;
    double begin_;
    SourceFacts& facts_;
    std::vector<double> steps_;  ///< metres from each sample to the next
    std::vector<double> radii_;
};

}  // namespace

bool begins_in_other_pose(const mobb::Clip& clip) {
    const std::size_t next = next_pose(clip);
    if (next >= clip.samples().size()) return false;
    std::vector<double> radii;
    for (const mobb::Disk& disk : clip.samples()) radii.push_back(disk.r);
    const double first = radii.front();
    const double change = first - radii[next];
    return first >= kPoseShare * median(std::move(radii)) && change >= kPoseChange;
}

void add_motion_warnings(const mobb::Clip& clip, std::optional<double> cut_at, const Skeleton* skeleton,
                         SourceFacts& facts) {
    Inspection inspection(clip, cut_at.value_or(0), facts);
    inspection.first_pose();
    inspection.jumps();
    if (!cut_at) inspection.in_place();
    inspection.speed();
    inspection.size();
    if (skeleton) inspection.height(*skeleton);
}

}  // namespace mobbscope
