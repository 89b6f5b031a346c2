#include <explain/bodies.h>
#include <import/skeleton/disk_sampler.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace mobbscope {

namespace {

/// At both ends exactly the segment's own.
glm::dvec3 point_at(const Segment& segment, double s) {
    if (s <= 0) return segment.from;
    if (s >= 1) return segment.to;
    return segment.from + s * (segment.to - segment.from);
}

glm::dvec3 nearest_point(const Segment& segment, glm::dvec3 to) {
    const glm::dvec3 along = segment.to - segment.from;
    const double squared = glm::dot(along, along);
    return point_at(segment, squared > 0 ? glm::dot(to - segment.from, along) / squared : 0);
}

Segment segment_at(const Segment& first, const Segment& last, double s) {
    return {point_at({first.from, last.from}, s), point_at({first.to, last.to}, s)};
}

/// Two bones over a time: s runs from 0 to 1, and each end straight with it.
struct BonePair {
    const Segment &a0, &a1, &b0, &b1;

    SegmentDistance at(double s) const { return distance_of(segment_at(a0, a1, s), segment_at(b0, b1, s)); }

    /// The distance changes by no more than this from s = 0 to 1: any two points of the bones do not move faster
    /// against each other than some two ends.
    double speed() const {
        double out = 0;
        for (const glm::dvec3& a : {a1.from - a0.from, a1.to - a0.to}) {
            for (const glm::dvec3& b : {b1.from - b0.from, b1.to - b0.to}) out = std::max(out, glm::length(a - b));
        }
        return out;
    }
};

/// The least distance of two skeletons over a time.
class LeastDistance {
  public:
    LeastDistance(std::span<const Segment> a0, std::span<const Segment> a1, std::span<const Segment> b0,
                  std::span<const Segment> b1)
        : a0_(a0), a1_(a1), b0_(b0), b1_(b1) {
        for (std::size_t i = 0; i < a0.size(); ++i) {
            const Ball ball = ball_of(a0[i]);
            for (std::size_t j = 0; j < b0.size(); ++j) {
                const BonePair pair = this->pair(i, j);
                const double speed = pair.speed();
                if (apart(ball, ball_of(b0[j])) - speed < found.distance) look_at(pair, i, j, speed);
            }
        }
    }

    BonePair pair(std::size_t i, std::size_t j) const { return {a0_[i], a1_[i], b0_[j], b1_[j]}; }

    SegmentDistance found{std::numeric_limits<double>::infinity(), {}, {}};
    double s = 0;
    std::size_t a = 0, b = 0;  ///< the bones

  private:
    struct Ball {
        glm::dvec3 middle;
        double radius;
    };
    static Ball ball_of(const Segment& bone) {
        return {0.5 * (bone.from + bone.to), 0.5 * glm::length(bone.to - bone.from)};
    }
    static double apart(const Ball& a, const Ball& b) { return glm::length(a.middle - b.middle) - a.radius - b.radius; }

    double take(const BonePair& pair, std::size_t i, std::size_t j, double at) {
        const SegmentDistance distance = pair.at(at);
        if (distance.distance < found.distance) found = distance, s = at, a = i, b = j;
        return distance.distance;
    }

    /// Halves the time until what is left out is no nearer than the tolerance.
    void look_at(const BonePair& pair, std::size_t i, std::size_t j, double speed) {
        const double at_begin = take(pair, i, j, 0);
        if (speed == 0) return;
        struct Part {
            double begin, end, at_begin, at_end;
        };
        std::vector<Part> left{{0, 1, at_begin, take(pair, i, j, 1)}};
        while (!left.empty()) {
            const Part part = left.back();
            left.pop_back();
            const double least = 0.5 * (part.at_begin + part.at_end - speed * (part.end - part.begin));
            if (std::max(least, 0.0) >= found.distance - kBodyTolerance) continue;
            const double middle = 0.5 * (part.begin + part.end);
            const double at_middle = take(pair, i, j, middle);
            left.push_back({middle, part.end, at_middle, part.at_end});
            left.push_back({part.begin, middle, part.at_begin, at_middle});
        }
    }

    std::span<const Segment> a0_, a1_, b0_, b1_;
};

/// The first s at which a pair is nearer than `reach`, found by steps that pass over none; `most` if there is none
/// before.
double first_nearer(const BonePair& pair, double reach, double most) {
    const double speed = pair.speed();
    double s = 0;
    while (s < most) {
        const double free = pair.at(s).distance - reach;
        if (free < 0) return s;
        if (speed == 0) break;
        s += std::max(free, kBodyTolerance) / speed;
    }
    return most;
}

/// When capsules first overlap in a step in which they do.
NearestBones first_touch(const PlacedBody& a, const PlacedBody& b, const BodyStep& step, double bone_radius) {
    const std::vector<Segment> a0 = a.place(step.a_sample, step.t0), a1 = a.place(step.a_sample, step.t1);
    const std::vector<Segment> b0 = b.place(step.b_sample, step.t0), b1 = b.place(step.b_sample, step.t1);
    const double length = step.t1 - step.t0;
    double first = length > 0 ? (step.nearest.time - step.t0) / length : 0;
    for (std::size_t i = 0; i < a0.size() && first > 0; ++i) {
        for (std::size_t j = 0; j < b0.size(); ++j)
            first = first_nearer({a0[i], a1[i], b0[j], b1[j]}, 2 * bone_radius, first);
    }
    return nearest_bones(a, step.a_sample, b, step.b_sample, std::min(step.t0 + first * length, step.nearest.time),
                         bone_radius);
}

void add_interval(std::vector<mobb::Interval>& intervals, double t0, double t1) {
    // As of disks: pairs that share less are never tested.
    if (!intervals.empty() && t0 - intervals.back().t1 <= mobb::kMinOverlap) {
        intervals.back().t1 = t1;
    } else {
        intervals.push_back({t0, t1});
    }
}

}  // namespace

std::vector<SkeletonBone> bones_of(const Skeleton& skeleton) {
    const std::vector<bool> in_body = subtree(skeleton.joints, skeleton.root);
    std::vector<SkeletonBone> out;
    for (std::size_t i = 0; i < in_body.size(); ++i) {
        const int joint = static_cast<int>(i);
        if (in_body[i] && joint != skeleton.root) out.push_back({skeleton.joints[i].parent, joint});
    }
    if (out.empty()) out.push_back({skeleton.root, skeleton.root});
    return out;
}

std::string joint_words(const Skeleton& skeleton, int joint) {
    const Joint& it = skeleton.joints[static_cast<std::size_t>(joint)];
    if (!it.name.empty() || it.parent < 0) return it.name;
    return "the end of " + joint_words(skeleton, it.parent);
}

std::string bone_words(const Skeleton& skeleton, SkeletonBone bone) {
    const std::string from = joint_words(skeleton, bone.from);
    return bone.from == bone.to ? from : from + "\u2013" + joint_words(skeleton, bone.to);
}

SegmentDistance distance_of(const Segment& a, const Segment& b) {
    SegmentDistance out{std::numeric_limits<double>::infinity(), {}, {}};
    const auto consider = [&](glm::dvec3 on_a, glm::dvec3 on_b) {
        const double distance = glm::length(on_a - on_b);
        if (distance < out.distance) out = {distance, on_a, on_b};
    };
    // The nearest points are inside of both, or one is an end: then also of segments that are parallel or points.
    consider(a.from, nearest_point(b, a.from));
    consider(a.to, nearest_point(b, a.to));
    consider(nearest_point(a, b.from), b.from);
    consider(nearest_point(a, b.to), b.to);
    const glm::dvec3 u = a.to - a.from, v = b.to - b.from, w = a.from - b.from;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double uw = glm::dot(u, w), vw = glm::dot(v, w);
    const double across = uu * vv - uv * uv;
    if (across <= 0) return out;
    const double s = (uv * vw - vv * uw) / across, t = (uu * vw - uv * uw) / across;
    if (s > 0 && s < 1 && t > 0 && t < 1) consider(point_at(a, s), point_at(b, t));
    return out;
}

std::vector<Segment> PlacedBody::place(int sample, double time) const {
    const auto place_at = [&](int index, int joint) { return joint_place(skeleton_, clip_, index, joint); };
    const double begin = clip_.time(sample), end = clip_.time(sample + 1);
    const bool runs = clip_.is_linear() && sample + 1 < clip_.count();
    const double s = runs ? (time - begin) / (end - begin) : 0;
    std::vector<Segment> out;
    out.reserve(bones_.size());
    for (const SkeletonBone& bone : bones_) {
        const Segment now{place_at(sample, bone.from), place_at(sample, bone.to)};
        if (!runs) {
            out.push_back(now);
            continue;
        }
        out.push_back(segment_at(now, {place_at(sample + 1, bone.from), place_at(sample + 1, bone.to)}, s));
    }
    return out;
}

double PlacedBody::reach(int sample) const {
    const std::span<const glm::vec3> joints = skeleton_.at(sample);
    const auto distance = [&](int joint) {
        const glm::vec3& at = joints[static_cast<std::size_t>(joint)];
        return std::hypot(static_cast<double>(at.x), static_cast<double>(at.y));
    };
    double out = 0;
    for (const SkeletonBone& bone : bones_) out = std::max(out, distance(bone.to));
    return out;
}

mobb::SweptDisk PlacedBody::grown(int sample, double by) const {
    mobb::SweptDisk out = mobb::swept(clip_, sample);
    const int next = clip_.is_linear() ? std::min(sample + 1, clip_.count() - 1) : sample;
    out.from.r = std::max(out.from.r, reach(sample)) + by;
    out.to.r = std::max(out.to.r, reach(next)) + by;
    return out;
}

NearestBones nearest_bones(const PlacedBody& a, int a_sample, const PlacedBody& b, int b_sample, double time,
                           double bone_radius) {
    const std::vector<Segment> of_a = a.place(a_sample, time), of_b = b.place(b_sample, time);
    const LeastDistance least(of_a, of_a, of_b, of_b);
    return {time,         least.found.distance - 2 * bone_radius, a.bones()[least.a], b.bones()[least.b], least.found.a,
            least.found.b};
}

BodyDistances body_distances(const PlacedBody& a, const PlacedBody& b, const Clearance& clearance, double bone_radius,
                             const BodyProgress& progress) {
    BodyDistances out;
    out.bone_radius = bone_radius;
    for (std::size_t i = 0; i < clearance.pieces.size(); ++i) {
        const ClearancePiece& piece = clearance.pieces[i];
        if (progress) progress(i, clearance.pieces.size());
        const mobb::Approach grown(a.grown(piece.a_sample, bone_radius), b.grown(piece.b_sample, bone_radius));
        if (!grown.collides()) continue;
        const auto [begin, end] = grown.is_still() ? mobb::Approach::Range{} : grown.overlap();
        BodyStep step{piece.a_sample, piece.b_sample, grown.time(begin), grown.time(end), {}};
        add_interval(out.intervals, step.t0, step.t1);
        const std::vector<Segment> a0 = a.place(piece.a_sample, step.t0), a1 = a.place(piece.a_sample, step.t1);
        const std::vector<Segment> b0 = b.place(piece.b_sample, step.t0), b1 = b.place(piece.b_sample, step.t1);
        const LeastDistance least(a0, a1, b0, b1);
        step.nearest = {std::min(step.t0 + least.s * (step.t1 - step.t0), step.t1),
                        least.found.distance - 2 * bone_radius,
                        a.bones()[least.a],
                        b.bones()[least.b],
                        least.found.a,
                        least.found.b};
        if (!out.first && step.nearest.distance < 0) out.first = first_touch(a, b, step, bone_radius);
        if (!out.nearest || step.nearest.distance < out.steps[*out.nearest].nearest.distance)
            out.nearest = out.steps.size();
        out.steps.push_back(step);
    }
    return out;
}

std::int64_t body_cost(const PlacedBody& a, const PlacedBody& b, const Clearance& clearance, double bone_radius) {
    const auto bones_a = std::ssize(a.bones()), bones_b = std::ssize(b.bones());
    const auto near = std::ranges::count_if(
        clearance.pieces, [&](const ClearancePiece& piece) { return piece.clearance < 2 * bone_radius; });
    return near * bones_a * bones_b + std::ssize(clearance.pieces) * (bones_a + bones_b);
}

}  // namespace mobbscope
