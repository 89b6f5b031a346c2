#include <render/drawlist/draw_list.h>
#include <render/layout/framing.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mobbscope {

namespace {

/// Where legend and map would shrink the scene to less than this they are left out.
constexpr float kLeastShare = 0.62f;

}  // namespace

void Bounds::add(glm::dvec3 p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
}

void add_samples(Bounds& bounds, const mobb::PlacedClip& clip, mobb::SampleRange range) {
    for (int i = range.first; i < range.end(); ++i) {
        const mobb::Disk disk = clip.disk(i);
        bounds.add({disk.x - disk.r, disk.y - disk.r, clip.time(i)});
        bounds.add({disk.x + disk.r, disk.y + disk.r, clip.time(i + 1)});
    }
}

Bounds bounds_of(std::span<const DrawnAgent> agents) {
    Bounds bounds;
    for (const DrawnAgent& agent : agents) add_samples(bounds, agent.clip(), {0, agent.clip().count()});
    return bounds;
}

Bounds with_boxes(Bounds bounds, const DrawList& list) {
    for (const BoxInstance& box : list.boxes) {
        for (const glm::vec3& corner : box_corners(box)) {
            bounds.add({corner.x + list.space.origin.x, corner.y + list.space.origin.y,
                        corner.z / list.space.time_height + list.space.origin.z});
        }
    }
    return bounds;
}

DrawnSpace space_for(const Bounds& bounds, const ViewState& view) {
    DrawnSpace space;
    const glm::dvec3 extent = bounds.max - bounds.min;
    space.origin = {0.5 * (bounds.min.x + bounds.max.x), 0.5 * (bounds.min.y + bounds.max.y), bounds.min.z};
    // A point that stands still has no width to match.
    const double wide = std::max({extent.x, extent.y, 1e-3});
    space.time_height = view.time_height > 0 ? view.time_height : wide / extent.z;
    return space;
}

void add_floor_points(ShownPoints& points, const DrawnSpace& space, const FloorExtent& floor_extent,
                      const ViewState& view, bool has_cursor) {
    const std::vector<glm::vec3> corners = floor_corners(floor_extent, space);
    if (view.floor || has_cursor || points.empty()) points.add(std::span(corners).first(has_cursor ? 8 : 4));
    if (!view.time_axis) return;
    const glm::dvec2 foot = axis_corner(floor_extent, glm::vec3(directions(view.camera).right));
    for (const double t : {floor_extent.t0, floor_extent.t1}) points.add(space.point(foot.x, foot.y, t));
}

Frame free_frame(PictureSize size, float top, const FloorExtent& floor_extent, const ViewState& view,
                 const Metrics& metrics) {
    const glm::vec2 picture(size.width, size.height);
    const Frame bare{glm::vec2(metrics.pad, std::max(metrics.pad, top)), picture - metrics.pad};
    if (!view.labels) return bare;
    Frame frame = bare;
    const Font& mono = Font::of(FontFace::mono);
    frame.min.y += 1.8f * metrics.text;  // names over the paths
    if (view.floor) {
        const bool floor_seen_level = std::abs(orientation(view.camera).pitch_deg) < 2;
        frame.max.y -= 1.6f * metrics.small;
        // Half of what the corner of the floor is labelled with goes beyond it, all of it where that corner is to the
        // right.
        frame.max.x -=
            mono.width("y " + longest_distance(floor_extent) + " m", metrics.small) * (floor_seen_level ? 0.5f : 1.0f);
    }
    if (view.time_axis) frame.min.x += mono.width(longest_tick(floor_extent), metrics.small) + metrics.small;
    // In a tiny picture the scene matters more than its labels, which then stand where they find room.
    const bool enough = frame.max.x - frame.min.x > 0.5f * picture.x && frame.max.y - frame.min.y > 0.4f * picture.y;
    return enough ? frame : bare;
}

ViewProjection projection_for(const DrawList& list, const ViewState& view, const ShownPoints& points,
                              const Frame& frame) {
    std::optional<glm::vec3> target;
    if (view.camera.target) target = list.space.from_target(*view.camera.target);
    return make_projection(view.camera, points, target ? &*target : nullptr, frame, list.size);
}

Blocks aim(DrawList& list, const ShownPoints& points, const FloorExtent& floor_extent, const ViewState& view,
           const Metrics& metrics, float top, glm::vec2 map, const std::function<std::vector<Rect>()>& busy) {
    const glm::vec2 legend(0);
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
