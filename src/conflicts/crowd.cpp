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
}

void Crowd::add(const SceneClip& clip, const Agent& agent, bool goes_on) {
    if (members_.empty()) {
        const SourceFacts& facts = clip.facts;
        doubt_ = facts.doubt;
        // Of takes each has its own.
        if (!is_scene_file(file_)) t0_ = facts.first_key ? std::optional(*facts.first_key - clip.start) : facts.t0;
    }
    CrowdMember member{agent.name, clip.clip, agent.placement, clip.facts.invented, is_plan(clip), 0, 0};
    if (!members_.empty()) {
        const CrowdMember& before = members_.back();
        member.person = before.person + (goes_on ? 0 : 1);
        if (goes_on) member.samples_before = before.samples_before + before.clip->count();
    }
    members_.push_back(std::move(member));
}

std::vector<mobb::PlacedClip> Crowd::placed() const {
    std::vector<mobb::PlacedClip> out;
    out.reserve(members_.size());
    for (const CrowdMember& member : members_) out.emplace_back(*member.clip, member.placement);
    return out;
}

std::vector<int> Crowd::person_of() const {
    std::vector<int> out;
    out.reserve(members_.size());
    for (const CrowdMember& member : members_) out.push_back(member.person);
    return out;
}

std::optional<double> Crowd::common_radius() const {
    std::optional<double> radius;
    for (const CrowdMember& member : members_) {
        for (const mobb::Disk& disk : member.clip->samples()) {
            if (radius && *radius != disk.r) return std::nullopt;
            radius = disk.r;
        }
    }
    return radius;
}

std::uint64_t Crowd::digest() const {
    std::vector<mobb::Disk> numbers;
    for (const CrowdMember& member : members_) {
        const std::uint64_t of = mobb::digest(member.clip->dt(), member.clip->samples(), member.clip->motion());
        const mobb::Placement& at = member.placement;
        numbers.push_back({static_cast<double>(of >> 32), static_cast<double>(of & 0xffffffff), at.start});
        numbers.push_back({at.translate.x, at.translate.y, at.rotate_deg});
    }
    return mobb::digest(0, numbers, mobb::Motion::held);
}

}  // namespace mobbscope
