#include <app/commands/explicit_view.h>
#include <app/commands/following.h>
#include <app/crowd_view.h>
#include <import/text.h>
#include <render/follow.h>
#include <render/navigate.h>

#include <stdexcept>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr double kStanding = 1.8;  // metres: people's height

/// Where the followed agent stands, as a target: counted from itself, so only its height in the picture counts.
glm::dvec3 foot(const Session& session, const DrawList& list) {
    if (list.moment) return glm::dvec3(0);
    return {0, 0, (run_or_cursor_time(session) - list.space.anchor.z) * list.space.time_height};
}

}  // namespace

bool follows(const Session& session) { return !session.view().follow.empty(); }

void follow_agent(Session& session, const std::string& name, double metres) {
    if (!can_follow(session.scene(), name)) {
        std::vector<std::string> names = names_in_crowd(session);
        throw std::invalid_argument("there is no agent " + in_quotes(name) + did_you_mean(name, names));
    }
    session.candidate = -1;
    session.look([&](ViewState& view) { view.follow = name; });
    frame_followed(session, metres);
    select_in_crowd(session, name);
}

void frame_followed(Session& session, double metres) {
    move_camera(session, [&](const Camera& camera, const DrawList& list) {
        const glm::dvec3 at = foot(session, list);
        const glm::dvec3 low = at - glm::dvec3(metres, metres, 0);
        return framing(camera, low, at + glm::dvec3(metres, metres, kStanding), list.size);
    });
}

void center_followed(Session& session) {
    move_camera(session, [&](Camera camera, const DrawList& list) {
        camera.target = foot(session, list) + glm::dvec3(0, 0, 0.5 * kStanding);
        camera.shift = {0, 0};
        return camera;
    });
}

}  // namespace mobbscope::app
