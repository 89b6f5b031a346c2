#include <app/commands/camera_commands.h>
#include <app/document/agents.h>
#include <render/drawlist/camera.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/parts/node_boxes.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/moment.h>

#include <algorithm>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr PictureSize kWithoutWindow{1280, 720};

void add_box(Bounds& bounds, const mobb::PlacedTree& tree, int node) {
    for (const glm::dvec3& corner : mobb::corners(world_box(tree, node))) {
        bounds.add({corner.x, corner.y, corner.z / tree.time_scale()});
    }
}

}  // namespace

PictureSize viewport_size(const Session& session) {
    return session.hooks.viewport_size ? session.hooks.viewport_size() : kWithoutWindow;
}

void move_camera(Session& session, const std::function<Camera(const Camera&, const PictureFrame&)>& move) {
    const PictureSize size = viewport_size(session);
    const double scale = session.hooks.viewport_scale ? session.hooks.viewport_scale() : 0;
    const PictureFrame picture = picture_frame(session.fitted(), session.view(), size, scale);
    const Camera moved = move(resolved_camera(session.view().camera, picture), picture);
    session.change_view([&](ViewState& view) {
        view.camera = moved;
        if (!picture.moment) view.time_height = picture.space.time_height;
    });
}

std::optional<Bounds> box_of(const Session& session, const Selection& selected) {
    Bounds bounds;
    const std::vector<DrawnAgent> shown = drawn_agents(session.fitted(), session.view());
    const std::optional<int> index =
        selected.on_path() ? index_in_view(session.fitted(), session.view(), selected.path) : std::nullopt;
    const mobb::Clip* of_clip = selected.kind == Selection::Kind::clip
                                    ? session.scene().clips[static_cast<std::size_t>(selected.index)].clip.get()
                                    : nullptr;
    const bool all = selected.kind == Selection::Kind::query && session.view().query == selected.index;
    for (const DrawnAgent& agent : shown) {
        const mobb::PlacedClip& clip = agent.clip();
        if (!all && index != agent.index && of_clip != &clip.clip()) continue;
        if (selected.kind == Selection::Kind::node) {
            add_box(bounds, agent.placed, selected.index);
        } else if (selected.kind == Selection::Kind::sample) {
            add_samples(bounds, clip, {selected.index, 1});
        } else {
            add_samples(bounds, clip, {0, clip.count()});
        }
    }
    if (bounds.min.x > bounds.max.x) return std::nullopt;
    if (session.view().show == Show::moment) {
        const std::vector<double> heights = cylinder_heights(shown);
        bounds.min.z = 0;
        bounds.max.z = *std::max_element(heights.begin(), heights.end());
    }
    return bounds;
}

bool follows(const Session& session) { return !session.view().follow.empty(); }

void follow_agent(Session& session, const std::string& name, double metres) {
    index_of_name(agent_names(session), name, "agent");
    session.change_view([&](ViewState& view) { view.follow = name; });
    frame_followed(session, metres);
    select_agent_named(session, name);
}

void frame_followed(Session& session, double metres) {
    move_camera(session, [&](const Camera&, const PictureFrame& picture) {
        return framing_followed(session.fitted(), session.view(), picture, metres);
    });
}

void center_followed(Session& session) {
    move_camera(session, [&](Camera camera, const PictureFrame& picture) {
        const glm::dvec3 foot = target_of_followed(session.fitted(), session.view(), picture);
        camera.target = foot + glm::dvec3(0, 0, 0.5 * kStanding);
        camera.shift = {0, 0};
        return camera;
    });
}

}  // namespace mobbscope::app
