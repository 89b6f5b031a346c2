#include <conflicts/conflicts.h>
#include <conflicts/crowd.h>
#include <conflicts/plan_conflicts.h>
#include <mobb/capture.h>

namespace mobbscope {

Crowd::Crowd(const Scene& scene) : Crowd(scene.file) {
    // A person of a run whose clips differ in dt, or are linear, is several agents of the scene.
    int last = -1;
    for (const Agent& agent : scene.agents) {
        add(scene.clips[static_cast<std::size_t>(agent.clip)], agent, agent.run_agent >= 0 && agent.run_agent == last);
        last = agent.run_agent;
    }
    if (is_scene_file(file_)) t0_.reset();
}

void Crowd::add(const SceneClip& clip, const Agent& agent, bool goes_on) {
    const SourceFacts& facts = clip.facts;
    // Of takes each has its own.
    if (agents_.empty()) t0_ = facts.first_key ? std::optional(*facts.first_key - clip.start) : facts.t0;
    add_doubt(doubts_, clip);
    int samples_before = 0;
    if (goes_on) {
        samples_before = paths_.back().samples_before + paths_.back().clip->count();
    } else {
        names_.push_back(agent.name);
        floors_.push_back(agent.floor);
    }
    const auto path = [&](const mobb::ClipPtr& walked) {
        paths_.push_back({walked, static_cast<int>(agents_.size()), samples_before});
    };
    const int first = static_cast<int>(paths_.size());
    if (clip.members.empty()) path(clip.clip);
    for (const mobb::ClipPtr& member : clip.members) path(member);
    agents_.push_back({agent.placement, facts.invented, is_plan(clip), static_cast<int>(names_.size()) - 1, first});
}

std::pair<int, int> Crowd::paths_beside(int path) const {
    const auto next = static_cast<std::size_t>(this->path(path).agent) + 1;
    return {agent_of(path).first_path,
            next < agents_.size() ? agents_[next].first_path : static_cast<int>(paths_.size())};
}

std::vector<mobb::PlacedClip> Crowd::placed() const {
    std::vector<mobb::PlacedClip> out;
    out.reserve(paths_.size());
    for (const CrowdPath& path : paths_)
        out.emplace_back(*path.clip, agents_[static_cast<std::size_t>(path.agent)].placement);
    return out;
}

std::vector<int> Crowd::person_of() const {
    std::vector<int> out;
    out.reserve(paths_.size());
    for (const CrowdPath& path : paths_) out.push_back(agents_[static_cast<std::size_t>(path.agent)].person);
    return out;
}

std::vector<int> Crowd::floor_of() const { return numbered_floors(floors_); }

std::optional<double> Crowd::common_radius() const {
    std::optional<double> radius;
    for (const CrowdPath& path : paths_) {
        for (const mobb::Disk& disk : path.clip->samples()) {
            if (radius && *radius != disk.r) return std::nullopt;
            radius = disk.r;
        }
    }
    return radius;
}

std::uint64_t Crowd::digest() const {
    std::vector<mobb::Disk> numbers;
    for (const CrowdPath& path : paths_) {
        const std::uint64_t of = mobb::digest(path.clip->dt(), path.clip->samples(), path.clip->motion());
        const mobb::Placement& at = agents_[static_cast<std::size_t>(path.agent)].placement;
        numbers.push_back({static_cast<double>(of >> 32), static_cast<double>(of & 0xffffffff), at.start});
        numbers.push_back({at.translate.x, at.translate.y, at.rotate_deg});
        numbers.push_back({static_cast<double>(path.agent), 0, 0});
    }
    for (const int floor : floor_of()) numbers.push_back({static_cast<double>(floor), 0, 0});
    return mobb::digest(0, numbers, mobb::Motion::held);
}

}  // namespace mobbscope
