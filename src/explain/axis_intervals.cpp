#include <explain/axis_intervals.h>
#include <mobb/separation.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mobbscope {

namespace {

bool tries_world_axes(mobb::TestKind test) { return mobb::info(test.box()).axes == mobb::BoxAxes::world; }

bool tries_line_of_centers(mobb::TestKind test) { return mobb::info(test.box()).axes == mobb::BoxAxes::centers; }

/// A box along the axes of a frame, wrapped again along the world's.
mobb::Box along_the_world(const mobb::Box& box, glm::dvec2 center, const mobb::Rotation& to_world) {
    mobb::Box out;
    out.kind = box.kind;
    const glm::dvec2 half = mobb::half_in_world(glm::dvec2(box.half), to_world);
    out.center = {center.x, center.y, 0};
    out.half = {half.x, half.y, box.half.z};
    return out;
}

/// The two boxes in the frame of A's clip, or turned into the world's directions if the test tries these. They are
/// counted from the middle of A's box: far from the world's origin the numbers keep their digits.
BoxPair boxes_of(const mobb::PlacedTree& a, const mobb::PlacedTree& b, const mobb::Trace::Event& event) {
    const mobb::RelativeFrame frame(a.frame(), b.frame(), a.time_scale());
    BoxPair pair{a.tree().box(event.a), b.tree().box(event.b)};
    pair.b.center = frame.point(pair.b.center) - pair.a.center;
    for (glm::dvec3& axis : pair.b.axes) axis = frame.direction(axis);
    pair.b.drift = frame.direction(pair.b.drift);
    pair.a.center = glm::dvec3(0);
    if (tries_world_axes(event.test)) {
        const mobb::Rotation& to_world = a.placed_clip().rotation();
        const glm::dvec2 middle_b = to_world(glm::dvec2(pair.b.center));
        pair.a = along_the_world(pair.a, glm::dvec2(0), to_world);
        pair.b = along_the_world(pair.b, middle_b, b.placed_clip().rotation());
    }
    return pair;
}

std::string name_of(std::span<const DrawnAgent> sides, const BoxPair& boxes, mobb::TestKind test, int axis) {
    if (tries_world_axes(test)) return axis == 0 ? "x" : "y";
    if (tries_line_of_centers(test)) return "centre to centre";
    const AxisOrigin origin = axis_origin(test, axis);
    const std::string a = origin.a < 0 ? "" : sides[0].label + ' ' + axis_word(boxes.a, test, origin.a);
    const std::string b = origin.b < 0 ? "" : sides[1].label + ' ' + axis_word(boxes.b, test, origin.b);
    return a.empty() ? b : b.empty() ? a : a + " x " + b;
}

/// Of one box, in a test.
int own_axes(mobb::TestKind test) { return mobb::info(test.box()).axes == mobb::BoxAxes::space_time ? 3 : 2; }

glm::dvec3 axis_of(const mobb::Box& box, int i) { return box.axes[static_cast<std::size_t>(i)]; }

mobb::Box rectangle_at(mobb::Box box, double wt) {
    if (box.half.z > 0) {
        const glm::dvec2 moved = box.drift * ((wt - box.center.z) / box.half.z);
        box.center += glm::dvec3(moved.x, moved.y, 0);
    }
    box.center.z = wt;
    box.half.z = 0;
    box.drift = {0, 0};
    return box;
}

BoxPair at_time(const BoxPair& boxes, double wt) { return {rectangle_at(boxes.a, wt), rectangle_at(boxes.b, wt)}; }

/// The two ends of the common time, of which the first is the earlier.
std::array<double, 2> common_time(const BoxPair& boxes) {
    const mobb::Box& a = boxes.a;
    const mobb::Box& b = boxes.b;
    const double begin = std::max(a.center.z - a.half.z, b.center.z - b.half.z);
    return {begin, std::max(begin, std::min(a.center.z + a.half.z, b.center.z + b.half.z))};
}

glm::dvec2 between(const BoxPair& boxes) { return glm::dvec2(boxes.b.center - boxes.a.center); }

/// Two that move, when their centres are nearest along an axis.
BoxPair nearest_along(const BoxPair& boxes, glm::dvec3 axis) {
    const auto [begin, end] = common_time(boxes);
    const double first = glm::dot(between(at_time(boxes, begin)), glm::dvec2(axis));
    const double last = glm::dot(between(at_time(boxes, end)), glm::dvec2(axis));
    if ((first < 0) != (last < 0)) return at_time(boxes, begin + (end - begin) * (first / (first - last)));
    return at_time(boxes, std::abs(first) <= std::abs(last) ? begin : end);
}

/// Two that move, when their centres are nearest.
BoxPair nearest(const BoxPair& boxes) {
    const auto [begin, end] = common_time(boxes);
    const glm::dvec2 first = between(at_time(boxes, begin));
    const glm::dvec2 way = between(at_time(boxes, end)) - first;
    const double squared = glm::dot(way, way);
    const double s = squared > 0 ? std::clamp(-glm::dot(first, way) / squared, 0.0, 1.0) : 0.0;
    return at_time(boxes, begin + s * (end - begin));
}

}  // namespace

std::vector<AxisInterval> axis_intervals(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    std::vector<AxisInterval> out;
    if (!event.test.is_box()) return out;
    const BoxPair boxes = boxes_of(sides[0].placed, sides[1].placed, event);
    for (int axis = 0; axis < mobb::axis_count(event.test); ++axis) {
        if (!is_tried(boxes.a, boxes.b, event.test, axis)) continue;
        const glm::dvec3 direction = test_axis(boxes.a, boxes.b, event.test, axis);
        const BoxPair tested = as_tested(boxes, event.test, direction);
        const double middle = glm::dot(tested.a.center, direction);
        const Projection on_a = project(tested.a, direction).minus(middle);
        const Projection on_b = project(tested.b, direction).minus(middle);
        out.push_back({axis, name_of(sides, boxes, event.test, axis), on_a.min, on_a.max, on_b.min, on_b.max,
                       std::max(on_b.min - on_a.max, on_a.min - on_b.max)});
    }
    return out;
}

glm::dvec3 separating_axis(const mobb::PlacedTree& a, const mobb::PlacedTree& b, const mobb::Trace::Event& event) {
    const BoxPair boxes = boxes_of(a, b, event);
    const glm::dvec3 axis = test_axis(boxes.a, boxes.b, event.test, event.axis);
    if (tries_world_axes(event.test)) return axis;
    const glm::dvec2 turned = a.placed_clip().rotation()(glm::dvec2(axis));
    return {turned.x, turned.y, axis.z};
}

Projection project(const mobb::Box& box, glm::dvec3 axis) {
    const double center = glm::dot(box.center, axis);
    if (mobb::info(box.kind).round) {
        const double disk = box.half.x * std::hypot(axis.x, axis.y);
        const double leaning = std::abs(glm::dot(mobb::half_edges(box)[2], axis));
        return {center - disk - leaning, center + disk + leaning};
    }
    double reach = 0;
    for (const glm::dvec3& edge : mobb::half_edges(box)) reach += std::abs(glm::dot(edge, axis));
    return {center - reach, center + reach};
}

AxisOrigin axis_origin(mobb::TestKind test, int axis) {
    if (tries_world_axes(test) || tries_line_of_centers(test)) return {};
    const int own = own_axes(test);
    if (axis < own) return {axis, -1};
    if (axis < 2 * own) return {-1, axis - own};
    return {(axis - 2 * own) / 3, (axis - 2 * own) % 3};
}

bool is_tried(const mobb::Box& a, const mobb::Box& b, mobb::TestKind test, int axis) {
    const AxisOrigin origin = axis_origin(test, axis);
    if (origin.a < 0 || origin.b < 0) return true;
    const double cosine = glm::dot(axis_of(a, origin.a), axis_of(b, origin.b));
    return 1 - cosine * cosine >= mobb::kShortestEdgeAxis * mobb::kShortestEdgeAxis;
}

glm::dvec3 test_axis(const mobb::Box& a, const mobb::Box& b, mobb::TestKind test, int axis) {
    if (tries_line_of_centers(test)) {
        const glm::dvec2 line = between(nearest({a, b}));
        const double length = glm::length(line);
        return length > 0 ? glm::dvec3(line / length, 0) : glm::dvec3(1, 0, 0);
    }
    const AxisOrigin origin = axis_origin(test, axis);
    if (origin.a < 0 && origin.b < 0) return axis == 0 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    if (origin.b < 0) return axis_of(a, origin.a);
    if (origin.a < 0) return axis_of(b, origin.b);
    return glm::normalize(glm::cross(axis_of(a, origin.a), axis_of(b, origin.b)));
}

std::string axis_word(const mobb::Box& box, mobb::TestKind test, int axis) {
    const int axes = own_axes(test);
    int longer = 0;
    for (int i = 0; i < axes; ++i) {
        longer += box.half[i] > box.half[axis] || (box.half[i] == box.half[axis] && i < axis) ? 1 : 0;
    }
    const std::array<const char*, 3> names{"long", axes == 2 ? "short" : "middle", "short"};
    return names[static_cast<std::size_t>(longer)];
}

BoxPair as_tested(const BoxPair& boxes, mobb::TestKind test, glm::dvec3 axis) {
    if (tries_line_of_centers(test)) return nearest(boxes);
    return mobb::info(test.box()).moves ? nearest_along(boxes, axis) : boxes;
}

}  // namespace mobbscope
