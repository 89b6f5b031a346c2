#include <app/commands/camera_commands.h>
#include <app/document/agents.h>
#include <mobb/traversal.h>
#include <render/drawlist/camera.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/parts/node_boxes.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/moment.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr PictureSize kWithoutWindow{1280, 720};

// The camera that follows a test goes farther back than it needs to, or it would fly at every step.
constexpr float kSmallTest = 0.25f;  // of the picture's shorter side
constexpr double kTestMargin = 0.8;  // around it

/// In (x, y, t).
std::vector<glm::dvec3> corners_of_node(const mobb::PlacedTree& tree, int node) {
    std::vector<glm::dvec3> out;
    for (const glm::dvec3& corner : mobb::corners(world_box(tree, node))) {
        out.emplace_back(corner.x, corner.y, corner.z / tree.time_scale());
    }
    return out;
}

/// Whether a rectangle overlaps the convex hull of points: no line along a side of either parts them.
bool meets(const Rect& rect, std::span<const glm::vec2> points) {
    const std::array<glm::vec2, 4> corners{{rect.min, {rect.max.x, rect.min.y}, rect.max, {rect.min.x, rect.max.y}}};
    const auto reach = [](std::span<const glm::vec2> of, glm::vec2 way) {
        glm::vec2 out(std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest());
        for (const glm::vec2 p : of) {
            out = {std::min(out.x, glm::dot(p, way)), std::max(out.y, glm::dot(p, way))};
        }
        return out;
    };
    const auto parts = [&](glm::vec2 way) {
        const glm::vec2 a = reach(corners, way);
        const glm::vec2 b = reach(points, way);
        return a.y <= b.x || b.y <= a.x;
    };
    if (parts({1, 0}) || parts({0, 1})) return false;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            const glm::vec2 side = points[j] - points[i];
            if (side != glm::vec2(0) && parts({-side.y, side.x})) return false;
        }
    }
    return true;
}

PictureFrame present_picture(const Views& views, const Workspace& workspace) {
    const double scale = views.picture ? views.picture->scale : 0;
    return picture_frame(workspace.fitted(), workspace.view(), viewport_size(views), scale);
}

Camera framing_box(const Camera& camera, const PictureFrame& picture, const Bounds& box) {
    const auto target = [&](glm::dvec3 at) { return picture.space.to_target(picture.space.point(at.x, at.y, at.z)); };
    return framing(camera, target(box.min), target(box.max), picture.size);
}

}  // namespace

PictureSize viewport_size(const Views& views) { return views.picture ? views.picture->size : kWithoutWindow; }

void move_camera(Views& views, Workspace& workspace,
                 const std::function<Camera(const Camera&, const PictureFrame&)>& move) {
    const PictureFrame picture = present_picture(views, workspace);
    const Camera moved = move(picture.camera, picture);
    workspace.change_view([&](ViewState& view) {
        view.camera = moved;
        if (!picture.moment) view.time_height = picture.space.time_height;
    });
}

std::optional<Bounds> box_of(const Workspace& workspace, const Selection& selected) {
    Bounds bounds;
    const std::vector<DrawnAgent> shown = drawn_agents(workspace.fitted(), workspace.view());
    const std::optional<int> index =
        selected.on_path() ? index_in_view(workspace.fitted(), workspace.view(), selected.path) : std::nullopt;
    const mobb::Clip* of_clip = selected.kind == Selection::Kind::clip
                                    ? workspace.scene().clips[static_cast<std::size_t>(selected.index)].clip.get()
                                    : nullptr;
    const bool all = selected.kind == Selection::Kind::query && workspace.view().query == selected.index;
    for (const DrawnAgent& agent : shown) {
        const mobb::PlacedClip& clip = agent.clip();
        if (!all && index != agent.index && of_clip != &clip.clip()) continue;
        if (selected.kind == Selection::Kind::node) {
            for (const glm::dvec3& corner : corners_of_node(agent.placed, selected.index)) bounds.add(corner);
        } else {
            const bool is_sample = selected.kind == Selection::Kind::sample;
            const mobb::SampleRange range =
                is_sample ? mobb::SampleRange{selected.index, 1} : mobb::SampleRange{0, clip.count()};
            for (const mobb::PlacedClip& path : agent.paths()) add_samples(bounds, path, range);
        }
    }
    if (bounds.min.x > bounds.max.x) return std::nullopt;
    if (workspace.view().show != Show::space_time) {
        const std::vector<double> heights = cylinder_heights(shown);
        bounds.min.z = 0;
        bounds.max.z = *std::max_element(heights.begin(), heights.end());
    }
    return bounds;
}

std::optional<Bounds> box_of_slab(const Workspace& workspace) {
    const ViewState& view = workspace.view();
    if (!view.slab || view.show != Show::space_time || workspace.crowd()) return std::nullopt;
    Bounds bounds;
    for (const DrawnAgent& agent : drawn_agents(workspace.fitted(), view)) {
        if (!agent.is_whole()) continue;
        const mobb::PlacedClip& clip = agent.clip();
        const int first = mobb::first_ending_after(clip, 0, clip.count(), view.slab->least);
        const int end = mobb::first_ending_after(clip, 0, clip.count(), view.slab->most) + 1;
        for (const mobb::PlacedClip& path : agent.paths()) {
            if (clip.time(0) <= view.slab->most)
                add_samples(bounds, path, {first, std::min(end, clip.count()) - first});
        }
        if (!view.frame_boxes || view.query || !view.boxes) continue;
        for (const int node : shown_nodes(agent.placed.tree(), view.levels)) {
            if (agent.placed.end(agent.placed.node(node)) <= view.slab->least ||
                agent.placed.begin(agent.placed.node(node)) > view.slab->most)
                continue;
            for (const glm::dvec3& corner : corners_of_node(agent.placed, node)) bounds.add(corner);
        }
    }
    if (bounds.min.x > bounds.max.x) return std::nullopt;
    if (view.cut_boxes || !view.frame_boxes) {
        bounds.min.z = std::max(bounds.min.z, view.slab->least);
        bounds.max.z = std::min(bounds.max.z, view.slab->most);
    }
    return bounds;
}

std::optional<TestCorners> corners_of_test(const Workspace& workspace) {
    const RecordedQuery* recorded = workspace.recorded();
    if (!recorded || workspace.view().show != Show::space_time) return std::nullopt;
    const auto event = recorded->trace[workspace.step()];
    const std::vector<DrawnAgent> sides = drawn_agents(workspace.fitted(), workspace.view());
    return TestCorners{corners_of_node(sides[0].placed, event.a), corners_of_node(sides[1].placed, event.b)};
}

std::optional<Bounds> box_of_test(const Workspace& workspace) {
    const std::optional<TestCorners> boxes = corners_of_test(workspace);
    if (!boxes) return std::nullopt;
    Bounds bounds;
    for (const std::vector<glm::dvec3>& box : *boxes) {
        for (const glm::dvec3& corner : box) bounds.add(corner);
    }
    return bounds;
}

bool is_well_seen(const TestCorners& boxes, const PictureFrame& picture, std::span<const Rect> panels) {
    const glm::vec2 size(picture.size.width, picture.size.height);
    glm::vec2 low = size;
    glm::vec2 high(0);
    for (const std::vector<glm::dvec3>& box : boxes) {
        std::vector<glm::vec2> outline;
        for (const glm::dvec3& corner : box) {
            const auto pixel = picture.projection.project(picture.space.point(corner.x, corner.y, corner.z));
            if (!pixel || !Rect{{0, 0}, size}.contains({*pixel, *pixel})) return false;
            outline.push_back(*pixel);
            low = glm::min(low, *pixel);
            high = glm::max(high, *pixel);
        }
        if (std::ranges::any_of(panels, [&](const Rect& panel) { return meets(panel, outline); })) return false;
    }
    const glm::vec2 extent = high - low;
    return std::max(extent.x, extent.y) >= kSmallTest * std::min(size.x, size.y);
}

Camera framing_beside(const TestCorners& boxes, const PictureFrame& picture, std::span<const Rect> panels) {
    ShownPoints points;
    for (const std::vector<glm::dvec3>& box : boxes) {
        for (const glm::dvec3& corner : box) points.add(picture.space.point(corner.x, corner.y, corner.z));
    }
    return framed_camera(without_target(picture.camera), points, picture.space, picture.size, panels, kTestMargin);
}

void frame_box(Views& views, Workspace& workspace, const Bounds& box) {
    move_camera(views, workspace,
                [&](const Camera& camera, const PictureFrame& picture) { return framing_box(camera, picture, box); });
}

void go_along_with(Views& views, Workspace& workspace, const TestCorners& boxes, std::span<const Rect> panels) {
    const PictureFrame picture = present_picture(views, workspace);
    const double chosen = workspace.view().time_height;
    views.settle_camera(views.active(), framing_beside(boxes, picture, panels),
                        chosen > 0 ? 0 : picture.space.time_height);
}

bool follows(const Workspace& workspace) { return !workspace.view().follow.empty(); }

void follow_agent(Workspace& workspace, Views& views, const std::string& name, double metres) {
    index_of_name(agent_names(workspace), name, "agent");
    workspace.change_view([&](ViewState& view) { view.follow = name; });
    frame_followed(views, workspace, metres);
    select_agent_named(workspace, name);
}

void frame_followed(Views& views, Workspace& workspace, double metres) {
    move_camera(views, workspace, [&](const Camera&, const PictureFrame& picture) {
        return framing_followed(workspace.fitted(), workspace.view(), picture, metres);
    });
}

void center_followed(Views& views, Workspace& workspace) {
    move_camera(views, workspace, [&](Camera camera, const PictureFrame& picture) {
        const glm::dvec3 foot = target_of_followed(workspace.fitted(), workspace.view(), picture);
        camera.target = foot + glm::dvec3(0, 0, 0.5 * kStanding);
        camera.shift = {0, 0};
        return camera;
    });
}

}  // namespace mobbscope::app
