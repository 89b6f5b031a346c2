#include <render/world_box.h>

namespace mobbscope {

mobb::Box world_box(const mobb::PlacedTree& tree, int node) {
    mobb::Box box = tree.node(node).box;
    const mobb::PlacedClip& clip = tree.placed_clip();
    const auto turn = [&](glm::dvec3 v) {
        const glm::dvec2 turned = clip.rotation()(glm::dvec2(v.x, v.y));
        return glm::dvec3(turned.x, turned.y, v.z);
    };
    for (glm::dvec3& axis : box.axes) axis = turn(axis);
    const mobb::Placement& placement = clip.placement();
    box.center = turn(box.center) +
                 glm::dvec3(placement.translate.x, placement.translate.y, tree.time_scale() * placement.start);
    return box;
}

BoxInstance node_box(const Subject& subject, int node, const DrawnSpace& space) {
    const mobb::Box box = world_box(subject.placed, node);
    const double w = subject.placed.time_scale();
    BoxInstance out;
    out.center = space.point(box.center.x, box.center.y, box.center.z / w);
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        out.extents[i] = space.extent(box.axes[i] * box.half[axis], w);
    }
    out.id = {subject.index, ObjectId::Kind::box, node};
    // Participants side by side at each level: 2^32 leaves room for every node index.
    out.order = {1, subject.placed.node(node).level, (static_cast<std::int64_t>(subject.index) << 32) + node};
    return out;
}

}  // namespace mobbscope
