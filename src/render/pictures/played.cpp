#include <base/text.h>
#include <render/pictures/played.h>
#include <scene/crowd_run.h>
#include <scene/drawn_agent.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace mobbscope {

namespace {

constexpr double kUsualRate = 30;
constexpr double kUsualRateOfSteps = 2;
constexpr double kLastStepHeld = 2;  // seconds

}  // namespace

Played played_of(const ViewState& view, bool turns) {
    if (turns) return Played::turn;
    return plays_steps(view) ? Played::steps : Played::motion;
}

MotionPictures motion_pictures(const FittedScene& fitted, const ViewState& view, double rate) {
    double begin = 0, end = 0;
    bool ends_with_somebody = false;
    if (fitted.scene().crowd) {
        end = fitted.scene().crowd->seconds;
    } else {
        const std::vector<DrawnAgent> agents = drawn_agents(fitted, view);
        if (agents.empty()) return {0, 1};  // who draws it refuses the scene
        begin = std::ranges::min_element(agents, {}, &DrawnAgent::begin)->begin();
        end = std::ranges::max_element(agents, {}, &DrawnAgent::end)->end();
        ends_with_somebody =
            std::ranges::any_of(agents, [&](const DrawnAgent& agent) { return sample_at(agent, end).has_value(); });
    }
    // Where all clips are held, a picture at the very end would show nobody.
    const double length = (end - begin) * rate;
    return {begin, ends_with_somebody ? std::floor(length + 1e-6) + 1 : std::max(1.0, std::ceil(length - 1e-6))};
}

FilmPace film_pace(Played played, double rate) {
    const bool steps = played == Played::steps;
    const double used = rate > 0 ? rate : steps ? kUsualRateOfSteps : kUsualRate;
    return {used, steps ? static_cast<std::size_t>(std::lround(kLastStepHeld * used)) : 0};
}

PictureSize film_size(const PictureOptions& asked) {
    const auto [width, height] = asked.size;
    PictureOptions larger = asked;
    larger.size = {width + width % 2, height + height % 2};
    try {
        check(larger);
        return larger.size;
    } catch (const std::invalid_argument&) {
        return {width - width % 2, height - height % 2};
    }
}

std::string film_text(std::size_t pictures, const FilmPace& pace, PictureSize size) {
    const std::size_t count = pictures + pace.held;
    return figure(static_cast<double>(count) / pace.rate, 3) + " s: " + counted(count, "picture", "pictures") + " of " +
           size_word(size) + " at " + brief(pace.rate) + " a second";
}

}  // namespace mobbscope
