#include <base/error.h>
#include <base/text.h>
#include <crowd/simulation/simulate.h>
#include <mobb/chain.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

/// Chains need each clip's tree, whichever it is: only its samples are asked for here.
std::vector<mobb::ChainPartPtr> parts_of(const Scene& run) {
    mobb::FitOptions roots_alone;
    roots_alone.levels = 1;
    std::vector<mobb::ChainPartPtr> parts;
    for (const SceneClip& clip : run.clips) {
        parts.push_back(std::make_shared<mobb::ChainPart>(std::make_shared<const mobb::Tree>(clip.clip, roots_alone)));
    }
    return parts;
}

const mobb::ChainPartPtr& part_of(const Scene& run, const std::vector<mobb::ChainPartPtr>& parts, const Play& play) {
    return parts[static_cast<std::size_t>(run.graph->moves[static_cast<std::size_t>(play.move)].clip)];
}

/// How many of the plays, from the first, one clip can hold: those of one dt whose disks are held. The last disk of a
/// linear play stays until the next play begins, as no disk within a linear clip does: it is a clip by itself.
std::size_t plays_of_one_clip(const Scene& run, const std::vector<mobb::ChainPartPtr>& parts,
                              std::span<const Play> plays) {
    const mobb::Clip& first = part_of(run, parts, plays.front())->clip();
    if (first.motion() == mobb::Motion::linear) return 1;
    const auto other = std::ranges::find_if(plays, [&](const Play& play) {
        const mobb::Clip& clip = part_of(run, parts, play)->clip();
        return clip.dt() != first.dt() || clip.motion() != first.motion();
    });
    return static_cast<std::size_t>(std::distance(plays.begin(), other));
}

mobb::ClipPtr whole_motion(const Scene& run, const std::vector<mobb::ChainPartPtr>& parts, std::span<const Play> plays,
                           const std::string& name) {
    std::vector<mobb::ChainLink> links;
    for (const Play& play : plays) {
        links.push_back({part_of(run, parts, play), play.placement.translate, play.placement.rotate_deg});
    }
    try {
        return std::make_shared<const mobb::Clip>(flattened(mobb::Chain(links)));
    } catch (const std::invalid_argument& error) {
        throw InputError(run.file.string(), "", "what " + in_quotes(name) + " plays is no chain: " + error.what());
    }
}

}  // namespace

Scene scene_of_people(const Scene& run) {
    const std::vector<mobb::ChainPartPtr> parts = parts_of(run);
    Scene out;
    out.file = run.file;
    out.fit = run.fit;
    int run_agent = 0;
    for (const CrowdAgent& agent : run.crowd->agents) {
        if (agent.plays.empty()) continue;
        for (std::span<const Play> rest = agent.plays; !rest.empty();) {
            const std::span<const Play> plays = rest.first(plays_of_one_clip(run, parts, rest));
            const double begin = plays.front().placement.start;
            std::string name = agent.name;
            if (rest.size() < agent.plays.size()) name += " from " + brief(begin) + " s";
            const int clip = static_cast<int>(out.clips.size());
            const mobb::ClipPtr& first = part_of(run, parts, plays.front())->tree().shared_clip();
            const bool is_linear = first->motion() == mobb::Motion::linear;
            out.clips.push_back(
                {name, std::nullopt, {}, is_linear ? first : whole_motion(run, parts, plays, agent.name)});
            const mobb::Placement at = is_linear ? plays.front().placement : mobb::Placement{{0, 0}, 0, begin};
            out.agents.push_back({std::move(name), clip, at, std::nullopt, run_agent});
            rest = rest.subspan(plays.size());
        }
        ++run_agent;
    }
    return out;
}

}  // namespace mobbscope
