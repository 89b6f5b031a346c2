#include <base/text.h>
#include <mobb/clip.h>
#include <render/drawlist/camera.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/drawn_agent.h>
#include <scene/motion_graph.h>

#include <glm/common.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope {

namespace {

constexpr double kGlide = 0.5;  // seconds before and after
constexpr int kPlaces = 16;     // that the mean is of

/// The followed agent's clips one after the other.
std::vector<mobb::PlacedClip> clips_of(const FittedScene& fitted, const ViewState& view, double time) {
    const Scene& scene = fitted.scene();
    const std::string& name = view.follow;
    std::vector<mobb::PlacedClip> out;
    if (!scene.crowd) {
        for (const PlacedAgent& who : fitted.placed_agents()) {
            if (who.name == name) return {{fitted.tree(who).clip(), shown_placement(fitted, view, who)}};
        }
        return out;
    }
    const auto run_agent = run_agent_by_name(*scene.crowd, name);
    if (!run_agent) return out;
    const CrowdAgent& agent = scene.crowd->agents[static_cast<std::size_t>(*run_agent)];
    const std::size_t last = play_at(agent, time + kGlide);
    for (std::size_t i = play_at(agent, time - kGlide); i <= last; ++i) {
        const GraphMove& move = scene.graph->moves[static_cast<std::size_t>(agent.plays[i].move)];
        out.emplace_back(*scene.clips[static_cast<std::size_t>(move.clip)].clip, agent.plays[i].placement);
    }
    return out;
}

/// Between two samples that of both; before the first and after the last it stands, but for a linear clip in front of
/// another, which runs on.
glm::dvec2 place_at(const std::vector<mobb::PlacedClip>& clips, double time) {
    const auto begins_later = [](double t, const mobb::PlacedClip& clip) { return t < clip.time(0); };
    const auto after = std::upper_bound(clips.begin(), clips.end(), time, begins_later);
    const mobb::PlacedClip& clip = after == clips.begin() ? clips.front() : *(after - 1);
    const int last = clip.count() - 1;
    const bool runs_on = clip.is_linear() && after != clips.begin() && after != clips.end();
    const double at =
        std::clamp((time - clip.time(0)) / clip.dt(), 0.0, static_cast<double>(runs_on ? last + 1 : last));
    const int first = std::min(static_cast<int>(at), last);
    const mobb::Disk a = clip.disk(first);
    const mobb::Disk b = first < last ? clip.disk(first + 1) : runs_on ? runs_on_to(clip, *after) : a;
    return glm::mix(glm::dvec2(a.x, a.y), glm::dvec2(b.x, b.y), at - first);
}

}  // namespace

std::optional<glm::dvec2> followed_place(const FittedScene& fitted, const ViewState& view, double time) {
    if (view.follow.empty()) return std::nullopt;
    const std::vector<mobb::PlacedClip> clips = clips_of(fitted, view, time);
    if (clips.empty()) throw ViewMismatch("follow", "there is no agent " + in_quotes(view.follow) + " to follow");
    glm::dvec2 sum(0);
    for (int i = 0; i < kPlaces; ++i) sum += place_at(clips, time + kGlide * (2.0 * i / (kPlaces - 1) - 1));
    return sum / static_cast<double>(kPlaces);
}

glm::dvec3 camera_anchor(const FittedScene& fitted, const ViewState& view, double time) {
    const glm::dvec2 place = followed_place(fitted, view, time).value_or(glm::dvec2(0));
    const bool time_runs = fitted.scene().crowd && view.show == Show::space_time;
    return {place.x, place.y, time_runs ? time : 0};
}

glm::dvec3 target_of_followed(const FittedScene& fitted, const ViewState& view, const PictureFrame& picture) {
    // In a scene's space-time targets are as high as their time, else they count from the floor or from now.
    if (picture.moment || fitted.scene().crowd) return glm::dvec3(0);
    const double time = view.time ? *view.time : bounds_of(drawn_agents(fitted, view)).min.z;
    return {0, 0, time * picture.space.time_height};
}

Camera framing_followed(const FittedScene& fitted, const ViewState& view, const PictureFrame& picture, double metres) {
    const glm::dvec3 at = target_of_followed(fitted, view, picture);
    return framing(picture.camera, at - glm::dvec3(metres, metres, 0), at + glm::dvec3(metres, metres, kStanding),
                   picture.size);
}

bool can_follow(const Scene& scene, const std::string& name) {
    if (scene.crowd) return run_agent_by_name(*scene.crowd, name).has_value();
    const std::vector<PlacedAgent> all = placed_agents(scene);
    return std::ranges::find(all, name, &PlacedAgent::name) != all.end();
}

}  // namespace mobbscope
