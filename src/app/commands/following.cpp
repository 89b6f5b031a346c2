#include <app/commands/camera_commands.h>
#include <app/commands/following.h>
#include <app/document/run_agents.h>
#include <base/text.h>
#include <render/layout/follow.h>

#include <stdexcept>
#include <vector>

namespace mobbscope::app {

bool follows(const Session& session) { return !session.view().follow.empty(); }

void follow_agent(Session& session, const std::string& name, double metres) {
    if (!can_follow(session.scene(), name)) {
        std::vector<std::string> names = names_in_crowd(session);
        throw std::invalid_argument("there is no agent " + in_quotes(name) + did_you_mean(name, names));
    }
    session.candidate = -1;
    session.change_view([&](ViewState& view) { view.follow = name; });
    frame_followed(session, metres);
    select_in_crowd(session, name);
}

void frame_followed(Session& session, double metres) {
    move_camera(session, [&](const Camera&, const DrawList& list) {
        return framing_followed(session.fitted(), session.view(), list, metres);
    });
}

void center_followed(Session& session) {
    move_camera(session, [&](Camera camera, const DrawList& list) {
        const glm::dvec3 foot = target_of_followed(session.fitted(), session.view(), list);
        camera.target = foot + glm::dvec3(0, 0, 0.5 * kStanding);
        camera.shift = {0, 0};
        return camera;
    });
}

}  // namespace mobbscope::app
