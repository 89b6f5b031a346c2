#include <import/bvh/up_axis.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

constexpr std::size_t kMaxPoses = 200;              // that are looked at
constexpr std::size_t kMaxPosedJoints = 2'000'000;  // in all of them
constexpr double kAlike = 0.15;                     // share by which the bones of left and right may differ
constexpr double kAlong = 0.7;                      // cosine: within 45 degrees

// Shares of poses. Of 74 published captures with y up none stands along z in any; turned to z up they do in half of the
// poses at least, climbers among them, and all but climbers in 0.8 at least.
constexpr double kHalf = 0.5;
constexpr double kMostly = 0.8;
constexpr double kHardly = 0.1;

// Shares of the body's length.
constexpr double kSteady = 0.25;       // how far the lowest joint goes up and down where a body walks
constexpr double kClimbs = 0.7;        // likewise where it climbs
constexpr double kOnFloor = 0.15;      // from the floor to the lowest joint
constexpr double kRise = 1;            // nobody who lies goes up by that much
constexpr double kLyingSteady = 0.1;   // how far the lowest joint of who lies goes up and down
constexpr double kLyingBelow = -0.06;  // and how deep it is
constexpr double kLyingHips = 0.03;    // hips of who lies are that high at least
constexpr double kMaxLyingHips = 0.3;
constexpr double kThick = 0.4;  // nobody who lies is as thick

/// Two joints below one, and all that is below them, which look like left and right.
struct Limbs {
    std::size_t parent = 0;
    std::array<std::size_t, 2> first{};
    std::size_t size = 0;  ///< joints in each; they follow the first one in the file

    bool hold(std::size_t joint) const {
        return std::ranges::any_of(first, [&](std::size_t at) { return joint >= at && joint < at + size; });
    }
};

/// Legs and arms of a body, by nothing but how its bones hang together: names have many languages.
struct Body {
    Limbs legs;                        ///< those that begin nearest to the ROOT; of several the longest
    std::optional<std::size_t> chest;  ///< where the longest of the others begin, the arms; none: there are no others
};

class LimbSearch {
  public:
    explicit LimbSearch(const BvhMotion& motion) {
        const std::span<const Joint> joints = motion.joints();
        children_.resize(joints.size());
        bones_.resize(joints.size());
        size_.resize(joints.size(), 1);
        depth_.resize(joints.size());
        for (std::size_t i = joints.size(); i-- > 1;) {
            const auto parent = static_cast<std::size_t>(joints[i].parent);
            bones_[i] += glm::length(motion.offset(i));
            bones_[parent] += bones_[i];
            size_[parent] += size_[i];
            children_[parent].push_back(i);
        }
        for (std::size_t i = 1; i < joints.size(); ++i)
            depth_[i] = depth_[static_cast<std::size_t>(joints[i].parent)] + 1;
    }

    /// None where nothing looks like legs.
    std::optional<Body> body() const {
        const std::vector<Limbs> all = limbs();
        const auto longer = [this](const Limbs& a, const Limbs& b) { return length(a) < length(b); };
        const auto legs = std::ranges::max_element(all, [&](const Limbs& a, const Limbs& b) {
            return depth_[a.parent] != depth_[b.parent] ? depth_[a.parent] > depth_[b.parent] : longer(a, b);
        });
        if (legs == all.end()) return std::nullopt;
        std::vector<Limbs> others;
        std::ranges::copy_if(all, std::back_inserter(others),
                             [&](const Limbs& it) { return it.parent != legs->parent && !legs->hold(it.parent); });
        const auto arms = std::ranges::max_element(others, longer);
        return Body{*legs, arms == others.end() ? std::nullopt : std::optional(arms->parent)};
    }

  private:
    double length(const Limbs& limbs) const { return bones_[limbs.first[0]]; }

    /// The longest two that are alike below each joint.
    std::vector<Limbs> limbs() const {
        std::vector<Limbs> out;
        for (std::size_t i = 0; i < children_.size(); ++i) {
            std::vector<std::size_t> by_length = children_[i];
            std::ranges::sort(by_length, {}, [this](std::size_t child) { return -bones_[child]; });
            for (std::size_t k = 1; k < by_length.size(); ++k) {
                const std::size_t a = by_length[k - 1], b = by_length[k];
                if (size_[a] != size_[b] || bones_[b] < (1 - kAlike) * bones_[a]) continue;
                out.push_back({i, {a, b}, size_[a]});
                break;
            }
        }
        return out;
    }

    std::vector<std::vector<std::size_t>> children_;
    std::vector<double> bones_;  ///< of each joint and all below it, in all
    std::vector<std::size_t> size_;
    std::vector<int> depth_;
};

/// What all poses of a body say of one axis of the file.
struct AxisEvidence {
    double stands = 0;    ///< share of the poses: legs down and trunk up along the axis
    double upright = 0;   ///< likewise: trunk up along it, feet anywhere below the hips
    double height = 0;    ///< median extent along it, file units
    double lowest = 0;    ///< of the lowest joint, in all but the deepest 10 % of the poses
    double unsteady = 0;  ///< how far the lowest joint goes in the middle 80 % of the poses
    double hips = 0;      ///< median
    double way = 0;       ///< how far the hips go along it
    bool rests = false;   ///< the body stands along it where all angles are 0
};

double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

/// From the hips to the legs and to the chest.
struct Stance {
    glm::dvec3 legs{0}, trunk{0};

    bool upright(int axis) const { return trunk[axis] > kAlong * glm::length(trunk) && legs[axis] < 0; }
    bool stands(int axis) const { return upright(axis) && -legs[axis] > kAlong * glm::length(legs); }
};

Stance stance_of(const Body& body, std::span<const glm::dvec3> positions) {
    Stance out;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 place = positions[i] - positions[body.legs.parent];
        (body.legs.hold(i) ? out.legs : out.trunk) += place;
    }
    // Only their directions are asked for, so sums are as good as means.
    if (body.chest) out.trunk = positions[*body.chest] - positions[body.legs.parent];
    return out;
}

/// For y and z. None if no pose is at finite places.
std::optional<std::array<AxisEvidence, 2>> evidence_of(const BvhMotion& motion, const Body& body) {
    const std::size_t joints = motion.joints().size();
    std::vector<glm::dvec3> positions(joints);
    for (std::size_t i = 0; i < joints; ++i) {
        const int parent = motion.joints()[i].parent;
        positions[i] = motion.offset(i) + (parent < 0 ? glm::dvec3(0) : positions[static_cast<std::size_t>(parent)]);
    }
    std::array<AxisEvidence, 2> out;
    for (int axis : {1, 2}) out[static_cast<std::size_t>(axis - 1)].rests = stance_of(body, positions).stands(axis);

    const MotionTimes& times = motion.times();
    const auto frames = static_cast<std::size_t>(times.frames);
    const std::size_t poses = std::clamp<std::size_t>(kMaxPosedJoints / joints, 1, std::min(frames, kMaxPoses));
    std::array<std::vector<double>, 2> low, height, hips;
    for (std::size_t k = 0; k < poses; ++k) {
        const std::size_t frame = poses == 1 ? 0 : k * (frames - 1) / (poses - 1);
        motion.pose(static_cast<double>(frame) * *times.dt, positions, {});
        const bool finite =
            std::ranges::all_of(positions, [](const glm::dvec3& p) { return std::isfinite(p.x + p.y + p.z); });
        if (!finite) continue;
        const Stance stance = stance_of(body, positions);
        for (std::size_t i = 0; i < 2; ++i) {
            const int axis = static_cast<int>(i) + 1;
            const auto [least, most] =
                std::ranges::minmax(positions, {}, [axis](const glm::dvec3& p) { return p[axis]; });
            low[i].push_back(least[axis]);
            height[i].push_back(most[axis] - least[axis]);
            hips[i].push_back(positions[body.legs.parent][axis]);
            out[i].stands += stance.stands(axis) ? 1 : 0;
            out[i].upright += stance.upright(axis) ? 1 : 0;
        }
    }
    if (low[0].empty()) return std::nullopt;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto count = static_cast<double>(low[i].size());
        out[i].stands /= count;
        out[i].upright /= count;
        out[i].lowest = quantile(low[i], 0.1);
        out[i].unsteady = quantile(low[i], 0.9) - out[i].lowest;
        out[i].height = quantile(height[i], 0.5);
        const auto [least, most] = std::ranges::minmax(hips[i]);
        out[i].way = most - least;
        out[i].hips = quantile(hips[i], 0.5);
    }
    return out;
}

enum class Told { nothing, y, z, perhaps_z };

Told told_by(const BvhMotion& motion) {
    const std::optional<Body> body = LimbSearch(motion).body();
    const auto evidence = body ? evidence_of(motion, *body) : std::nullopt;
    if (!evidence) return Told::nothing;
    const auto& [y, z] = *evidence;
    if (y.upright > kHardly) return y.stands >= kHalf ? Told::y : Told::nothing;
    if (z.upright < kHalf) return Told::nothing;

    // This is somebody who stands, z up, or who lies along z, y up. Where the offsets stand along z too it hardly lies.
    const double length = z.height;
    const bool rises = y.way >= kRise * length && z.unsteady <= kClimbs * length;
    const bool on_floor =
        z.stands >= kMostly && z.unsteady <= kSteady * length && std::abs(z.lowest) <= kOnFloor * length;
    const bool lies = y.unsteady <= kLyingSteady * length && y.lowest >= kLyingBelow * length &&
                      y.hips >= kLyingHips * length && y.hips <= kMaxLyingHips * length && y.height <= kThick * length;
    const bool tells = z.rests ? on_floor || !lies : on_floor && !lies;
    if (rises || tells) return Told::z;
    return z.stands >= kHalf ? Told::perhaps_z : Told::nothing;
}

}  // namespace

GuessedUp guess_up(std::span<const std::shared_ptr<const BvhMotion>> characters) {
    bool y = false, z = false, perhaps_z = false;
    for (const auto& character : characters) {
        const Told told = told_by(*character);
        y = y || told == Told::y;
        z = z || told == Told::z;
        perhaps_z = perhaps_z || told == Told::perhaps_z;
    }
    if (z && !y) return {kZUp, "guessed: the body stands along z", ""};
    if (y) return {kYUp, "guessed: the body stands along y", ""};
    return {kYUp, "as in most files",
            perhaps_z ? "the body lies along z, as y is taken to be up; if it stands, give up z" : ""};
}

}  // namespace mobbscope
