#include <base/error.h>
#include <base/text.h>
#include <cli/render/render_job.h>
#include <render/drawlist/draw_list.h>
#include <render/drawlist/shown_points.h>
#include <render/drawlist/view_projection.h>
#include <render/image/rect.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/played.h>
#include <scene/drawn_agent.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace mobbscope::cli {

namespace {

constexpr int kLeastDigits = 4;

/// How many there are, and what the view of each is.
struct Sequence {
    double count = 0;       ///< may be beyond any int
    std::string described;  ///< "the motion has 60 pictures at 30 per second"
    std::function<ViewState(int)> view;
};

Sequence turntable(const ViewState& view, int count) {
    const auto turned = [view, count](int i) {
        ViewState out = view;
        const Orientation seen = orientation(view.camera);
        out.camera.preset = CameraPreset::free;
        out.camera.yaw_deg = std::remainder(seen.yaw_deg + 360.0 * i / count, 360.0);
        out.camera.pitch_deg = seen.pitch_deg;
        out.camera.perspective = seen.perspective;
        return out;
    };
    return {static_cast<double>(count), "the turntable has " + counted(count, "picture", "pictures"), turned};
}

Sequence steps(KeptPaths& kept, const ViewState& view) {
    static_cast<void>(drawn_agents(*kept.fitted(), view));  // throws if there is no such query
    const int count = kept.recorded(view).trace.size();
    const auto at = [view](int i) {
        ViewState out = view;
        out.step = {Step::Unit::event, static_cast<double>(i)};
        return out;
    };
    return {static_cast<double>(count),
            "query " + std::to_string(*view.query) + " has " + counted(count, "step", "steps"), at};
}

Sequence motion(const FittedScene& fitted, const ViewState& view, double rate) {
    const MotionPictures played = motion_pictures(fitted, view, rate);
    const auto at = [view, begin = played.begin, rate](int i) {
        ViewState out = view;
        out.time = begin + i / rate;
        return out;
    };
    return {played.pictures, "the motion has " + brief(played.pictures) + " pictures at " + brief(rate) + " per second",
            at};
}

Sequence sequence_of(KeptPaths& kept, const ViewState& view, Played played, const SequenceArguments& asked) {
    if (played == Played::turn) return turntable(view, *asked.turntable);
    if (played == Played::steps) return steps(kept, view);
    return motion(*kept.fitted(), view, film_pace(played, asked.rate.value_or(0)).rate);
}

bool lies_within(const DrawList& list, const DiskInstance& disk, const Rect& rect) {
    const auto is_inside = [&](glm::vec3 point) {
        const auto pixel = list.projection.project(point);
        return pixel && rect.contains({*pixel, *pixel});
    };
    return std::ranges::any_of(rim_directions(), [&](glm::vec3 way) {
        return is_inside(disk.base + disk.radius * way) || is_inside(disk.top + disk.top_radius * way);
    });
}

/// Pixels from the top of the picture to below the caption, if that covers some of a path; at most half of all. Of 16
/// pictures of the whole sequence, evenly spread, so that it is the same whichever of them are asked for.
int covering_caption(KeptPaths& kept, const Sequence& sequence, const PictureOptions& options) {
    constexpr int kMostLookedAt = 16;
    const ViewState begun = sequence.view(0);
    if (!begun.labels || !begun.caption) return 0;
    const int count = static_cast<int>(std::min<double>(sequence.count, std::numeric_limits<int>::max()));
    const int looked_at = std::min(count, kMostLookedAt);
    float height = 0;
    bool covers = false;
    for (int i = 0; i < looked_at; ++i) {
        const double part = looked_at > 1 ? static_cast<double>(i) / (looked_at - 1) : 0;
        const DrawList list = build_draw_list(kept, sequence.view(static_cast<int>(part * (count - 1))), options);
        for (const Overlay& overlay : list.overlays) {
            if (overlay.kind != Overlay::Kind::caption) continue;
            height = std::max(height, overlay.rect.max.y);
            covers = covers || std::ranges::any_of(list.disks, [&](const DiskInstance& disk) {
                         return lies_within(list, disk, overlay.rect);
                     });
        }
    }
    return covers ? std::min(static_cast<int>(std::ceil(height)), options.size.height / 2) : 0;
}

}  // namespace

bool is_near_followed(const ViewState& view, const RenderArguments& arguments) {
    return arguments.view.says("follow") && !view.follow.empty() && !view.camera.target && !view.projection;
}

std::vector<RenderPicture> pictures_of(KeptPaths& kept, const ViewState& view, const RenderArguments& arguments) {
    const SequenceArguments& asked = arguments.sequence;
    if (!asked.any()) return {{view, arguments.outputs}};
    const std::string option = asked.option();
    const auto contradict = [&](const char* other, const char* why) {
        throw InputError(option + " and " + other + " contradict each other: " + why + "; leave one out");
    };
    const Played played = played_of(view, asked.turntable.has_value());
    const bool of_query = played == Played::steps;
    if (of_query && arguments.view.says("step")) contradict("--step", "the pictures are the query's steps");
    if (of_query && asked.rate && !arguments.is_film())
        contradict("--rate", "the pictures are a query's steps; only a film of them has a rate");
    if (played == Played::motion && arguments.view.says("time"))
        contradict("--time", "the pictures go through the time");

    Sequence sequence = sequence_of(kept, view, played, asked);
    const auto [first, last] =
        asked.frames ? std::pair<double, double>(*asked.frames) : std::pair<double, double>(0, sequence.count - 1);
    if (last >= sequence.count) throw InputError(option + ": " + sequence.described + ", counted from 0");
    if (last - first >= kMostPictures) {
        throw InputError(option + ": these are " + brief(last - first + 1) + " pictures; at most " +
                         std::to_string(kMostPictures) + " are made at once");
    }
    // Where the camera counts from somebody who walks, each picture frames the scene by itself.
    const bool walks = played == Played::motion && !view.follow.empty();
    if (!view.camera.target && !walks && !is_near_followed(view, arguments)) {
        const ViewState framed = sequence.view(0);
        ViewState seen = view;
        const auto see_below = [&](int top) {
            seen.camera = film_camera(kept, framed, arguments.picture.size, played, top);
            sequence = sequence_of(kept, seen, played, asked);
        };
        see_below(0);
        if (const int top = covering_caption(kept, sequence, arguments.picture)) see_below(top);
    }
    const int digits = std::max(kLeastDigits, static_cast<int>(std::to_string(static_cast<int>(last)).size()));
    std::vector<RenderPicture> out;
    for (int i = static_cast<int>(first); i <= static_cast<int>(last); ++i) {
        out.push_back({sequence.view(i), numbered(arguments.outputs, i, digits)});
    }
    return out;
}

}  // namespace mobbscope::cli
