#include <explain/bodies.h>
#include <explain/query_sentence.h>
#include <import/skeleton/disk_sampler.h>
#include <import/skeleton/motion.h>
#include <mobb/predicate.h>
#include <mobb/traversal.h>
#include <render/layout/annotations.h>
#include <render/parts/paths.h>
#include <render/pictures/moment.h>
#include <scene/crowd_scene.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
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
    const auto agents_of = [&](const BodyPair& pair) {
        return std::pair(bodies[static_cast<std::size_t>(pair.a)].agent,
                         bodies[static_cast<std::size_t>(pair.b)].agent);
    };
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
            if (agents_of(pair).first == agents_of(pair).second) continue;
            if (mobb::collide(a, b)) {
                moment.overlaps.push_back(pair);
            } else if (pair.clearance < least) {
                least = pair.clearance = std::max(pair.clearance, 0.0);
                moment.nearest = pair;
            }
        }
    }
    for (const BodyPair& pair : moment.overlaps) {
        bodies[static_cast<std::size_t>(pair.a)].overlaps = true;
        bodies[static_cast<std::size_t>(pair.b)].overlaps = true;
    }
    std::ranges::sort(moment.overlaps, {}, [&](const BodyPair& pair) {
        return std::tuple(agents_of(pair), pair.clearance, pair.a, pair.b);
    });
    const auto same_agents = [&](const BodyPair& a, const BodyPair& b) { return agents_of(a) == agents_of(b); };
    moment.overlaps.erase(std::unique(moment.overlaps.begin(), moment.overlaps.end(), same_agents),
                          moment.overlaps.end());
    if (!moment.overlaps.empty()) moment.nearest.reset();
}

std::string radius(const DrawnAgent& agent, const Body& body) {
    std::string text = "radius " + with_unit(body.disk.r, "m");
    if (!sets_radius(body)) return text;
    return text + ": as far as " + joint_words(*agent.skeleton, body.farthest->joint) + " reaches";
}

constexpr std::size_t kMostPairs = 3;
constexpr std::size_t kMostWaiting = 3;

/// "agent0 waits", "agent0, agent2, agent3 and 4 more wait"; empty if nobody does.
std::string who_waits(std::span<const DrawnAgent> agents, const Moment& moment) {
    std::vector<std::string> names;
    for (const Body& body : moment.bodies) {
        if (body.waits && is_first_of(moment, body))
            names.push_back(agents[static_cast<std::size_t>(body.agent)].label);
    }
    if (names.empty()) return "";
    std::string out = names.front();
    const std::size_t named = std::min(names.size(), kMostWaiting);
    for (std::size_t i = 1; i < named; ++i) out += (i + 1 == names.size() ? " and " : ", ") + names[i];
    if (names.size() > named) out += " and " + std::to_string(names.size() - named) + " more";
    return out + (names.size() == 1 ? " waits" : " wait");
}

/// Whether anybody waits at any time.
bool has_waiting(std::span<const DrawnAgent> agents) {
    return std::ranges::any_of(agents, [](const DrawnAgent& agent) {
        for (int i = 0; i < agent.clip().count(); ++i) {
            if (waits_at(agent.clip(), i)) return true;
        }
        return false;
    });
}

}  // namespace

bool waits_at(const mobb::PlacedClip& clip, int sample) {
    if (!clip.is_linear() || clip.count() < 2) return false;
    const int first = std::min(sample, clip.count() - 2);
    const mobb::Disk a = clip.disk(first);
    const mobb::Disk b = clip.disk(first + 1);
    return a.x == b.x && a.y == b.y;
}

bool sets_radius(const Body& body) {
    return body.farthest && std::abs(body.farthest->distance - body.disk.r) <= kOnWall;
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

bool is_first_of(const Moment& moment, const Body& body) {
    return &body == &moment.bodies.front() || body.agent != (&body - 1)->agent;
}

std::size_t people_in(const Moment& moment) {
    return static_cast<std::size_t>(
        std::ranges::count_if(moment.bodies, [&](const Body& body) { return is_first_of(moment, body); }));
}

Moment moment_of(std::span<const DrawnAgent> agents, std::span<const double> heights, double time) {
    Moment out;
    out.time = time;
    for (std::size_t i = 0; i < agents.size(); ++i) {
        const std::optional<int> sample = sample_at(agents[i], time);
        if (!sample) continue;
        for (const mobb::PlacedClip& path : agents[i].paths()) {
            out.bodies.push_back({.agent = static_cast<int>(i),
                                  .sample = *sample,
                                  .disk = mobb::swept(path, *sample).at(time),
                                  .height = heights[i],
                                  .waits = waits_at(path, *sample)});
        }
    }
    // Radii of more are shown by no picture.
    if (out.bodies.size() <= 2) {
        for (Body& body : out.bodies) {
            const Skeleton* skeleton = agents[static_cast<std::size_t>(body.agent)].skeleton;
            if (skeleton) body.farthest = farthest_joint(*skeleton, body.sample);
        }
    }
    // In a grid they are not where they meet.
    if (agents.empty() || !agents.front().cell) find_pairs(out);
    return out;
}

std::optional<NearestBones> bones_then(std::span<const DrawnAgent> agents, const Moment& moment) {
    if (agents.size() != 2 || moment.bodies.size() != 2 || !agents[0].skeleton || !agents[1].skeleton) return {};
    const PlacedBody a(agents[0].clip(), *agents[0].skeleton), b(agents[1].clip(), *agents[1].skeleton);
    return nearest_bones(a, moment.bodies[0].sample, b, moment.bodies[1].sample, moment.time, kBoneRadius);
}

Caption moment_caption(const Palette& palette, std::span<const DrawnAgent> agents, const Moment& moment,
                       std::size_t people) {
    Caption out;
    const std::string then = at_time(moment.time);
    const auto agent = [&](int body) -> const DrawnAgent& {
        return agents[static_cast<std::size_t>(moment.bodies[static_cast<std::size_t>(body)].agent)];
    };
    const auto both = [&](const BodyPair& pair) { return agent(pair.a).label + " and " + agent(pair.b).label; };
    const std::size_t count = people_in(moment);
    const bool is_disk_each = count == moment.bodies.size();
    // There is always a detail, or the caption would change its height while time runs.
    const auto add_detail = [&](const std::string& text) {
        out.detail += (out.detail.empty() ? "" : "  \u00B7  ") + text;
    };
    if (count < people) {
        add_detail(std::to_string(count) + " of " + std::to_string(people) + " are on the floor then");
    }
    if (count == 0) {
        out.headlines = {"Nobody is on the floor" + then};
    } else if (count == 1) {
        out.headlines = {agent(0).label + then};
        if (is_disk_each) add_detail(radius(agent(0), moment.bodies.front()));
    } else if (moment.overlaps.size() > 1) {
        const std::string pairs = std::to_string(moment.overlaps.size()) + " pairs";
        out.headlines = {pairs + " of " + std::to_string(count) + " agents overlap" + then, pairs + " overlap" + then};
        std::string names;
        for (std::size_t i = 0; i < std::min(moment.overlaps.size(), kMostPairs); ++i) {
            names += (i == 0 ? "" : ", ") + both(moment.overlaps[i]);
        }
        add_detail(names + (moment.overlaps.size() > kMostPairs ? " ..." : ""));
        out.mark = palette.hit;
    } else if (moment.overlaps.size() == 1) {
        const BodyPair& pair = moment.overlaps.front();
        out.headlines = {both(pair) + " overlap" + then + " by " + with_unit(-pair.clearance, "m"),
                         both(pair) + " overlap" + then};
        out.mark = palette.hit;
    } else if (!moment.nearest) {
        out.headlines = {std::to_string(count) + " agents" + then};
    } else {
        const std::string clearance = with_unit(moment.nearest->clearance, "m") + " of clearance";
        const std::string all = std::to_string(count) + " agents" + then;
        if (count == 2) {
            out.headlines = {both(*moment.nearest) + then + "; " + clearance, clearance + then};
        } else {
            out.headlines = {all + "; nobody overlaps", all};
            add_detail("nearest: " + both(*moment.nearest) + ", " + clearance);
        }
        out.mark = palette.separated;
    }
    if (moment.bones) {
        const NearestBones& bones = *moment.bones;
        add_detail((bones.distance < 0 ? "bones overlap by " : "nearest bones ") +
                   with_unit(std::abs(bones.distance), "m") + ": " + bone_words(*agents[0].skeleton, bones.a) +
                   " and " + bone_words(*agents[1].skeleton, bones.b));
    } else if (count == 2 && is_disk_each) {
        add_detail("radii " + with_unit(moment.bodies[0].disk.r, "m") + " and " +
                   with_unit(moment.bodies[1].disk.r, "m"));
    }
    if (const std::string waiting = who_waits(agents, moment); !waiting.empty()) add_detail(waiting);
    if (out.detail.empty()) {
        add_detail((count == 1 ? "" : "all " + std::to_string(count) + " are ") + std::string("on the floor then"));
    }
    return out;
}

std::vector<LegendEntry> moment_legend(const DrawList& list, std::span<const DrawnAgent> agents,
                                       std::span<const DrawnAgent> paths, const ViewState& view, bool bones) {
    const Palette& palette = list.palette;
    std::vector<LegendEntry> out;
    // A crowd's colours only keep neighbours apart.
    const bool in_grid = !agents.empty() && agents.front().cell;
    if (names_fit(shown_count(agents)) && !in_grid) out = agent_entries(list, agents, paths);
    const auto line = [&](Rgba color, float width, const char* text) {
        LegendEntry entry;
        entry.color = color;
        entry.width = width;
        entry.text = text;
        out.push_back(entry);
    };
    if (view.disks && agents.size() > 1 && !in_grid) line(palette.hit, 3, "overlap");
    if (view.disks && !in_grid && has_waiting(paths)) line(palette.quiet_text, 1.3f, "waits (inner ring)");
    if (bones) {
        line(palette.quiet_text, 5, ("bones, " + with_unit(kBoneRadius, "m") + " around each").c_str());
        line(palette.separated, 5, "nearest bones");
    } else if (view.disks && may_show_radii(agents)) {
        line(palette.text, 1.4f, "radius, to the farthest joint");
    }
    const bool is_run = !agents.empty() && agents.front().run_agent >= 0;
    if (view.floor && !(is_run && agents.size() > kMostWithWays)) {
        line(palette.quiet_text, 2.6f, "way so far");
        line(with_alpha(palette.quiet_text, 0.6f), 1.2f, "way ahead");
    }
    return out;
}

bool may_show_radii(std::span<const DrawnAgent> agents) {
    return agents.size() <= 2 &&
           std::any_of(agents.begin(), agents.end(), [](const DrawnAgent& s) { return s.skeleton != nullptr; });
}

}  // namespace mobbscope
