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

/// What caption, legend and map cover in any of 16 pictures of the whole sequence, evenly spread, so that it is the
/// same whichever of them are asked for.
std::vector<Rect> panels_of(KeptPaths& kept, const Sequence& sequence, const PictureOptions& options) {
    constexpr int kMostLookedAt = 16;
    const int count = static_cast<int>(std::min<double>(sequence.count, std::numeric_limits<int>::max()));
    const int looked_at = std::min(count, kMostLookedAt);
    std::vector<Rect> out;
    for (int i = 0; i < looked_at; ++i) {
        const double part = looked_at > 1 ? static_cast<double>(i) / (looked_at - 1) : 0;
        const Framed one = framed_in(kept, sequence.view(static_cast<int>(part * (count - 1))), options);
        out.insert(out.end(), one.panels.begin(), one.panels.end());
    }
    return united(out);
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
    const bool frames = !view.camera.target && !is_near_followed(view, arguments);
    const std::vector<Rect> panels = frames ? panels_of(kept, sequence, arguments.picture) : std::vector<Rect>();
    const auto framing = [&](const ViewState& seen) {
        return film_camera(kept, seen, arguments.picture.size, played, panels);
    };
    // Where the target counts from somebody who walks, each picture has its own.
    const bool walks = played == Played::motion && !view.follow.empty();
    if (frames && !walks) {
        ViewState seen = view;
        seen.camera = framing(sequence.view(0));
        sequence = sequence_of(kept, seen, played, asked);
    }
    const int digits = std::max(kLeastDigits, static_cast<int>(std::to_string(static_cast<int>(last)).size()));
    std::vector<RenderPicture> out;
    for (int i = static_cast<int>(first); i <= static_cast<int>(last); ++i) {
        ViewState seen = sequence.view(i);
        if (frames && walks) seen.camera = framing(seen);
        out.push_back({std::move(seen), numbered(arguments.outputs, i, digits)});
    }
    return out;
}

}  // namespace mobbscope::cli
