#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/layout/place_scene.h>

#include <glm/common.hpp>

namespace mobbscope {

namespace {

/// Where legend and map would shrink the scene to less than this they are left out.
constexpr float kLeastShare = 0.62f;

}  // namespace

Blocks aim(DrawList& list, std::span<const glm::vec3> points, const FloorExtent& floor_extent, const ViewState& view,
           const Metrics& metrics, float top, glm::vec2 map, const std::function<std::vector<Rect>()>& busy) {
    const glm::vec2 legend = legend_size(list.legend, metrics.small);
    const Rect area{{metrics.pad, top + 0.3f * metrics.pad},
                    glm::vec2(list.size.width, list.size.height) - metrics.pad};
    const auto place = [&] { return place_blocks(area, legend, map, busy()); };
    const Frame frame = free_frame(list.size, top, floor_extent, view, metrics);
    list.projection = projection_for(list, view, points, frame);
    list.frame = frame;
    Blocks blocks = place();
    if (!blocks.covers || view.camera.target) return blocks;
    // No corner is free: the scene makes room, beside or below it, whichever costs it less.
    const glm::vec2 room = glm::max(legend, map) + metrics.pad;
    Frame beside = frame;
    beside.min.x += room.x;
    Frame above = frame;
    above.max.y -= room.y;
    const ViewProjection lens_beside = projection_for(list, view, points, beside);
    const ViewProjection lens_above = projection_for(list, view, points, above);
    const glm::vec3 middle = 0.5f * (points.front() + points.back());
    const bool fits_beside = lens_beside.pixels_per_metre(middle) >= lens_above.pixels_per_metre(middle);
    const ViewProjection& larger = fits_beside ? lens_beside : lens_above;
    if (larger.pixels_per_metre(middle) < kLeastShare * list.projection.pixels_per_metre(middle)) {
        // The scene is what the picture is for.
        list.legend.clear();
        return place_blocks(area, glm::vec2(0), glm::vec2(0), {});
    }
    list.projection = larger;
    list.frame = fits_beside ? beside : above;
    return place();
}

}  // namespace mobbscope
