#include <mobb/separation.h>
#include <render/box_axes.h>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace mobbscope {

namespace {

/// Of one box, in a test.
int own_axes(mobb::TestKind test) { return test == mobb::TestKind::obb3d ? 3 : 2; }

glm::dvec3 axis_of(const mobb::Box& box, int i) { return box.axes[static_cast<std::size_t>(i)]; }

}  // namespace

Projection project(const mobb::Box& box, glm::dvec3 axis) {
    const double center = glm::dot(box.center, axis);
    double reach = 0;
    for (const glm::dvec3& edge : mobb::half_edges(box)) reach += std::abs(glm::dot(edge, axis));
    return {center - reach, center + reach};
}

AxisOrigin axis_origin(mobb::TestKind test, int axis) {
    if (test == mobb::TestKind::aabb) return {};
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

}  // namespace mobbscope
