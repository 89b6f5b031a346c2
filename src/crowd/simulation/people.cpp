#include <base/error.h>
#include <base/text.h>
#include <crowd/simulation/simulate.h>
#include <mobb/chain.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
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

/// How many of the plays, from the first, one clip can hold: those of one dt and motion.
std::size_t plays_of_one_clip(const Scene& run, const std::vector<mobb::ChainPartPtr>& parts,
                              std::span<const Play> plays) {
    const mobb::Clip& first = part_of(run, parts, plays.front())->clip();
    const auto other = std::ranges::find_if(plays, [&](const Play& play) {
        const mobb::Clip& clip = part_of(run, parts, play)->clip();
        return clip.dt() != first.dt() || clip.motion() != first.motion();
    });
    return static_cast<std::size_t>(std::distance(plays.begin(), other));
}

/// `next`: the play behind them; null: there is none.
mobb::ClipPtr whole_motion(const Scene& run, const std::vector<mobb::ChainPartPtr>& parts, std::span<const Play> plays,
                           const Play* next, const std::string& name) {
    std::vector<mobb::ChainLink> links;
    for (const Play& play : plays) {
        links.push_back({part_of(run, parts, play), play.placement.translate, play.placement.rotate_deg});
    }
    const auto placed = [&](const Play& play) {
        return mobb::PlacedClip(part_of(run, parts, play)->clip(), play.placement);
    };
    try {
        mobb::Clip whole = flattened(mobb::Chain(links));
        if (next && whole.motion() == mobb::Motion::linear) {
            std::vector<mobb::Disk> samples(whole.samples().begin(), whole.samples().end());
            samples.push_back(runs_on_to(placed(plays.back()), placed(*next)));
            whole = mobb::Clip(whole.dt(), std::move(samples), whole.motion());
        }
        return std::make_shared<const mobb::Clip>(std::move(whole));
    } catch (const std::invalid_argument& error) {
        throw InputError(run.file, "what " + in_quotes(name) + " plays is not a chain: " + error.what());
    }
}

/// People of a run share its clips, but what each of them walks is a clip of its own.
void check_samples(const Scene& run) {
    std::size_t plays = 0, samples = 0;
    for (const CrowdAgent& agent : run.crowd->agents) {
        plays += agent.plays.size();
        for (const Play& play : agent.plays) {
            const int clip = run.graph->moves[static_cast<std::size_t>(play.move)].clip;
            samples += static_cast<std::size_t>(run.clips[static_cast<std::size_t>(clip)].clip->count());
        }
    }
    if (samples <= kMostWalkedSamples + kSamplesOfPlay * plays) return;
    throw InputError(run.file, "its people walk " + std::to_string(samples) + " samples in " +
                                   counted(plays, "play", "plays") + ", more than " +
                                   std::to_string(kMostWalkedSamples) + " and " + std::to_string(kSamplesOfPlay) +
                                   " for each play; let them play shorter clips");
}

}  // namespace

Scene scene_of_people(const Scene& run) {
    check_samples(run);
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
            const std::size_t first = agent.plays.size() - rest.size();
            rest = rest.subspan(plays.size());
            // What the clip before runs on to is part of that.
            if (plays.size() == 1 && rest.empty() && is_joints_alone(run, agent, first)) break;
            std::string name = agent.name;
            if (first > 0) name += " from " + brief(begin) + " s";
            const int clip = static_cast<int>(out.clips.size());
            const Play* const next = rest.empty() ? nullptr : &rest.front();
            out.clips.push_back({name, std::nullopt, {}, whole_motion(run, parts, plays, next, agent.name)});
            out.agents.push_back({std::move(name), clip, {{0, 0}, 0, begin}, std::nullopt, run_agent});
        }
        ++run_agent;
    }
    return out;
}

}  // namespace mobbscope
