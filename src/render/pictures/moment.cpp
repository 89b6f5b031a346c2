#include <import/skeleton/disk_sampler.h>
#include <import/skeleton/motion.h>
#include <mobb/predicate.h>
#include <render/parts/paths.h>
#include <render/pictures/moment.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace mobbscope {

namespace {

constexpr double kUsualHeight = 1.75;  // metres, where no skeleton tells
constexpr double kAbove = 0.1;         // metres of the cylinder above the highest joint
constexpr double kOnWall = 0.01;       // metres: between a file's frames joints and radii are mixed apart

double highest_joint(const Skeleton& skeleton) {
    const std::vector<bool> in_body = subtree(skeleton.joints, skeleton.root);
    float highest = 0;
    for (std::size_t first = 0; first < skeleton.positions.size(); first += skeleton.joints.size()) {
        for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
            if (in_body[i]) highest = std::max(highest, skeleton.positions[first + i].z);
        }
    }
    return static_cast<double>(highest);
}

FarthestJoint farthest_joint(const Skeleton& skeleton, int sample) {
    const std::vector<bool> in_body = subtree(skeleton.joints, skeleton.root);
    const std::span<const glm::vec3> positions = skeleton.at(sample);
    FarthestJoint out{skeleton.root, 0};
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const double distance = std::hypot(positions[i].x, positions[i].y);
        if (in_body[i] && distance > out.distance) out = {static_cast<int>(i), distance};
    }
    return out;
}

/// All pairs that overlap, or the nearest: along x, only those are looked at that may be one or the other.
void find_pairs(Moment& moment) {
    std::vector<Body>& bodies = moment.bodies;
    const auto disk = [&](int i) -> const mobb::Disk& { return bodies[static_cast<std::size_t>(i)].disk; };
    std::vector<int> by_x(bodies.size());
    std::iota(by_x.begin(), by_x.end(), 0);
    std::sort(by_x.begin(), by_x.end(), [&](int i, int j) { return disk(i).x - disk(i).r < disk(j).x - disk(j).r; });
    double least = std::numeric_limits<double>::infinity();
    for (auto first = by_x.begin(); first != by_x.end(); ++first) {
        const mobb::Disk& a = disk(*first);
        // A hair more, as sums are rounded and the predicate has the last word.
        const double hair = 1e-9 * (1 + std::abs(a.x) + a.r);
        for (auto second = first + 1; second != by_x.end(); ++second) {
            const mobb::Disk& b = disk(*second);
            if (b.x - b.r > a.x + a.r + std::max(least, 0.0) + hair) break;
            BodyPair pair{std::min(*first, *second), std::max(*first, *second),
                          std::sqrt(mobb::squared_distance(a, b)) - (a.r + b.r)};
            if (mobb::collide(a, b)) {
                moment.overlaps.push_back(pair);
            } else if (pair.clearance < least) {
                least = pair.clearance = std::max(pair.clearance, 0.0);
                moment.nearest = pair;
            }
        }
    }
    std::sort(moment.overlaps.begin(), moment.overlaps.end(),
              [](const BodyPair& p, const BodyPair& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
    for (const BodyPair& pair : moment.overlaps) {
        bodies[static_cast<std::size_t>(pair.a)].overlaps = true;
        bodies[static_cast<std::size_t>(pair.b)].overlaps = true;
    }
    if (!moment.overlaps.empty()) moment.nearest.reset();
}

}  // namespace

bool sets_radius(const Body& body) {
    return body.farthest && std::abs(body.farthest->distance - body.disk.r) <= kOnWall;
}

glm::dvec3 joint_place(const DrawnAgent& agent, int sample, int joint) {
    const glm::dvec3 p(agent.skeleton->at(sample)[static_cast<std::size_t>(joint)]);
    const mobb::Disk disk = agent.clip().disk(sample);
    const glm::dvec2 turned = agent.clip().rotation()({p.x, p.y});
    return {disk.x + turned.x, disk.y + turned.y, p.z};
}

std::vector<double> cylinder_heights(std::span<const DrawnAgent> agents) {
    // Agents of a crowd share their clips.
    std::map<const Skeleton*, double> known{{nullptr, kUsualHeight}};
    std::vector<double> out;
    for (const DrawnAgent& agent : agents) {
        const auto [at, is_new] = known.try_emplace(agent.skeleton);
        if (is_new) at->second = highest_joint(*agent.skeleton) + kAbove;
        out.push_back(at->second);
    }
    return out;
}

Moment moment_of(std::span<const DrawnAgent> agents, std::span<const double> heights, double time) {
    Moment out;
    out.time = time;
    for (std::size_t i = 0; i < agents.size(); ++i) {
        const std::optional<int> sample = sample_at(agents[i], time);
        if (!sample) continue;
        Body body{static_cast<int>(i), *sample, agents[i].clip().disk(*sample), heights[i], std::nullopt, false};
        out.bodies.push_back(body);
    }
    // Radii of more are shown by no picture.
    if (out.bodies.size() <= 2) {
        for (Body& body : out.bodies) {
            const Skeleton* skeleton = agents[static_cast<std::size_t>(body.agent)].skeleton;
            if (skeleton) body.farthest = farthest_joint(*skeleton, body.sample);
        }
    }
    find_pairs(out);
    return out;
}

}  // namespace mobbscope
