#include <mobb/separation.h>
#include <render/axis_intervals.h>
#include <render/box_axes.h>

#include <algorithm>

namespace mobbscope {

namespace {

/// The two boxes in the frame of A's path, counted from the middle of A's box: far from the world's origin the numbers
/// keep their digits.
struct BoxPair {
    mobb::Box a, b;
};

BoxPair boxes_of(std::span<const Subject> sides, const mobb::Trace::Event& event) {
    const mobb::PlacedTree& a = sides[0].placed;
    const mobb::PlacedTree& b = sides[1].placed;
    const mobb::RelativeFrame frame(a.frame(), b.frame(), a.time_scale());
    BoxPair pair{a.node(event.a).box, b.node(event.b).box};
    pair.b.center = frame.point(pair.b.center) - pair.a.center;
    for (glm::dvec3& axis : pair.b.axes) axis = frame.direction(axis);
    pair.a.center = glm::dvec3(0);
    return pair;
}

std::string name_of(std::span<const Subject> sides, const BoxPair& boxes, mobb::TestKind test, int axis) {
    const AxisOrigin origin = axis_origin(test, axis);
    const std::string a = origin.a < 0 ? "" : sides[0].label + ' ' + axis_word(boxes.a, test, origin.a);
    const std::string b = origin.b < 0 ? "" : sides[1].label + ' ' + axis_word(boxes.b, test, origin.b);
    return a.empty() ? b : b.empty() ? a : a + " x " + b;
}

}  // namespace

std::vector<AxisInterval> axis_intervals(std::span<const Subject> sides, const mobb::Trace::Event& event) {
    std::vector<AxisInterval> out;
    if (event.test != mobb::TestKind::obb2d && event.test != mobb::TestKind::obb3d) return out;
    const BoxPair boxes = boxes_of(sides, event);
    for (int axis = 0; axis < axis_count(event.test); ++axis) {
        if (!is_tried(boxes.a, boxes.b, event.test, axis)) continue;
        const glm::dvec3 direction = test_axis(boxes.a, boxes.b, event.test, axis);
        const Projection on_a = project(boxes.a, direction);
        const Projection on_b = project(boxes.b, direction);
        out.push_back({axis, name_of(sides, boxes, event.test, axis), on_a.min, on_a.max, on_b.min, on_b.max,
                       std::max(on_b.min - on_a.max, on_a.min - on_b.max)});
    }
    return out;
}

}  // namespace mobbscope
