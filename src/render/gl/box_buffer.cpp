#include <render/gl/box_buffer.h>

#include <utility>

namespace mobbscope {

namespace {

/// How strongly the edges of a box show through disks.
constexpr float kHiddenEdge = 0.38f;

}  // namespace

glm::vec2 slab_of(const DrawnWorld& world) {
    constexpr float kFar = 1e30f;
    return world.slab ? glm::vec2(world.slab->low, world.slab->high) : glm::vec2(-kFar, kFar);
}

LineStyle edge_style(const BoxInstance& box) { return {box.edge, box.width, box.dash, kHiddenEdge, 0.5f * box.width}; }

void BoxBuffer::keep(const DrawnWorld& world, DrawStatistics& statistics) {
    std::vector<Shape> shapes;
    std::vector<Look> looks;
    shapes.reserve(world.boxes.size());
    looks.reserve(world.boxes.size());
    orders_.clear();
    for (const BoxInstance* box : in_order(world.boxes)) {
        Shape shape{box->center, {box->extents[0], box->extents[1], box->extents[2]}, {0, 0}};
        if (box->pickable) {
            shape.id[0] = box->id.r();
            shape.id[1] = box->id.g();
        } else if (box->triangle) {
            shape.id[1] = kTriangle;
        } else if (box->state == BoxState::annotation) {
            shape.id[1] = kSheet;
        }
        shapes.push_back(shape);
        const LineStyle edge = edge_style(*box);
        looks.push_back({box->fill, {edge.color, edge.dash, {edge.width, edge.cap, edge.hidden}}});
        orders_.push_back(box->order);
    }
    statistics.world_bytes += shapes_.take(std::move(shapes));
    statistics.state_bytes += looks_.take(std::move(looks));
}

}  // namespace mobbscope
