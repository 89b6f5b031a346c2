#include <app/commands/camera_commands.h>
#include <app/document/agents.h>
#include <render/drawlist/camera.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/parts/node_boxes.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/moment.h>

#include <glm/common.hpp>

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

PictureFrame present_picture(const Session& session) {
    const double scale = session.hooks.viewport_scale ? session.hooks.viewport_scale() : 0;
    return picture_frame(session.fitted(), session.view(), viewport_size(session), scale);
}

Camera framing_box(const Camera& camera, const PictureFrame& picture, const Bounds& box) {
    const auto target = [&](glm::dvec3 at) { return picture.space.to_target(picture.space.point(at.x, at.y, at.z)); };
    return framing(camera, target(box.min), target(box.max), picture.size);
}

}  // namespace

PictureSize viewport_size(const Session& session) {
    return session.hooks.viewport_size ? session.hooks.viewport_size() : kWithoutWindow;
}

void move_camera(Session& session, const std::function<Camera(const Camera&, const PictureFrame&)>& move) {
    const PictureFrame picture = present_picture(session);
    const Camera moved = move(picture.camera, picture);
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

std::optional<Bounds> box_of_test(const Session& session) {
    const RecordedQuery* recorded = session.recorded();
    if (!recorded || session.view().show == Show::moment) return std::nullopt;
    const auto event = recorded->trace[session.step()];
    const std::vector<DrawnAgent> sides = drawn_agents(session.fitted(), session.view());
    Bounds bounds;
    add_box(bounds, sides[0].placed, event.a);
    add_box(bounds, sides[1].placed, event.b);
    return bounds;
}

bool is_well_seen(const Bounds& box, const PictureFrame& picture) {
    constexpr float kMiddle = 0.3f;  // of the picture, to either side
    constexpr float kSmall = 0.15f;  // of the picture's shorter side
    const glm::vec2 size(picture.size.width, picture.size.height);
    glm::vec2 low = size;
    glm::vec2 high(0);
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at(corner & 1u ? box.max.x : box.min.x, corner & 2u ? box.max.y : box.min.y,
                            corner & 4u ? box.max.z : box.min.z);
        const auto pixel = picture.projection.project(picture.space.point(at.x, at.y, at.z));
        if (!pixel) return false;
        low = glm::min(low, *pixel);
        high = glm::max(high, *pixel);
    }
    const glm::vec2 aside = glm::abs(0.5f * (low + high) / size - 0.5f);
    const glm::vec2 extent = high - low;
    return std::max(aside.x, aside.y) <= kMiddle && std::max(extent.x, extent.y) >= kSmall * std::min(size.x, size.y);
}

void frame_box(Session& session, const Bounds& box) {
    move_camera(session,
                [&](const Camera& camera, const PictureFrame& picture) { return framing_box(camera, picture, box); });
}

void go_along_with(Session& session, const Bounds& box) {
    const PictureFrame picture = present_picture(session);
    const double chosen = session.view().time_height;
    session.settle_camera(session.active_place(), framing_box(picture.camera, picture, box),
                          chosen > 0 ? 0 : picture.space.time_height);
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
