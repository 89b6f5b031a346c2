#include <base/text.h>
#include <crowd/simulation/choice.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/candidates.h>
#include <render/pictures/disk_projection.h>
#include <render/pictures/kept_paths.h>
#include <render/pictures/picture.h>
#include <scene/arrangement.h>
#include <scene/crowd_scene.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace mobbscope {

namespace {

void check_scale(double scale) {
    if (scale == 0 || (scale >= kLeastScale && scale <= kMostScale)) return;
    throw std::invalid_argument("text and lines cannot be drawn " + format_double(scale) + " times as large: give " +
                                format_double(kLeastScale) + " to " + format_double(kMostScale));
}

std::unique_ptr<Picture> picture_of(KeptPaths& kept, const ViewState& view, const PictureOptions& options,
                                    const FollowedChoice* choice) {
    const FittedScene& seen = *kept.fitted();
    if (view.show != Show::space_time) return moment_picture(kept, view, options, choice);
    if (seen.scene().crowd) return crowd_picture(kept, view, options, choice);
    if (view.projection) return disk_projection_picture(seen, view, options);
    return space_time_picture(kept, view, options);
}

/// Any number of agents may play one long clip.
void check_disks(const FittedScene& fitted, const ViewState& view) {
    const Scene& scene = fitted.scene();
    const auto samples_of = [&](int clip) {
        const SceneClip& of = scene.clips[static_cast<std::size_t>(clip)];
        return static_cast<std::size_t>(of.clip->count()) * std::max<std::size_t>(of.members.size(), 1);
    };
    const bool draws_all = view.show == Show::space_time && !view.projection && view.disks && !view.query;
    if (!draws_all) return;
    const std::unordered_set<std::string_view> hidden(view.hidden.begin(), view.hidden.end());
    std::size_t shown = 0, own = 0;
    for (const PlacedAgent& agent : fitted.placed_agents()) {
        if (!hidden.contains(agent.name)) shown += samples_of(agent.clip);
    }
    for (std::size_t clip = 0; clip < scene.clips.size(); ++clip) own += samples_of(static_cast<int>(clip));
    if (shown <= std::max(own, kMostDisksOfSharedClips)) return;
    throw std::invalid_argument("its agents have " + std::to_string(shown) + " disks, and of clips that agents share " +
                                std::to_string(kMostDisksOfSharedClips) +
                                " are drawn; hide agents, trim their clips or lower fps");
}

/// Hands `use` the picture: of a run that of the scene at the view's time, with its followed agent's choice.
template <class Use>
auto with_picture(KeptPaths& kept, const ViewState& view, const PictureOptions& options, const FollowedChoice* choice,
                  Use use) {
    check_scale(options.scale);
    const FittedScene& fitted = *kept.fitted();
    check_names(fitted.scene(), view);
    if (!is_run(fitted.scene())) {
        check_disks(fitted, view);
        return use(*picture_of(kept, view, options, choice));
    }
    KeptPaths& seen = kept.shown_in(view);
    if (view.follow.empty() || !view.candidates) return use(*picture_of(seen, view, options, nullptr));
    const MoveSet moves(fitted);
    const auto own = choice_in_view(moves, view);
    return use(*picture_of(seen, view, options, own ? &*own : nullptr));
}

/// Of a scene that outlives the picture.
KeptPaths nothing_kept(const FittedScene& fitted) {
    return KeptPaths(std::shared_ptr<const FittedScene>(&fitted, [](const FittedScene*) {}));
}

}  // namespace

std::optional<FollowedChoice> choice_in_view(const MoveSet& moves, const ViewState& view) {
    if (view.follow.empty() || !view.candidates) return std::nullopt;
    const Scene& run = moves.fitted().scene();
    const auto run_agent = run_agent_by_name(*run.crowd, view.follow);
    return run_agent ? last_choice(moves, *run_agent, run_time(run, view)) : std::nullopt;
}

std::string edited_run_warning(const FittedScene& fitted, std::span<const ViewState> views) {
    const Scene& run = fitted.scene();
    if (!is_run(run)) return "";
    const MoveSet moves(fitted);
    std::set<std::pair<int, int>> seen;  // agents and plays: most pictures show the choice of the one before
    for (const ViewState& view : views) {
        const auto agent = run_agent_by_name(*run.crowd, view.follow);
        if (!agent || !view.candidates) continue;
        const auto play = last_chosen(run.crowd->agents[static_cast<std::size_t>(*agent)], run_time(run, view));
        if (!play || !seen.emplace(*agent, *play).second) continue;
        std::string text = edited_run_warning(run, *choice_in_view(moves, view));
        if (!text.empty()) return text;
    }
    return "";
}

DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, PictureSize size, double scale) {
    return build_draw_list(fitted, view, {.size = size, .scale = scale});
}

DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, const PictureOptions& options,
                         const FollowedChoice* choice) {
    KeptPaths kept = nothing_kept(fitted);
    return build_draw_list(kept, view, options, choice);
}

DrawList build_draw_list(KeptPaths& kept, const ViewState& view, const PictureOptions& options,
                         const FollowedChoice* choice) {
    return with_picture(kept, view, options, choice, [](Picture& picture) { return picture.draw(); });
}

PictureFrame picture_frame(const FittedScene& fitted, const ViewState& view, PictureSize size, double scale) {
    KeptPaths kept = nothing_kept(fitted);
    return picture_frame(kept, view, {.size = size, .scale = scale});
}

PictureFrame picture_frame(KeptPaths& kept, const ViewState& view, const PictureOptions& options) {
    return with_picture(kept, view, options, nullptr, [](Picture& picture) { return picture.aim(); });
}

Framed framed_in(KeptPaths& kept, const ViewState& view, const PictureOptions& options, const FollowedChoice* choice) {
    return with_picture(kept, view, options, choice, [](Picture& picture) { return picture.framed(); });
}

Camera common_camera(std::span<const Framed> framed, PictureSize size) {
    ShownPoints points;
    std::vector<Rect> panels;
    double margin = 0;
    for (const Framed& one : framed) {
        points.add(one.points);
        panels.insert(panels.end(), one.panels.begin(), one.panels.end());
        margin = std::max(margin, one.margin);
    }
    return framed_camera(framed.front().camera, points, framed.front().space, size, united(panels), margin);
}

std::vector<DrawList> build_draw_lists(std::span<const PictureBeside> pictures, const PictureOptions& options) {
    std::vector<KeptPaths> paths;
    std::vector<Framed> framed;
    for (const PictureBeside& picture : pictures) {
        framed.push_back(framed_in(paths.emplace_back(picture.fitted), picture.view, options));
    }
    std::vector<DrawList> out;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        std::vector<Framed> beside;
        for (std::size_t j = 0; j < pictures.size(); ++j) {
            if (framed[j].camera == framed[i].camera && framed[j].space == framed[i].space) beside.push_back(framed[j]);
        }
        ViewState view = pictures[i].view;
        view.camera = common_camera(beside, options.size);
        out.push_back(build_draw_list(paths[i], view, options));
    }
    return out;
}

Camera film_camera(KeptPaths& kept, const ViewState& view, PictureSize size, Played played,
                   std::span<const Rect> panels) {
    return with_picture(kept, view, {.size = size}, nullptr,
                        [&](Picture& picture) { return picture.film_camera(played, panels); });
}

}  // namespace mobbscope
