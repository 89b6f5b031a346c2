#include <base/error.h>
#include <base/text.h>
#include <cli/render/render_job.h>
#include <render/drawlist/view_projection.h>
#include <render/layout/framing.h>
#include <render/pictures/played.h>
#include <scene/crowd_run.h>
#include <scene/drawn_agent.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
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
        // One camera has the boxes of all steps in it.
        out.frame_boxes = out.frame_boxes || out.boxes;
        return out;
    };
    return {static_cast<double>(count),
            "query " + std::to_string(*view.query) + " has " + counted(count, "step", "steps"), at};
}

Sequence motion(const FittedScene& fitted, const ViewState& view, double rate) {
    Bounds bounds;
    bool ends_with_somebody = false;
    if (fitted.scene().crowd) {
        bounds.min.z = 0;
        bounds.max.z = fitted.scene().crowd->seconds;
    } else {
        const std::vector<DrawnAgent> agents = drawn_agents(fitted, view);
        bounds = bounds_of(agents);
        ends_with_somebody = std::ranges::any_of(
            agents, [&](const DrawnAgent& agent) { return sample_at(agent, bounds.max.z).has_value(); });
    }
    const double begin = bounds.min.z;
    // Where all clips are held, a picture at the very end would show nobody.
    const double length = (bounds.max.z - begin) * rate;
    const double count = ends_with_somebody ? std::floor(length + 1e-6) + 1 : std::max(1.0, std::ceil(length - 1e-6));
    const auto at = [view, begin, rate](int i) {
        ViewState out = view;
        out.time = begin + i / rate;
        return out;
    };
    return {count, "the motion has " + brief(count) + " pictures at " + brief(rate) + " per second", at};
}

/// Whether its pictures are the steps of the view's query.
bool shows_steps(const ViewState& view, const SequenceArguments& asked) {
    return !asked.turntable && plays_steps(view);
}

}  // namespace

double film_rate(const ViewState& view, const SequenceArguments& asked) {
    return asked.rate.value_or(shows_steps(view, asked) ? kUsualRateOfSteps : kUsualRate);
}

std::size_t held_pictures(const ViewState& view, const SequenceArguments& asked) {
    if (!shows_steps(view, asked)) return 0;
    return static_cast<std::size_t>(std::lround(kLastStepHeld * film_rate(view, asked)));
}

std::vector<RenderPicture> pictures_of(KeptPaths& kept, const ViewState& view, const RenderArguments& arguments) {
    const SequenceArguments& asked = arguments.sequence;
    if (!asked.any()) return {{view, arguments.outputs}};
    const std::string option = asked.option();
    const auto contradict = [&](const char* other, const char* why) {
        throw InputError(option + " and " + other + " contradict each other: " + why + "; leave one out");
    };
    const bool of_query = shows_steps(view, asked);
    if (of_query && arguments.view.says("step")) contradict("--step", "the pictures are the query's steps");
    if (of_query && asked.rate && !arguments.is_film())
        contradict("--rate", "the pictures are a query's steps; only a film of them has a rate");
    if (!asked.turntable && !of_query && arguments.view.says("time"))
        contradict("--time", "the pictures go through the time");

    const Sequence sequence = asked.turntable ? turntable(view, *asked.turntable)
                              : of_query      ? steps(kept, view)
                                              : motion(*kept.fitted(), view, asked.rate.value_or(kUsualRate));
    const auto [first, last] =
        asked.frames ? std::pair<double, double>(*asked.frames) : std::pair<double, double>(0, sequence.count - 1);
    if (last >= sequence.count) throw InputError(option + ": " + sequence.described + ", counted from 0");
    if (last - first >= kMostPictures) {
        throw InputError(option + ": these are " + brief(last - first + 1) + " pictures; at most " +
                         std::to_string(kMostPictures) + " are made at once");
    }
    const int digits = std::max(kLeastDigits, static_cast<int>(std::to_string(static_cast<int>(last)).size()));
    std::vector<RenderPicture> out;
    for (int i = static_cast<int>(first); i <= static_cast<int>(last); ++i) {
        out.push_back({sequence.view(i), numbered(arguments.outputs, i, digits)});
    }
    return out;
}

}  // namespace mobbscope::cli
