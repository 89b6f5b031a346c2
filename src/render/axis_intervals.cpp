#include <mobb/separation.h>
#include <render/axis_intervals.h>
#include <render/box_axes.h>
#include <render/nearest_moment.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace mobbscope {

namespace {

/// The two boxes in the frame of A's path, of an aabb test in the world's directions, counted from the middle of A's
/// box: far from the world's origin the numbers keep their digits.
/// A box along the axes of a frame, wrapped again along the world's.
mobb::Box along_the_world(const mobb::Box& box, glm::dvec2 center, const mobb::Rotation& to_world) {
    mobb::Box out;
    out.kind = mobb::BoxKind::aabb;
    const glm::dvec2 half = mobb::half_in_world(box, to_world);
    out.center = {center.x, center.y, 0};
    out.half = {half.x, half.y, box.half.z};
    return out;
}

BoxPair boxes_of(std::span<const Subject> sides, const mobb::Trace::Event& event) {
    const mobb::PlacedTree& a = sides[0].placed;
    const mobb::PlacedTree& b = sides[1].placed;
    const mobb::RelativeFrame frame(a.frame(), b.frame(), a.time_scale());
    BoxPair pair{a.node(event.a).box, b.node(event.b).box};
    pair.b.center = frame.point(pair.b.center) - pair.a.center;
    for (glm::dvec3& axis : pair.b.axes) axis = frame.direction(axis);
    pair.b.drift = frame.direction(pair.b.drift);
    pair.a.center = glm::dvec3(0);
    if (event.test == mobb::TestKind::aabb) {
        const mobb::Rotation& to_world = a.placed_clip().rotation();
        const glm::dvec2 middle_b = to_world(glm::dvec2(pair.b.center));
        pair.a = along_the_world(pair.a, glm::dvec2(0), to_world);
        pair.b = along_the_world(pair.b, middle_b, b.placed_clip().rotation());
    }
    return pair;
}

std::string name_of(std::span<const Subject> sides, const BoxPair& boxes, mobb::TestKind test, int axis) {
    if (test == mobb::TestKind::aabb) return axis == 0 ? "x" : "y";
    const AxisOrigin origin = axis_origin(test, axis);
    const std::string a = origin.a < 0 ? "" : sides[0].label + ' ' + axis_word(boxes.a, test, origin.a);
    const std::string b = origin.b < 0 ? "" : sides[1].label + ' ' + axis_word(boxes.b, test, origin.b);
    return a.empty() ? b : b.empty() ? a : a + " x " + b;
}

}  // namespace

std::vector<AxisInterval> axis_intervals(std::span<const Subject> sides, const mobb::Trace::Event& event) {
    std::vector<AxisInterval> out;
    const BoxPair boxes = boxes_of(sides, event);
    for (int axis = 0; axis < mobb::axis_count(event.test); ++axis) {
        if (!is_tried(boxes.a, boxes.b, event.test, axis)) continue;
        const glm::dvec3 direction = test_axis(boxes.a, boxes.b, event.test, axis);
        const BoxPair tested = event.test == mobb::TestKind::moving ? at_nearest_moment(boxes, direction) : boxes;
        const double middle = glm::dot(tested.a.center, direction);
        const Projection on_a = project(tested.a, direction).minus(middle);
        const Projection on_b = project(tested.b, direction).minus(middle);
        out.push_back({axis, name_of(sides, boxes, event.test, axis), on_a.min, on_a.max, on_b.min, on_b.max,
                       std::max(on_b.min - on_a.max, on_a.min - on_b.max)});
    }
    return out;
}

}  // namespace mobbscope
