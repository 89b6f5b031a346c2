#include <base/median.h>
#include <base/text.h>
#include <explain/bodies.h>
#include <explain/query_sentence.h>
#include <import/skeleton/motion.h>
#include <render/drawlist/pen.h>
#include <render/layout/annotations.h>
#include <render/parts/paths.h>
#include <render/pictures/standing_agents.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

namespace {

constexpr float kPlainBelow = 24;     // pixels of height at scale 1: nothing inside a smaller cylinder can be made out
constexpr float kBone = 0.04f;        // metres across
constexpr float kHead = 0.09f;        // metres, radius
constexpr float kGlassFront = 0.02f;  // opacity of the wall where it is seen face on
constexpr float kGlassSide = 0.13f;   // ... and how much more where it is seen edge on
constexpr float kWaitingRing = 0.5f;  // of the radius: marks who waits
constexpr std::size_t kFewFigures = 50;  // are all drawn, seen or not

/// For the lines of one body; bodies are drawn from the farthest to the nearest.
Pen pen_of(DrawList& list, int rank) { return {list, {DrawLayer::subject, 0, static_cast<std::int64_t>(rank) << 24}}; }

/// A circle on the floor or level with it.
void add_level_ring(Pen& pen, glm::vec3 center, float radius, int pieces, LineStyle style) {
    style.cap = 0.3f * style.width;
    pen.ring(center, radius, {1, 0, 0}, {0, 1, 0}, pieces, style);
}

/// One body with what all its parts need.
struct Figure {
    const DrawnAgent& agent;
    const Body& body;
    glm::vec3 foot;  ///< on the floor, drawn space
    float radius = 0;
    float height = 0;
    float pixels = 0;  ///< of a metre there
    int pieces = 0;    ///< of its rings
    Rgba line;         ///< of the cylinder's outline
    Rgba foot_line;    ///< ... on the floor
};

float upright(const ViewProjection& projection) {
    return std::sqrt(std::max(0.0f, 1 - projection.back.z * projection.back.z));
}

/// Thick enough that lines on the floor stay below it.
float disk_height(const ViewProjection& projection) {
    return 0.012f + 6e-4f * (projection.far_depth - projection.near_depth);
}

Figure figure_of(const DrawList& list, const DrawnAgent& agent, const Body& body) {
    Figure f{agent, body, list.space.point(body.disk.x, body.disk.y, 0), 0, 0, 0, 0, Rgba(0), Rgba(0)};
    f.radius = static_cast<float>(body.disk.r);
    f.height = static_cast<float>(body.height);
    f.pixels = list.projection.pixels_per_metre(f.foot);
    f.pieces = 4 * std::clamp(static_cast<int>(f.radius * f.pixels / 5), 4, 20);
    f.line = outlining(agent.color, list.palette);
    f.foot_line = body.overlaps ? list.palette.hit : f.line;
    return f;
}

/// Whether most are too small for what is inside of a cylinder to be made out: all of a picture look alike.
bool are_plain(std::span<const Figure> figures, float scale) {
    std::vector<float> sizes;
    for (const Figure& f : figures) {
        if (f.pixels > 0) sizes.push_back(std::max(f.height, 2 * f.radius) * f.pixels);
    }
    if (sizes.empty()) return false;
    return median(std::move(sizes)) < kPlainBelow * scale;
}

/// Towards the eye along the floor; 0 from straight above.
glm::vec2 towards_eye(const ViewProjection& projection, glm::vec3 from) {
    const glm::vec2 way = projection.perspective ? glm::vec2(projection.eye - from) : glm::vec2(projection.back);
    const float length = glm::length(way);
    return length > 1e-4f && upright(projection) > 0.02f ? way / length : glm::vec2(0);
}

/// Whether some of it may be in the picture.
bool body_may_be_seen(const DrawList& list, const Figure& f) {
    const auto at = list.projection.project(f.foot);
    const float around = 2 * (f.height + 2 * f.radius) * f.pixels;
    return at && Rect{glm::vec2(0), glm::vec2(list.size.width, list.size.height)}.grown(around).contains({*at, *at});
}

void add_body_disk(DrawList& list, const Figure& f, float height, Rgba color) {
    DiskInstance disk;
    disk.base = f.foot;
    disk.radius = f.radius;
    disk.stand_upright(height);
    disk.color = color;
    disk.id = {f.agent.index, ObjectId::Kind::disk, f.body.sample};
    disk.order = {DrawLayer::subject, 0, f.agent.index};
    list.disks.edit().push_back(disk);
}

/// The wall: clear where it is looked through, denser towards its outline, as glass is.
void add_glass(DrawList& list, const Figure& f) {
    const glm::vec2 eye = towards_eye(list.projection, f.foot);
    const float half = std::sin(std::numbers::pi_v<float> / static_cast<float>(f.pieces)) * f.radius;
    const float apothem = std::sqrt(std::max(0.0f, f.radius * f.radius - half * half));
    for (int i = 0; i < f.pieces; ++i) {
        const glm::vec3 out(on_circle(static_cast<float>(i) + 0.5f, f.pieces), 0);
        const float edge_on = 1 - std::abs(glm::dot(glm::vec2(out), eye));
        const glm::vec3 up(0, 0, 0.5f * f.height);
        BoxInstance pane =
            annotation_sheet(f.foot + apothem * out + up, half * glm::vec3(-out.y, out.x, 0), up,
                             with_alpha(f.agent.color, kGlassFront + kGlassSide * edge_on * edge_on),
                             {DrawLayer::subject, 0, (static_cast<std::int64_t>(f.agent.index) << 8) + i});
        pane.id = {f.agent.index, ObjectId::Kind::disk, f.body.sample};
        pane.pickable = true;
        list.boxes.push_back(pane);
    }
}

/// The two lines along which the wall turns away from the eye.
void add_outline(const DrawList& list, Pen& pen, const Figure& f, float width) {
    const glm::vec2 eye = towards_eye(list.projection, f.foot);
    if (eye == glm::vec2(0)) return;
    // From an eye near by a little less than half of the wall is seen.
    const float distance = list.projection.perspective ? glm::length(glm::vec2(list.projection.eye - f.foot)) : 1e9f;
    const float cosine = f.radius / std::max(distance, f.radius);
    const float sine = std::sqrt(1 - cosine * cosine);
    const glm::vec2 side(-eye.y, eye.x);
    for (const float sign : {-1.0f, 1.0f}) {
        const glm::vec3 foot = f.foot + glm::vec3(f.radius * (cosine * eye + sign * sine * side), 0);
        pen.line(foot, foot + glm::vec3(0, 0, f.height), {f.line, width});
    }
}

bool is_head(const std::string& name) { return lower(name).find("head") != std::string::npos; }

float bone_width(const Figure& f, float scale) { return std::clamp(kBone * f.pixels, 1.1f * scale, 6 * scale); }

/// A circle that faces the viewer.
void add_facing_ring(const DrawList& list, Pen& pen, glm::vec3 middle, float radius, float pixels, Rgba color,
                     float width) {
    const int sides = std::clamp(static_cast<int>(radius * pixels), 10, 24);
    pen.ring(middle, radius, list.projection.right, list.projection.up, sides,
             {color, width, kSolid, 0.35f, 0.25f * width});
}

float capsule_width(float pixels, float scale) {
    return std::max(2 * static_cast<float>(kBoneRadius) * pixels, 1.1f * scale);
}

/// A capsule as it is seen from the side.
void add_capsule(const DrawList& list, Pen& pen, glm::vec3 from, glm::vec3 to, Rgba color, float pixels, float width) {
    const LineStyle style{color, width, kSolid, 0.35f};
    pen.line(from, to, style);
    if (width < 4) return;
    // Its round ends.
    for (const glm::vec3 end : {from, to})
        add_facing_ring(list, pen, end, 0.25f * width / pixels, pixels, color, 0.5f * width);
}

/// Each bone as a line in a dark or light rim, so that limbs that cross are told apart; the farthest first. With
/// `capsules` as wide as these.
void add_skeleton(const DrawList& list, Pen& pen, const Figure& f, double time, bool capsules, float scale) {
    const PlacedBody body(f.agent.clip(), *f.agent.skeleton);
    struct Bone {
        glm::vec3 from, to;
        float depth = 0;
    };
    std::vector<Bone> bones;
    const float shortest = 0.8f / std::max(f.pixels, 1e-3f);
    std::optional<glm::vec3> head;
    const std::vector<Segment> places = body.place(f.body.sample, time);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& [from, to] = places[i];
        const Bone bone{list.space.point(from.x, from.y, from.z), list.space.point(to.x, to.y, to.z), 0};
        const auto joint = static_cast<std::size_t>(body.bones()[i].to);
        if (!head && is_head(body.skeleton().joints[joint].name)) head = bone.to;
        if (capsules || glm::length(bone.to - bone.from) > shortest) bones.push_back(bone);
    }
    for (Bone& bone : bones) bone.depth = list.projection.depth(0.5f * (bone.from + bone.to));
    std::stable_sort(bones.begin(), bones.end(), [](const Bone& a, const Bone& b) { return a.depth > b.depth; });
    const float width = capsules ? capsule_width(f.pixels, scale) : bone_width(f, scale);
    const Rgba color = mix_colors(line_color_of(f.agent, list.palette), f.agent.color, 0.25f);
    const Rgba rim = with_alpha(list.palette.background, 0.8f);
    const float around = width > 2.2f * scale ? 2 * scale : 0;
    for (const Bone& bone : bones) {
        // Not at its ends, where it meets others.
        const glm::vec3 inset = 0.2f * (bone.to - bone.from);
        if (around > 0) pen.line(bone.from + inset, bone.to - inset, {rim, width + around});
        if (capsules) {
            add_capsule(list, pen, bone.from, bone.to, color, f.pixels, width);
        } else {
            pen.line(bone.from, bone.to, {color, width, kSolid, 0.35f, 0.3f * width});
        }
    }
    // It has no bone of its own.
    if (!head || capsules) return;
    add_facing_ring(list, pen, *head, kHead, f.pixels, color, 0.8f * width);
}

void add_figure(DrawList& list, const Figure& f, const Moment& moment, BodyParts parts, int rank, bool plain,
                float scale) {
    Pen pen = pen_of(list, rank);
    const float thin = 1.1f * scale;
    if (f.agent.outlined) {
        if (parts.disks) add_level_ring(pen, f.foot, f.radius, f.pieces, {f.line, thin, kSolid, 0.35f});
        return;
    }
    const float width = f.body.overlaps ? 2.6f * scale : 1.3f * scale;
    const glm::vec3 up(0, 0, 1);
    if (plain) {
        add_body_disk(list, f, parts.walls ? f.height : disk_height(list.projection), f.agent.color);
        const LineStyle style{f.foot_line, width, kSolid, 1};
        if (f.body.overlaps) add_level_ring(pen, f.foot + f.height * up, 1.04f * f.radius, f.pieces, style);
        if (f.body.waits)
            add_level_ring(pen, f.foot + f.height * up, kWaitingRing * f.radius, f.pieces, {f.line, thin});
        return;
    }
    const float floor = disk_height(list.projection);
    if (parts.disks) add_body_disk(list, f, floor, with_alpha(f.agent.color, list.palette.dark ? 0.55f : 0.6f));
    const LineStyle on_floor{f.foot_line, width, kSolid, 0.35f};
    if (parts.disks) add_level_ring(pen, f.foot + floor * up, f.radius, f.pieces, on_floor);
    if (parts.disks && f.body.waits) {
        add_level_ring(pen, f.foot + floor * up, kWaitingRing * f.radius, f.pieces, {f.line, thin, kSolid, 0.35f});
    }
    if (parts.walls) add_glass(list, f);
    if (f.agent.skeleton) add_skeleton(list, pen, f, moment.time, moment.bones.has_value(), scale);
    if (!parts.walls) return;
    add_outline(list, pen, f, thin);
    add_level_ring(pen, f.foot + f.height * up, f.radius, f.pieces, {f.line, 1.3f * scale});
}

/// Fills what two disks share, outlines it on the floor and at the top, and joins these where the walls cross.
void add_overlap(DrawList& list, const Figure& a, const Figure& b, bool plain, std::int64_t index, float scale) {
    constexpr int kRows = 25;
    const DiskOverlap shared = disk_overlap(a.body.disk, b.body.disk, kRows);
    const float top = std::min(a.height, b.height);
    const float floor = plain ? std::max(a.height, b.height) : disk_height(list.projection);
    const float lift = 0.004f;
    Pen pen = pen_of(list, 1 << 20);
    const auto at = [&](std::size_t side, int row, float height) {
        const glm::dvec2 p = shared.sides[side][static_cast<std::size_t>(row)];
        return list.space.point(p.x, p.y, 0) + glm::vec3(0, 0, height);
    };
    for (int row = 0; row + 1 < kRows; ++row) {
        const glm::vec3 corners[4] = {at(0, row, floor + lift), at(1, row, floor + lift), at(0, row + 1, floor + lift),
                                      at(1, row + 1, floor + lift)};
        list.boxes.push_back(annotation_sheet(0.25f * (corners[0] + corners[1] + corners[2] + corners[3]),
                                              0.25f * (corners[1] - corners[0] + corners[3] - corners[2]),
                                              0.25f * (corners[2] - corners[0] + corners[3] - corners[1]),
                                              with_alpha(list.palette.hit, 0.6f),
                                              {DrawLayer::subject, 1, (index << 8) + row}));
        for (const std::size_t side : {0u, 1u}) {
            pen.line(at(side, row, floor), at(side, row + 1, floor),
                     {list.palette.hit, 2 * scale, kSolid, 1, 0.5f * scale});
            if (!plain) pen.line(at(side, row, top), at(side, row + 1, top), {list.palette.hit, scale, kSolid, 1});
        }
    }
    if (plain || !shared.has_tips) return;
    for (const int row : {0, kRows - 1}) {
        pen.line(at(0, row, floor), at(0, row, top), {list.palette.hit, 1.6f * scale, kSolid, 1});
    }
}

/// A number beside a place; none where that is not seen.
std::vector<LabelRequest> number_label(const DrawList& list, glm::vec3 place, const std::string& text, Rgba color,
                                       float text_size) {
    const auto anchor = list.projection.project(place);
    if (!anchor) return {};
    LabelRequest label;
    label.text = text;
    label.role = TextRole::note;
    label.face = FontFace::mono;
    label.size = text_size;
    label.color = readable(color, list.palette);
    label.border = color;
    label.anchor = *anchor;
    label.directions = {{0.3f, 1}, {-0.3f, 1}, {1, 0.5f}, {-1, 0.5f}, {1, -0.5f}, {-1, -0.5f}};
    label.distance = 3 * text_size;
    label.pill = true;
    return {label};
}

std::vector<LabelRequest> length_label(const DrawList& list, glm::vec3 from, glm::vec3 to, double length, Rgba color,
                                       float text_size) {
    const auto ends = std::pair(list.projection.project(from), list.projection.project(to));
    // A way too short to be seen needs no number beside it.
    if (!ends.first || !ends.second || glm::length(*ends.second - *ends.first) < 1.5f * text_size) return {};
    return number_label(list, 0.5f * (from + to), with_unit(length, "m"), color, text_size);
}

}  // namespace

void add_bodies(DrawList& list, std::span<const DrawnAgent> agents, const Moment& moment, BodyParts parts,
                float scale) {
    std::vector<Figure> figures;
    for (const Body& body : moment.bodies) {
        figures.push_back(figure_of(list, agents[static_cast<std::size_t>(body.agent)], body));
    }
    std::vector<const Figure*> far_first;
    for (const Figure& f : figures) {
        // What stands behind the eye is not seen.
        if (f.agent.hidden) continue;
        if (f.pixels > 0 && (figures.size() <= kFewFigures || body_may_be_seen(list, f))) far_first.push_back(&f);
    }
    std::stable_sort(far_first.begin(), far_first.end(), [&](const Figure* a, const Figure* b) {
        return list.projection.depth(a->foot) > list.projection.depth(b->foot);
    });
    const bool plain = are_plain(figures, scale);
    int rank = 0;
    for (const Figure* f : far_first) add_figure(list, *f, moment, parts, rank++, plain, scale);
    if (!parts.disks) return;
    std::int64_t index = 0;
    for (const BodyPair& pair : moment.overlaps) {
        const Figure& a = figures[static_cast<std::size_t>(pair.a)];
        const Figure& b = figures[static_cast<std::size_t>(pair.b)];
        if (!a.agent.is_whole() || !b.agent.is_whole()) continue;
        add_overlap(list, a, b, plain, index++, scale);
    }
}

std::vector<LabelRequest> add_radius(DrawList& list, const DrawnAgent& agent, const Body& body,
                                     const Metrics& metrics) {
    const Figure f = figure_of(list, agent, body);
    if (!body.farthest || f.pixels <= 0 || are_plain(std::span(&f, 1), metrics.scale)) return {};
    const glm::dvec3 joint = joint_place(*agent.skeleton, agent.clip(), body.sample, body.farthest->joint);
    const float floor = disk_height(list.projection);
    const glm::vec3 middle = f.foot + glm::vec3(0, 0, floor);
    const glm::vec3 tip = list.space.point(joint.x, joint.y, joint.z);
    const glm::vec3 below(tip.x, tip.y, floor);
    Pen pen = pen_of(list, (1 << 20) + 1);
    const Rgba color = list.palette.text;
    const float width = 1.4f * metrics.scale;
    pen.line(middle, below, {color, width, kSolid, 0.35f});
    if (tip.z > below.z) pen.line(below, tip, {color, 0.8f * width, kSolid, 0.35f});
    const float around = std::max(3.5f * metrics.scale, bone_width(f, metrics.scale)) / f.pixels;
    add_facing_ring(list, pen, tip, around, f.pixels, color, width);
    const float dot = 1.8f * metrics.scale;
    pen.line(middle, middle, {color, 2 * dot, kSolid, 0.35f, dot});
    return length_label(list, middle, below, body.disk.r, list.palette.quiet_text, metrics.text);
}

std::vector<LabelRequest> add_clearance(DrawList& list, const Body& a, const Body& b, const Metrics& metrics) {
    const glm::dvec2 from(a.disk.x, a.disk.y);
    const glm::dvec2 way = glm::dvec2(b.disk.x, b.disk.y) - from;
    const double distance = glm::length(way);
    if (distance <= 0) return {};
    const glm::dvec2 near_a = from + way * (a.disk.r / distance);
    const glm::dvec2 near_b = from + way * (1 - b.disk.r / distance);
    const glm::vec3 up(0, 0, disk_height(list.projection));
    const glm::vec3 begin = list.space.point(near_a.x, near_a.y, 0) + up;
    const glm::vec3 end = list.space.point(near_b.x, near_b.y, 0) + up;
    pen_of(list, (1 << 20) + 2).line(begin, end, {list.palette.separated, 2 * metrics.scale, kSolid, 0.35f});
    return length_label(list, begin, end, distance - a.disk.r - b.disk.r, list.palette.separated, metrics.text);
}

std::vector<LabelRequest> add_nearest_bones(DrawList& list, std::span<const DrawnAgent> agents, const Moment& moment,
                                            const Metrics& metrics) {
    const NearestBones& bones = *moment.bones;
    const bool overlap = bones.distance < 0;
    const Rgba color = overlap ? list.palette.hit : list.palette.separated;
    Pen pen = pen_of(list, (1 << 20) + 3);
    const auto drawn = [&](const glm::dvec3& p) { return list.space.point(p.x, p.y, p.z); };
    const auto add_bone = [&](std::size_t side, SkeletonBone bone) {
        const DrawnAgent& agent = agents[side];
        const PlacedBody body(agent.clip(), *agent.skeleton);
        const auto index = std::ranges::find(body.bones(), bone) - body.bones().begin();
        const Segment place = body.place(moment.bodies[side].sample, moment.time)[static_cast<std::size_t>(index)];
        const float pixels = list.projection.pixels_per_metre(drawn(place.from));
        if (pixels <= 0) return;
        add_capsule(list, pen, drawn(place.from), drawn(place.to), color, pixels, capsule_width(pixels, metrics.scale));
    };
    add_bone(0, bones.a);
    add_bone(1, bones.b);
    const glm::vec3 from = drawn(bones.a_point), to = drawn(bones.b_point);
    const float dot = 2 * metrics.scale;
    for (const glm::vec3 end : {from, to}) pen.line(end, end, {list.palette.text, 2 * dot, kSolid, 1, dot});
    pen.line(from, to, {list.palette.text, 1.5f * metrics.scale, kSolid, 1});
    return number_label(list, 0.5f * (from + to), with_unit(std::abs(bones.distance), "m") + (overlap ? " deep" : ""),
                        color, metrics.text);
}

void add_body_names(DrawList& list, LabelLayout& layout, std::span<const DrawnAgent> agents, const Moment& moment,
                    const Metrics& metrics) {
    const auto agent_of = [&](const Body& body) -> const DrawnAgent& {
        return agents[static_cast<std::size_t>(body.agent)];
    };
    const auto shown = std::ranges::count_if(
        moment.bodies, [&](const Body& body) { return is_first_of(moment, body) && !agent_of(body).hidden; });
    const bool all = agents.size() > 1 && names_fit(static_cast<std::size_t>(shown)) &&
                     std::ranges::none_of(agents, &DrawnAgent::outlined);
    for (const Body& body : moment.bodies) {
        const DrawnAgent& agent = agent_of(body);
        if (agent.hidden || !(all || agent.named) || !is_first_of(moment, body)) continue;
        const glm::vec3 top = list.space.point(body.disk.x, body.disk.y, body.height);
        if (const auto label = name_label(list, agent, top, body.disk.r, metrics.text)) layout.place(*label, list);
    }
}

}  // namespace mobbscope
