/// Everything that a picture shows, as plain numbers: what the view is turned into, and all that the renderer is told.
#pragma once

#include <render/drawlist/font.h>
#include <render/drawlist/palette.h>
#include <render/drawlist/shared_values.h>
#include <render/drawlist/view_projection.h>
#include <render/image/image.h>
#include <render/image/rect.h>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Something that can be pointed at. It is stored as two 32-bit numbers: 1 + the agent's index; then the sample's
/// or the node's index, with the highest bit set for a node. (0, 0) is nothing.
struct ObjectId {
    enum class Kind { disk, box };

    int agent = 0;  ///< index into DrawList::agents
    Kind kind = Kind::disk;
    int index = 0;  ///< sample of the clip, or node of the tree; below 2^31

    std::uint32_t r() const { return static_cast<std::uint32_t>(agent) + 1; }
    std::uint32_t g() const { return static_cast<std::uint32_t>(index) | (kind == Kind::box ? kBoxBit : 0u); }
    static std::optional<ObjectId> decode(std::uint32_t r, std::uint32_t g) {
        if (r == 0) return std::nullopt;
        return ObjectId{static_cast<int>(r - 1), (g & kBoxBit) ? Kind::box : Kind::disk,
                        static_cast<int>(g & ~kBoxBit)};
    }

    friend bool operator==(const ObjectId&, const ObjectId&) = default;

  private:
    static constexpr std::uint32_t kBoxBit = 0x80000000u;
};

/// Object ids, two numbers a pixel, rows from top to bottom.
struct IdImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint32_t> rg;

    /// What is at pixel (x, y), which must lie in the image.
    std::optional<ObjectId> at(int x, int y) const {
        const std::size_t i =
            2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        return ObjectId::decode(rg[i], rg[i + 1]);
    }
};

/// Maps (x, y, t), metres and global seconds, to drawn metres near the origin. The subtraction happens in double, so
/// that scenes at 10 km and 10^5 s keep their detail in float.
struct DrawnSpace {
    glm::dvec3 origin{0};    ///< x, y in metres, t in seconds
    double time_height = 1;  ///< metres drawn per second, > 0
    glm::dvec3 anchor{0};    ///< x, y, t that the targets of cameras are counted from
    friend bool operator==(const DrawnSpace&, const DrawnSpace&) = default;

    glm::vec3 point(double x, double y, double t) const {
        return glm::vec3(glm::dvec3(x - origin.x, y - origin.y, (t - origin.z) * time_height));
    }
    /// The (x, y, t) that is drawn at a point.
    glm::dvec3 place(glm::dvec3 point) const {
        return {point.x + origin.x, point.y + origin.y, point.z / time_height + origin.z};
    }
    /// Where a camera's target is drawn, and the target that is drawn at a point.
    glm::vec3 from_target(glm::dvec3 target) const {
        return point(target.x + anchor.x, target.y + anchor.y, target.z / time_height + anchor.z);
    }
    glm::dvec3 to_target(glm::dvec3 point) const {
        const glm::dvec3 p = place(point) - anchor;
        return {p.x, p.y, p.z * time_height};
    }
    /// A direction or extent of a box, which is in (x, y, w*t) with w in m/s. A tilted box is sheared by this, as time
    /// is drawn time_height metres a second and not w.
    glm::vec3 extent(glm::dvec3 v, double time_scale) const {
        return glm::vec3(glm::dvec3(v.x, v.y, v.z / time_scale * time_height));
    }
};

/// A line pattern in pixels: on, off, on, off. All zero: solid.
using Dash = glm::vec4;
inline constexpr Dash kSolid{0, 0, 0, 0};

/// What lies above what, from the lowest layer on. JSON has the numbers.
enum class DrawLayer {
    surroundings = 0,  ///< disks, floor, time axis, walls
    nodes = 1,         ///< boxes of levels, and of pairs tested before
    subject = 2,       ///< the pair under test; of a moment the people
    candidates = 6,
    time_cursor = 8,
    findings = 9,  ///< gaps between boxes, and how far a disk reaches
    rings = 10,    ///< around disks that matter
};

/// Where an instance stands among its like: what is drawn first where two are equally deep. Made from level and index,
/// so the picture does not depend on the order of the lists.
struct DrawOrder {
    DrawLayer layer = DrawLayer::surroundings;
    int level = 0;  ///< of the node; the sample's is 0
    std::int64_t index = 0;
    friend auto operator<=>(const DrawOrder&, const DrawOrder&) = default;
};

/// One sample over its time: of a held clip a short upright cylinder; of a linear one a frustum that leans to the next
/// sample, whose lower face is its upper one.
struct DiskInstance {
    glm::vec3 base{0};     ///< centre of the lower face, drawn space
    float radius = 0;      ///< of the lower face
    glm::vec3 top{0};      ///< centre of the upper face, straight above the base or not
    float top_radius = 0;  ///< of the upper face
    Rgba color{1};  ///< opacity below 1 steps back towards the background; the disk still hides what is behind it
    ObjectId id;
    DrawOrder order;

    float height() const { return top.z - base.z; }
    /// How far a point of the side goes over the floor from below to above, metres at most; 0 of an upright cylinder.
    float lean() const { return glm::length(glm::vec2(top) - glm::vec2(base)) + std::abs(top_radius - radius); }
    void stand_upright(float height) {
        top = base + glm::vec3(0, 0, height);
        top_radius = radius;
    }
};

/// What a box stands for: each state has its own colour and line.
enum class BoxState { level, under_test, apart_in_time, separated, overlap, avoidable, hit, annotation };

/// A box as it is drawn: a parallelepiped.
struct BoxInstance {
    glm::vec3 center{0};                 ///< drawn space
    std::array<glm::vec3, 3> extents{};  ///< half edges
    BoxState state = BoxState::level;
    Rgba fill{0};     ///< of the faces; opacity 0: edges only
    Rgba edge{1};     ///< opacity 0: faces only
    float width = 1;  ///< of the edges, pixels
    Dash dash = kSolid;
    ObjectId id;
    bool pickable = true;   ///< stands for what `id` names: a node, or as a cylinder's wall a sample
    bool triangle = false;  ///< of a sheet the half around its corner 0 (box_corners) alone: a part of a polygon
    DrawOrder order;
};

/// A sheet between boxes and paths, without edges, that nobody can point at. `u`, `v`: half edges.
inline BoxInstance annotation_sheet(glm::vec3 center, glm::vec3 u, glm::vec3 v, Rgba fill, DrawOrder order) {
    BoxInstance out;
    out.center = center;
    out.extents = {u, v, glm::vec3(0)};
    out.state = BoxState::annotation;
    out.fill = fill;
    out.edge = Rgba(0);
    out.pickable = false;
    out.order = order;
    return out;
}

/// How a line in the scene looks.
struct LineStyle {
    Rgba color{1};
    float width = 1;  ///< pixels
    Dash dash = kSolid;
    float hidden = 0;  ///< opacity kept behind disks, 0..1
    float cap = 0;     ///< pixels drawn beyond both ends
};

/// A straight line with a constant width on the screen.
struct LineInstance : LineStyle {
    glm::vec3 from{0};
    glm::vec3 to{0};
    DrawOrder order;
};

/// An agent's path, or a node or sample of it: what can be pointed out.
struct AgentPart {
    enum class Kind { path, node, sample };
    Kind kind = Kind::path;
    int index = -1;  ///< node or sample
    friend bool operator==(const AgentPart&, const AgentPart&) = default;
};

/// A line of what is pointed out: over the world and seen through all of it, below the words.
struct HighlightLine {
    enum class Role {
        selection,  ///< what is selected
        hover,      ///< what is under the mouse
        candidate,  ///< the move that is looked at, of those that the followed agent could choose
        conflict,   ///< whom the followed agent is about to meet
        ghost,      ///< where the agent stood that is being dragged
        measure,    ///< between two places
        ancestor,   ///< the boxes above a node
    };
    Role role = Role::selection;
    glm::vec3 from{0};
    glm::vec3 to{0};
    Rgba color{1};
    float width = 1;  ///< pixels
    Dash dash = kSolid;
    friend bool operator==(const HighlightLine&, const HighlightLine&) = default;
};
inline constexpr std::array<std::string_view, 7> kHighlightRoles{"selection", "hover",   "candidate", "conflict",
                                                                 "ghost",     "measure", "ancestor"};
inline std::string_view name(HighlightLine::Role role) { return kHighlightRoles[static_cast<std::size_t>(role)]; }

/// A filled rectangle with round corners over the picture; a radius of half its side makes a disk.
struct OverlayPanel {
    Rect rect;
    float radius = 0;
    Rgba fill{0};
    Rgba border{0};
    float border_width = 0;
};

/// A line over the picture, in pixels.
struct OverlayLine {
    glm::vec2 from{0};
    glm::vec2 to{0};
    Rgba color{1};
    float width = 1;
    Dash dash = kSolid;
};

/// What a line of text is in the picture.
enum class TextRole {
    label,    ///< of a part of a diagram
    tick,     ///< a number at the time axis or along the floor
    name,     ///< of a participant, or of a hub
    note,     ///< a measure beside what is measured
    caption,  ///< headline, or what stands below it
    legend,   ///< a row
    header,   ///< of a folded panel
    map,      ///< title of the map of the floor
};
inline constexpr std::array<std::string_view, 8> kTextRoles{"label",   "tick",   "name",   "note",
                                                            "caption", "legend", "header", "map"};
inline std::string_view name(TextRole role) { return kTextRoles[static_cast<std::size_t>(role)]; }

/// One line of text over the picture.
struct TextRun {
    std::string text;  ///< UTF-8
    TextRole role = TextRole::label;
    FontFace face = FontFace::text;
    float size = 12;        ///< pixels
    glm::vec2 baseline{0};  ///< left end, pixels from the upper left corner
    Rgba color{1};
    Rect box;  ///< what it covers
};

/// A line of the legend: what a colour and line style stand for.
struct LegendEntry {
    enum class Mark { disk, ring, double_ring, box, line, remark };
    Mark mark = Mark::line;
    Rgba color{1};
    Rgba fill{0};
    float width = 1.5f;
    Dash dash = kSolid;
    std::string text;
};

/// The caption, the legend or the map of the floor: a panel in a corner of its own, which may be folded to its header.
struct Overlay {
    enum class Kind { caption, legend, inset };
    Kind kind = Kind::caption;
    Rect rect;                 ///< what it covers
    std::optional<Rect> fold;  ///< with controls: where a click folds or unfolds it
    bool folded = false;       ///< its header alone is there
    bool no_room = false;      ///< ... as the picture is too small for the rest; the header says so
    std::string whole{};       ///< all that it says where words of it are left out; empty: none are
    /// With controls, of a legend with more rows than it shows by itself: where a click shows all, or few.
    std::optional<Rect> more;
};

/// From where a scene is seen: all that moving the camera needs to know.
struct PictureFrame {
    PictureSize size;
    DrawnSpace space;
    ViewProjection projection;
    Camera camera;                 ///< explicit (see framed_camera): the view's, or the one that frames the scene
    std::optional<double> moment;  ///< global seconds: heights are metres and no times, for the floor then
};

/// What is seen of the world: all between two heights of the drawn space, which are times. Disks and sheets that stand
/// upright are cut there.
struct DrawnSlab {
    float low = 0, high = 0;
    bool cuts_boxes = false;  ///< else those that reach into it are whole

    /// Whether what reaches from one height to another is seen. Of an empty slab what holds then: it ends later.
    bool shows(float from, float to) const { return to > low && (from < high || from <= low); }
    friend bool operator==(const DrawnSlab&, const DrawnSlab&) = default;
};

/// What changes with the scene, its fits, the step and the time alone; another camera changes no more than the width of
/// edges. It stays in the renderer's buffers.
struct DrawnWorld {
    std::optional<DrawnSlab> slab;  ///< none: all is seen. It is in no buffer
    SharedValues<DiskInstance> disks;
    std::vector<BoxInstance> boxes;
};

/// What is made for one camera and size.
struct DrawnOverlay {
    std::vector<LineInstance> lines;        ///< within the world
    std::vector<HighlightLine> highlights;  ///< over these, in this order

    std::string headline;                    ///< the sentence at the top
    std::vector<LegendEntry> legend;         ///< all of it, whatever part of it is shown
    std::vector<Overlay> overlays;           ///< none over another
    std::vector<OverlayPanel> panels;        ///< over the scene, in this order
    std::vector<OverlayLine> overlay_lines;  ///< over the panels
    std::vector<OverlayPanel> marks;         ///< over the lines
    std::vector<TextRun> texts;              ///< over all
};

/// Tells what was made from all else that was: copies have the same.
class Revision {
  public:
    friend bool operator==(const Revision&, const Revision&) = default;

  private:
    static std::uint64_t next() {
        static std::atomic<std::uint64_t> last = 0;
        return ++last;
    }
    std::uint64_t number_ = next();
};

struct DrawList : PictureFrame, DrawnWorld, DrawnOverlay {
    Palette palette;
    /// Behind everything; none: the palette's, which is what steps back does so towards. With opacity below 1 the
    /// picture is seen through where nothing is drawn.
    std::optional<Rgba> background;
    std::vector<std::string> agents;  ///< names of what ObjectId::agent counts
    /// Who changes a list that was painted, other than its highlights, gives it a new one.
    Revision revision;
};

/// By the sign along each axis: bit i of the index is set where it is positive along extent i.
inline std::array<glm::vec3, 8> box_corners(const BoxInstance& box) {
    std::array<glm::vec3, 8> out;
    for (unsigned bits = 0; bits < 8; ++bits) {
        out[bits] = box.center;
        for (unsigned axis = 0; axis < 3; ++axis) out[bits] += box.extents[axis] * ((bits >> axis) & 1u ? 1.0f : -1.0f);
    }
    return out;
}

/// The pairs of corners that an edge joins.
inline constexpr std::array<std::array<unsigned, 2>, 12> kBoxEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

}  // namespace mobbscope
