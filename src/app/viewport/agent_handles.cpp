#include <app/ui/swatch.h>
#include <app/viewport/agent_handles.h>
#include <explain/query_proof.h>
#include <render/drawlist/pen.h>
#include <render/drawlist/pick.h>
#include <render/parts/floor_and_axes.h>
#include <render/query/proof_walls.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mobbscope::app {

namespace {

constexpr float kKnob = 6;        // radius of what is taken hold of, pixels at scale 1
constexpr float kReach = 10;      // ... and how near the mouse must be
constexpr float kLeastRing = 34;  // pixels at scale 1
constexpr float kArrow = 56;

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

double snapped(double value, double step) { return std::round(value / step) * step; }

float distance(ImVec2 a, ImVec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The circle that turns an agent, on a ground line that sets it off from what is below.
void draw_circle(Ui& ui, const ShownPicture& picture, const HandlePlaces& places, ImU32 color) {
    constexpr int kSides = 64;
    std::array<std::optional<ImVec2>, kSides + 1> points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 rim = glm::dvec2(places.pivot) + places.radius * on_circle(static_cast<double>(i), kSides);
        points[i] = picture.at(picture.list.space.point(rim.x, rim.y, places.time));
    }
    const auto draw = [&](ImU32 line_color, float width) {
        for (std::size_t i = 0; i < kSides; ++i) {
            if (!points[i] || !points[i + 1]) continue;
            ImGui::GetWindowDrawList()->AddLine(*points[i], *points[i + 1], line_color, width);
        }
    };
    draw(to_im(with_alpha(ui.style.palette.background, 0.75f)), ui.px(3.2f));
    draw(color, ui.px(1.2f));
}

}  // namespace

std::optional<ImVec2> ShownPicture::at(glm::vec3 point) const {
    const auto pixel = list.projection.project(point);
    if (!pixel) return std::nullopt;
    return ImVec2{corner.x + pixel->x, corner.y + pixel->y};
}

HandlePlaces handle_places(Ui& ui, const ShownPicture& picture, const mobb::PlacedClip& clip) {
    const DrawnSpace& space = picture.list.space;
    const ViewProjection& projection = picture.list.projection;
    const mobb::Disk first = clip.disk(0);
    HandlePlaces out;
    out.time = clip.time(0);
    out.pivot = {first.x, first.y};
    const glm::vec3 middle = space.point(first.x, first.y, out.time);
    const float scale = projection.pixels_per_metre(middle);
    if (scale <= 0) return out;
    out.radius = std::max(1.35 * first.r, static_cast<double>(ui.px(kLeastRing) / scale));
    // In front, seen from the eye, where the path does not hide it.
    const glm::dvec2 towards(projection.back.x, projection.back.y);
    const glm::dvec2 front = glm::length(towards) > 1e-3 ? glm::normalize(towards) : glm::dvec2(0, -1);
    const glm::dvec2 knob = out.pivot + out.radius * front;
    if (!floor_on_edge(projection)) {
        out.move = picture.at(middle);
        out.turn = picture.at(space.point(knob.x, knob.y, out.time));
    }
    if (!time_on_end(projection)) {
        const glm::dvec2 side = out.pivot - out.radius * glm::dvec2(projection.right.x, projection.right.y);
        out.shift = picture.at(space.point(side.x, side.y, out.time + ui.px(kArrow) / scale / space.time_height));
    }
    return out;
}

Handle handle_at(Ui& ui, const HandlePlaces& places, ImVec2 mouse) {
    // Seen from low down they stand close together: the nearest is meant.
    Handle found = Handle::none;
    float least = ui.px(kReach);
    const auto consider = [&](const std::optional<ImVec2>& at, Handle handle) {
        if (!at || distance(*at, mouse) > least) return;
        least = distance(*at, mouse);
        found = handle;
    };
    consider(places.shift, Handle::shift);
    consider(places.turn, Handle::turn);
    consider(places.move, Handle::move);
    return found;
}

void draw_handles(Ui& ui, const ShownPicture& picture, const HandlePlaces& places, Handle lit) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const DrawnSpace& space = picture.list.space;
    const ImU32 ground = to_im(ui.style.palette.background);
    const auto color = [&](Handle handle) { return handle == lit ? ui.style.accent : ui.style.text; };
    const auto knob = [&](ImVec2 at, Handle handle) {
        draw.AddCircleFilled(at, ui.px(kKnob + 1.5f), ground);
        draw.AddCircleFilled(at, ui.px(kKnob), color(handle));
    };
    if (places.turn) {
        draw_circle(ui, picture, places, color(Handle::turn));
        knob(*places.turn, Handle::turn);
    }
    if (places.shift) {
        const glm::vec3 right = picture.list.projection.right;
        const glm::dvec2 side = places.pivot - places.radius * glm::dvec2(right.x, right.y);
        if (const auto foot = picture.at(space.point(side.x, side.y, places.time))) {
            const ImVec2 head = *places.shift;
            draw.AddLine(*foot, head, ground, ui.px(3.5f));
            draw.AddLine(*foot, head, color(Handle::shift), ui.px(1.5f));
            const float w = ui.px(kKnob);
            draw.AddTriangleFilled({head.x - w, head.y + w}, {head.x + w, head.y + w}, {head.x, head.y - w},
                                   color(Handle::shift));
        }
    }
    if (places.move) {
        knob(*places.move, Handle::move);
        const ImVec2 at = *places.move;
        const float arm = ui.px(kKnob - 2);
        draw.AddLine({at.x - arm, at.y}, {at.x + arm, at.y}, ground, ui.px(1.5f));
        draw.AddLine({at.x, at.y - arm}, {at.x, at.y + arm}, ground, ui.px(1.5f));
    }
}

std::optional<double> DragPromise::room(const HandleDrag& drag, const mobb::Placement& now) const {
    if (drag.handle == Handle::shift) return margins.shift_in_time - std::abs(now.start - drag.start.start);
    if (drag.handle != Handle::move) return std::nullopt;
    const glm::dvec2 shift = now.translate - drag.start.translate;
    return room_left(certificate, of_a ? -shift : shift);
}

std::vector<glm::dvec2> DragPromise::region(const HandleDrag& drag) const {
    std::vector<glm::dvec2> out;
    for (const glm::dvec2 shift : margins.free_region) out.push_back(drag.pivot + (of_a ? -shift : shift));
    return out;
}

void draw_promise(Ui& ui, const ShownPicture& picture, const DragPromise& promise, const HandleDrag& drag, bool kept) {
    const EventMark mark = kept ? EventMark::separated : EventMark::overlap;
    // What is farther off than the picture is wide is not seen.
    const DrawList& list = picture.list;
    const float metre = list.projection.pixels_per_metre(list.space.point(drag.pivot.x, drag.pivot.y, drag.time));
    if (metre <= 0) return;
    const glm::dvec2 near(std::max(list.size.width, list.size.height) / static_cast<double>(metre));
    const std::vector<glm::dvec2> region = cut_to(promise.region(drag), drag.pivot - near, drag.pivot + near);
    // In short pieces, as parts of it may lie before the nearest that is drawn.
    constexpr std::size_t kPieces = 48;
    std::vector<std::optional<ImVec2>> points;
    for (std::size_t i = 0; i < region.size(); ++i) {
        for (std::size_t piece = 0; piece < kPieces; ++piece) {
            const double share = static_cast<double>(piece) / kPieces;
            const glm::dvec2 at = region[i] + share * (region[(i + 1) % region.size()] - region[i]);
            points.push_back(picture.at(list.space.point(at.x, at.y, drag.time)));
        }
    }
    std::vector<ImVec2> seen;
    for (const auto& at : points)
        if (at) seen.push_back(*at);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    // What is cut off by a plane stays convex.
    if (seen.size() > 2)
        draw.AddConvexPolyFilled(
            seen.data(), static_cast<int>(seen.size()),
            to_im(with_alpha(kept ? ui.style.palette.separated : ui.style.palette.overlap, 0.12f)));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& from = points[i];
        const auto& to = points[(i + 1) % points.size()];
        if (from && to) draw.AddLine(*from, *to, mark_color(ui.style, mark), ui.px(2));
    }
}

std::optional<mobb::Placement> dragged(const HandleDrag& drag, const DrawList& list, glm::vec2 pixel, bool snap) {
    mobb::Placement out = drag.start;
    if (drag.handle == Handle::shift) {
        // Seconds along the time axis as it is seen where the drag began.
        const glm::vec3 foot = list.space.point(drag.pivot.x, drag.pivot.y, drag.time);
        const auto here = list.projection.project(foot);
        const auto above = list.projection.project(foot + glm::vec3(0, 0, 1));
        if (!here || !above) return std::nullopt;
        const glm::vec2 metre = *above - *here;
        const float length = glm::dot(metre, metre);
        if (length < 1e-6f) return std::nullopt;
        out.start += glm::dot(pixel - drag.from, metre) / length / list.space.time_height;
        if (snap) out.start = snapped(out.start, 0.1);
        return out;
    }
    const auto from = floor_at(list, drag.from, drag.time);
    const auto to = floor_at(list, pixel, drag.time);
    if (!from || !to) return std::nullopt;
    if (drag.handle == Handle::move) {
        out.translate += *to - *from;
        if (snap) out.translate = {snapped(out.translate.x, 0.1), snapped(out.translate.y, 0.1)};
        return out;
    }
    const glm::dvec2 before = *from - drag.pivot;
    const glm::dvec2 after = *to - drag.pivot;
    if (glm::length(before) < 1e-9 || glm::length(after) < 1e-9) return std::nullopt;
    double turned = drag.start.rotate_deg + degrees(std::atan2(after.y, after.x) - std::atan2(before.y, before.x));
    if (snap) turned = snapped(turned, 5);
    out.rotate_deg = std::remainder(turned, 360);
    // The clip turns about its own origin; moved so that the pivot stays.
    const mobb::Rotation turn = mobb::Rotation::from_degrees(out.rotate_deg - drag.start.rotate_deg);
    out.translate = drag.pivot + turn(drag.start.translate - drag.pivot);
    return out;
}

}  // namespace mobbscope::app
