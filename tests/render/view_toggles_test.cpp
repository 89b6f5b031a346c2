// Each toggle of a view changes what its row says that it draws: there, then, and of nobody who is hidden.
#include "crowd/walker_moves.h"
#include "render/scenes.h"

#include <render/pictures/build_draw_list.h>
#include <scene/view_options.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

/// An element of the world by the points that it is drawn from, drawn space.
using Points = std::vector<glm::vec3>;

bool comes_before(const Points& a, const Points& b) {
    return std::ranges::lexicographical_compare(
        a, b, [](glm::vec3 p, glm::vec3 q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); });
}

std::vector<Points> elements_of(const DrawList& list) {
    std::vector<Points> out;
    for (const DiskInstance& disk : list.disks) out.push_back({disk.base, disk.top});
    for (const BoxInstance& box : list.boxes) {
        const auto corners = box_corners(box);
        out.emplace_back(corners.begin(), corners.end());
    }
    for (const LineInstance& line : list.lines) out.push_back({line.from, line.to});
    for (const HighlightLine& line : list.highlights) out.push_back({line.from, line.to});
    std::ranges::sort(out, comes_before);
    return out;
}

/// What one list has and another has not.
std::vector<Points> beyond(const DrawList& list, const DrawList& other) {
    const std::vector<Points> a = elements_of(list), b = elements_of(other);
    std::vector<Points> out;
    std::ranges::set_difference(a, b, std::back_inserter(out), comes_before);
    return out;
}

/// All that stands over the world: words, and what they stand on.
std::string overlay_of(const DrawList& list) {
    std::string out = list.headline + '\n';
    for (const LegendEntry& entry : list.legend) out += entry.text + '\n';
    const auto add = [&out](const Rect& r) {
        for (const float x : {r.min.x, r.min.y, r.max.x, r.max.y}) out += std::to_string(x) + ' ';
    };
    for (const Overlay& overlay : list.overlays) add(overlay.rect);
    for (const OverlayPanel& panel : list.panels) add(panel.rect);
    for (const OverlayLine& line : list.overlay_lines) add({line.from, line.to});
    for (const OverlayPanel& mark : list.marks) add(mark.rect);
    for (const TextRun& text : list.texts) add(text.box), out += text.text + '\n';
    return out;
}

/// A picture with a toggle, and without it.
struct Toggled {
    DrawList with, without;
    std::vector<Points> added = beyond(with, without), removed = beyond(without, with);

    bool changes_words() const { return overlay_of(with) != overlay_of(without); }
    bool changes_colors() const {
        return !std::ranges::equal(with.disks, without.disks, {}, &DiskInstance::color, &DiskInstance::color);
    }
};

Toggled toggled(const FittedScene& fitted, ViewState view, const ViewOption& option) {
    constexpr PictureSize kSize{1280, 720};
    view.*option.toggle = true;
    DrawList with = build_draw_list(fitted, view, kSize);
    view.camera = with.camera;
    view.*option.toggle = false;
    return {std::move(with), build_draw_list(fitted, view, kSize)};
}

constexpr double kFarAway = 57.5;  // metres between the two; no line of the floor is there

/// Two who walk 10 m along x, one after the other, far from each other.
FittedScene two_walks() {
    mobb::FitOptions options;
    options.leaf = 4;
    return {testing::scene_of({{}, {.translate = {0, kFarAway}, .start = 3}}, 300), options};
}

/// Views of these two in which a toggle may show something.
std::vector<ViewState> views() {
    ViewState levels, slab, query, moment, proven, line, part;
    levels.levels = {0, 0, true};
    levels.time = 4;
    slab = levels;
    slab.slab = ValueRange{3.52, 4.51};
    query.query = 0;
    query.step = parse_step("40%");
    moment.show = Show::moment;
    moment.time = 4;
    proven.query = 0;
    proven.past = Past::all;  // else the walls stand in place of the boxes
    line.query = 0;
    line.show = Show::moment;
    line.time = 4;
    part.levels = {0, 0, true};
    part.subtree = DrawnNode{1, 7};  // a leaf
    return {levels, slab, query, moment, proven, line, part};
}

std::string described(const ViewOption& option, const ViewState& view) {
    return std::string(option.key) +
           (view.query  ? " of a query"
            : view.time ? " at a time"
                        : "") +
           (view.show == Show::moment ? ", a moment" : "");
}

/// Whether a drawn point lies where an agent's disks or small boxes are at its time.
bool is_where_somebody_is(const FittedScene& fitted, const DrawList& list, glm::vec3 point) {
    const glm::dvec3 at = list.space.place(point);
    return std::ranges::any_of(fitted.placed_agents(), [&](const PlacedAgent& who) {
        const mobb::PlacedClip clip = fitted.placed(who).placed_clip();
        const double time = list.moment.value_or(at.z), dt = clip.clip().dt();
        if (time < clip.time(0) - 1e-3 || time > clip.time(clip.count()) + 1e-3) return false;
        const int sample = std::clamp(static_cast<int>((time - clip.time(0)) / dt), 0, clip.count() - 1);
        const mobb::Disk disk = clip.disk(sample);
        return glm::length(glm::dvec2(at) - glm::dvec2(disk.x, disk.y)) < 1.5 * (disk.r + 0.2);
    });
}

TEST(ViewToggles, ChangeThatPartOfThePictureAlone) {
    const FittedScene walks = two_walks(), run(testing::with_run(testing::walker_scene(), 20, {13, 13}), {});
    std::vector<std::pair<const FittedScene*, ViewState>> pictures;
    for (const ViewState& view : views()) pictures.emplace_back(&walks, view);
    ViewState followed;
    followed.show = Show::moment;
    followed.time = 6;
    followed.follow = run.scene().crowd->agents.front().name;
    pictures.emplace_back(&run, followed);
    for (const ViewOption& option : view_options()) {
        // What is framed says where the camera stands, and adds nothing.
        if (!option.toggle || option.toggle == &ViewState::frame_boxes) continue;
        bool shows = false;
        for (const auto& [fitted, view] : pictures) {
            const Toggled picture = toggled(*fitted, view, option);
            SCOPED_TRACE(described(option, view));
            EXPECT_TRUE(picture.removed.empty());
            if (option.draws == DrawnPart::colors) {
                EXPECT_TRUE(picture.added.empty());
                EXPECT_EQ(picture.changes_words(), picture.changes_colors());
                shows = shows || picture.changes_colors();
            } else if (option.draws == DrawnPart::words) {
                EXPECT_TRUE(picture.added.empty());
                shows = shows || picture.changes_words();
            } else {
                shows = shows || !picture.added.empty();
            }
        }
        EXPECT_TRUE(shows) << option.key << ": no picture shows it";
    }
}

TEST(ViewToggles, OfAgentsShowThemWhereTheyAreWhenTheyAreThere) {
    const FittedScene fitted = two_walks();
    for (const ViewOption& option : view_options()) {
        if (!option.toggle || option.draws != DrawnPart::agents) continue;
        for (const ViewState& view : views()) {
            if (view.query) continue;  // boxes under test are large
            const Toggled picture = toggled(fitted, view, option);
            for (const Points& element : picture.added)
                for (const glm::vec3 point : element)
                    EXPECT_TRUE(is_where_somebody_is(fitted, picture.with, point))
                        << described(option, view) << ": " << point.x << ' ' << point.y << ' ' << point.z;
        }
    }
}

TEST(ViewToggles, LeaveHiddenAgentsOut) {
    const FittedScene fitted = two_walks();
    for (const ViewOption& option : view_options()) {
        if (!option.toggle || option.draws == DrawnPart::words || option.draws == DrawnPart::colors) continue;
        for (ViewState view : views()) {
            SCOPED_TRACE(described(option, view));
            if (view.query) continue;  // its sides are drawn
            const auto elements_at_b = [&] {
                const Toggled picture = toggled(fitted, view, option);
                return std::ranges::count_if(picture.added, [&](const Points& element) {
                    return std::ranges::all_of(element, [&](glm::vec3 point) {
                        return std::abs(picture.with.space.place(point).y - kFarAway) < 1;
                    });
                });
            };
            if (option.draws == DrawnPart::agents) {
                EXPECT_GT(elements_at_b(), 0) << "B is drawn where it is not hidden";
            }
            view.hidden = {"B"};
            EXPECT_EQ(elements_at_b(), 0);
        }
    }
}

}  // namespace
}  // namespace mobbscope
