#include <mobb/separation.h>
#include <render/world_box.h>

#include <array>
#include <cstddef>

namespace mobbscope {

mobb::Box world_box(const mobb::PlacedTree& tree, int node) {
    mobb::Box box = tree.node(node).box;
    const mobb::PlacedClip& clip = tree.placed_clip();
    const auto turn = [&](glm::dvec3 v) {
        const glm::dvec2 turned = clip.rotation()(glm::dvec2(v.x, v.y));
        return glm::dvec3(turned.x, turned.y, v.z);
    };
    if (box.kind == mobb::BoxKind::aabb) {
        // Its test wraps it again along the world's axes.
        const glm::dvec2 half = mobb::half_in_world(box, clip.rotation());
        box.half = {half.x, half.y, box.half.z};
    } else {
        for (glm::dvec3& axis : box.axes) axis = turn(axis);
        box.drift = clip.rotation()(box.drift);
    }
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
    const std::array<glm::dvec3, 3> edges = mobb::half_edges(box);
    for (std::size_t i = 0; i < 3; ++i) out.extents[i] = space.extent(edges[i], w);
    out.id = {subject.index, ObjectId::Kind::box, node};
    // Participants side by side at each level: 2^32 leaves room for every node index.
    out.order = {1, subject.placed.node(node).level, (static_cast<std::int64_t>(subject.index) << 32) + node};
    return out;
}

}  // namespace mobbscope
