#include <crowd/people.h>
#include <import/error.h>
#include <import/text.h>
#include <mobb/chain.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <memory>
#include <stdexcept>
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

mobb::ClipPtr whole_motion(const Scene& run, const std::vector<mobb::ChainPartPtr>& parts, const CrowdAgent& person) {
    std::vector<mobb::ChainLink> links;
    for (const Play& play : person.plays) {
        const int clip = run.graph->moves[static_cast<std::size_t>(play.move)].clip;
        links.push_back({parts[static_cast<std::size_t>(clip)], play.placement.translate, play.placement.rotate_deg});
    }
    try {
        return std::make_shared<const mobb::Clip>(flattened(mobb::Chain(links)));
    } catch (const std::invalid_argument& error) {
        throw InputError(run.file.string(), "",
                         "what " + in_quotes(person.name) + " plays is no chain: " + error.what() +
                             "; read all clips with one --fps");
    }
}

}  // namespace

Scene scene_of_people(const Scene& run) {
    const std::vector<mobb::ChainPartPtr> parts = parts_of(run);
    Scene out;
    out.file = run.file;
    out.fit = run.fit;
    for (const CrowdAgent& person : run.crowd->agents) {
        if (person.plays.empty()) continue;
        const int clip = static_cast<int>(out.clips.size());
        out.clips.push_back({person.name, std::nullopt, {}, whole_motion(run, parts, person)});
        out.agents.push_back({person.name, clip, {{0, 0}, 0, person.plays.front().placement.start}, std::nullopt});
    }
    return out;
}

}  // namespace mobbscope
