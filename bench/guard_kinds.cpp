#include "guard_kinds.h"

#include <base/text.h>
#include <render/drawlist/view_projection.h>
#include <scene/scene_edits.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace mobbscope::picture_tests {
namespace {

/// The index of one of those for which it holds.
template <class Items, class Holds>
std::optional<std::size_t> pick_if(const Items& items, Uniform& random, const Holds& holds) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (holds(items[i])) found.push_back(i);
    }
    if (found.empty()) return std::nullopt;
    return found[pick(found, random)];
}

template <class T>
void take_out(std::vector<T>& from, std::size_t index) {
    from.erase(from.begin() + static_cast<std::ptrdiff_t>(index));
}

/// Up or down by one of these shares.
float factor(Uniform& random, double least, double most) {
    const double share = random.within(least, most);
    return static_cast<float>(random.below(2) == 0 ? 1 + share : 1 - share);
}

/// Changes the scene of all panels.
template <class Change>
void change_scenes(Shot& shot, const Change& change) {
    for (PicturePanel& panel : shot.panels) {
        Scene scene = panel.fitted->scene();
        add_agents_for_clips(scene);
        change(scene);
        panel.fitted = std::make_shared<const FittedScene>(std::move(scene), panel.fitted->options());
    }
}

/// One of the agents that the first panel draws, as an index into the scene's. A run has none that can be moved.
std::optional<int> drawn_agent(const Drawn& before, Uniform& random) {
    const PicturePanel& panel = before.shot.panels.front();
    if (panel.fitted->scene().crowd) return std::nullopt;
    const std::vector<DrawnAgent> drawn = drawn_agents(*panel.fitted, panel.view);
    const auto found = pick_if(drawn, random, [](const DrawnAgent& one) { return !one.hidden; });
    if (!found) return std::nullopt;
    if (!panel.view.query) return drawn[*found].index;
    const SceneQuery query = panel.fitted->queries()[static_cast<std::size_t>(*panel.view.query)];
    const int agent = (*found == 0 ? query.a : query.b).agent;
    return agent < 0 ? std::nullopt : std::optional(agent);
}

template <int tenths_of_millimetre>
bool move_agent(Shot& shot, const Drawn& before, Uniform& random, std::string& what) {
    const std::optional<int> agent = drawn_agent(before, random);
    if (!agent) return false;
    const double angle = random.within(0, 2 * std::numbers::pi);
    change_scenes(shot, [&](Scene& scene) {
        mobb::Placement placement = scene.agents[static_cast<std::size_t>(*agent)].placement;
        placement.translate += 1e-4 * tenths_of_millimetre * glm::dvec2(std::cos(angle), std::sin(angle));
        place_agent(scene, *agent, placement);
    });
    what = formatted("agent %d towards %.0f degrees", *agent, angle / kDegree);
    return true;
}

bool recolor_agent(Shot& shot, const Drawn& before, Uniform& random, std::string& what) {
    const std::optional<int> agent = drawn_agent(before, random);
    if (!agent) return false;
    const int channel = random.below(3);
    const int by = 8 + random.below(17);
    change_scenes(shot, [&](Scene& scene) {
        const PlacedAgent placed = placed_agents(scene)[static_cast<std::size_t>(*agent)];
        const Rgba color = agent_color(scene, placed, *agent);
        std::uint8_t levels[3];
        for (int c = 0; c < 3; ++c) levels[c] = static_cast<std::uint8_t>(std::lround(255 * color[c]));
        levels[channel] = static_cast<std::uint8_t>(levels[channel] + (levels[channel] < 128 ? by : -by));
        scene.agents[static_cast<std::size_t>(*agent)].color = Color{levels[0], levels[1], levels[2]};
    });
    what = formatted("agent %d, channel %d by %d", *agent, channel, by);
    return true;
}

bool rename_one_agent(Shot& shot, const Drawn& before, Uniform& random, std::string& what) {
    const std::optional<int> agent = drawn_agent(before, random);
    if (!agent) return false;
    std::string name;
    std::string old;
    change_scenes(shot, [&](Scene& scene) {
        old = scene.agents[static_cast<std::size_t>(*agent)].name;
        name = UnusedNames(scene.agents).take(old.substr(0, old.size() - 1) + "X");
        rename_agent(scene, *agent, name);
    });
    for (PicturePanel& panel : shot.panels) rename_in_view(panel.view, old, name);
    if (shot.select && shot.select->agent == old) shot.select->agent = name;
    what = old + " to " + name;
    return true;
}

/// Where the scene is seen from in each panel, as the camera that frames it found it.
void hold_cameras(Shot& shot, const std::vector<DrawList>& lists) {
    for (std::size_t i = 0; i < lists.size(); ++i) {
        shot.panels[i].view.camera = lists[i].camera;
        shot.panels[i].view.time_height = lists[i].space.time_height;
    }
}

bool turn_camera(Shot& shot, const Drawn& before, Uniform& random, std::string& what) {
    hold_cameras(shot, before.lists);
    const bool pitch = random.below(2) == 0;
    for (PicturePanel& panel : shot.panels) {
        double& angle = pitch ? panel.view.camera.pitch_deg : panel.view.camera.yaw_deg;
        angle += pitch && angle > 0 ? -0.1 : 0.1;
    }
    what = pitch ? "pitch" : "yaw";
    return true;
}

bool hide_time_axis(Shot& shot, const Drawn&, Uniform&, std::string&) {
    const bool shown = shot.panels.front().view.time_axis;
    for (PicturePanel& panel : shot.panels) panel.view.time_axis = false;
    return shown;
}

bool stretch_time(Shot& shot, const Drawn& before, Uniform& random, std::string& what) {
    const float by = factor(random, 0.01, 0.01);
    for (std::size_t i = 0; i < before.lists.size(); ++i) {
        shot.panels[i].view.time_height = before.lists[i].space.time_height * by;
    }
    what = formatted("by %g", double{by});
    return true;
}

bool shift_level(Shot& shot, const Drawn& before, Uniform& random, std::string& what) {
    const ViewState& view = shot.panels.front().view;
    if (view.query || view.projection || view.levels.leaves || !view.boxes || before.lists.front().boxes.empty()) {
        return false;
    }
    const int by = view.levels.first == 0 || random.below(2) == 0 ? 1 : -1;
    for (PicturePanel& panel : shot.panels) {
        panel.view.levels.first += by;
        panel.view.levels.last += by;
    }
    what = formatted("by %+d", by);
    return true;
}

bool is_tick_label(const TextRun& text) { return text.role == TextRole::tick; }

bool remove_box(DrawList& list, Uniform& random, std::string& what) {
    const auto found = pick_if(list.boxes, random, [](const BoxInstance& box) { return box.pickable; });
    if (!found) return false;
    what = formatted("node %d of agent %d", list.boxes[*found].id.index, list.boxes[*found].id.agent);
    take_out(list.boxes, *found);
    return true;
}

bool remove_disk(DrawList& list, Uniform& random, std::string& what) {
    if (list.disks.empty()) return false;
    const std::size_t found = pick(list.disks, random);
    what = formatted("sample %d of agent %d", list.disks[found].id.index, list.disks[found].id.agent);
    take_out(list.disks.edit(), found);
    return true;
}

template <class Holds>
bool remove_text(DrawList& list, Uniform& random, std::string& what, const Holds& holds) {
    const auto found = pick_if(list.texts, random, holds);
    if (!found) return false;
    what = list.texts[*found].text;
    take_out(list.texts, *found);
    return true;
}

bool remove_label(DrawList& list, Uniform& random, std::string& what) {
    return remove_text(list, random, what, [](const TextRun&) { return true; });
}

bool remove_tick_label(DrawList& list, Uniform& random, std::string& what) {
    return remove_text(list, random, what, is_tick_label);
}

bool remove_every_second_tick(DrawList& list, Uniform&, std::string& what) {
    int count = 0;
    const std::size_t removed =
        std::erase_if(list.texts, [&](const TextRun& text) { return is_tick_label(text) && ++count % 2 == 0; });
    what = formatted("%d of %d", static_cast<int>(removed), count);
    return removed > 0;
}

bool change_tick_digit(DrawList& list, Uniform& random, std::string& what) {
    const auto found = pick_if(list.texts, random, is_tick_label);
    if (!found) return false;
    std::string& text = list.texts[*found].text;
    what = text;
    const std::size_t at = text.find_last_of("0123456789");
    text[at] = static_cast<char>('0' + (text[at] - '0' + 1 + random.below(9)) % 10);
    what += " to " + text;
    return true;
}

bool remove_legend_row(DrawList& list, Uniform& random, std::string& what) {
    const auto legend = std::ranges::find(list.overlays, Overlay::Kind::legend, &Overlay::kind);
    if (legend == list.overlays.end() || legend->folded) return false;
    const auto row = pick_if(list.texts, random, [&](const TextRun& text) {
        return legend->rect.contains(text.box) &&
               std::ranges::find(list.legend, text.text, &LegendEntry::text) != list.legend.end();
    });
    if (!row) return false;
    const TextRun& text = list.texts[*row];
    what = text.text;
    // The mark stands before the words, in the row; the legend's own panel is larger.
    const Rect mark{{legend->rect.min.x, text.box.min.y - 1}, {text.box.min.x, text.box.max.y + 1}};
    std::erase_if(list.panels, [&](const OverlayPanel& panel) { return mark.contains(panel.rect); });
    std::erase_if(list.overlay_lines, [&](const OverlayLine& line) { return mark.contains({line.from, line.to}); });
    std::erase_if(list.legend, [&](const LegendEntry& entry) { return entry.text == what; });
    take_out(list.texts, *row);
    return true;
}

bool shift_label(DrawList& list, Uniform& random, std::string& what) {
    if (list.texts.empty()) return false;
    constexpr std::pair<const char*, glm::vec2> kWays[] = {
        {"left", {-1, 0}}, {"right", {1, 0}}, {"top", {0, -1}}, {"bottom", {0, 1}}};
    TextRun& text = list.texts[pick(list.texts, random)];
    const auto& [way, by] = kWays[random.below(4)];
    text.baseline += by;
    text.box = {text.box.min + by, text.box.max + by};
    what = text.text + " to the " + way;
    return true;
}

bool widen_line(DrawList& list, Uniform& random, std::string& what) {
    const std::size_t count = list.lines.size() + list.boxes.size();
    if (count == 0) return false;
    const float by = factor(random, 0.1, 0.3);
    const auto found = static_cast<std::size_t>(random.below(static_cast<int>(count)));
    const bool is_line = found < list.lines.size();
    float& width = is_line ? list.lines[found].width : list.boxes[found - list.lines.size()].width;
    what = formatted("%s of %.3g pixels by %.2f", is_line ? "a line" : "a box's edges", double{width}, double{by});
    width *= by;
    return true;
}

bool widen_all_lines(DrawList& list, Uniform& random, std::string& what) {
    const float by = factor(random, 0.1, 0.3);
    for (LineInstance& line : list.lines) line.width *= by;
    for (BoxInstance& box : list.boxes) box.width *= by;
    what = formatted("by %.2f", double{by});
    return true;
}

bool remove_line(DrawList& list, Uniform& random, std::string& what) {
    const std::size_t count = list.lines.size() + list.overlay_lines.size();
    if (count == 0) return false;
    const auto found = static_cast<std::size_t>(random.below(static_cast<int>(count)));
    if (found >= list.lines.size()) {
        what = "over the picture";
        take_out(list.overlay_lines, found - list.lines.size());
        return true;
    }
    const LineInstance& line = list.lines[found];
    const auto from = list.projection.project(line.from), to = list.projection.project(line.to);
    what = formatted("of %.1f pixels", from && to ? double{glm::length(*to - *from)} : 0.0);
    take_out(list.lines, found);
    return true;
}

bool remove_overlay_line(DrawList& list, Uniform& random, std::string& what) {
    if (list.overlay_lines.empty()) return false;
    const std::size_t found = pick(list.overlay_lines, random);
    what = formatted("line %d", static_cast<int>(found));
    take_out(list.overlay_lines, found);
    return true;
}

bool shorten_floor_line(DrawList& list, Uniform& random, std::string& what) {
    const auto found = pick_if(list.lines, random, [](const LineInstance& line) {
        return line.order.layer == DrawLayer::surroundings && line.order.level == 0;
    });
    if (!found) return false;
    LineInstance& line = list.lines[*found];
    line.to = glm::mix(line.from, line.to, 0.95f);
    what = formatted("line %d", static_cast<int>(*found));
    return true;
}

/// Levels that are drawn from the last to the first.
bool reverse_levels(DrawList& list, Uniform&, std::string& what) {
    std::vector<int> levels;
    for (const BoxInstance& box : list.boxes) levels.push_back(box.order.level);
    const auto [first, last] = std::ranges::minmax_element(levels);
    if (levels.empty() || *first == *last) return false;
    for (BoxInstance& box : list.boxes) box.order.level = *first + *last - box.order.level;
    what = formatted("%d to %d", *first, *last);
    return true;
}

bool fade_boxes(DrawList& list, Uniform& random, std::string& what) {
    if (list.boxes.empty()) return false;
    const float by = factor(random, 0.1, 0.3);
    for (BoxInstance& box : list.boxes) box.fill.a *= by;
    what = formatted("by %.2f", double{by});
    return true;
}

/// What these points cover, pixels.
Rect around(std::span<const glm::vec3> points, const ViewProjection& projection) {
    std::optional<Rect> out;
    for (const glm::vec3& point : points) {
        const glm::vec2 at = projection.project(point).value_or(glm::vec2(0));
        out = out ? Rect{glm::min(out->min, at), glm::max(out->max, at)} : Rect{at, at};
    }
    return *out;
}

/// Of two lines, two boxes' edges, or one and the other, where they may cover one another in other colours.
bool exchange_order(DrawList& list, Uniform& random, std::string& what) {
    struct Item {
        DrawOrder* order;
        Rgba color;
        Rect rect;
    };
    std::vector<Item> items;
    for (LineInstance& line : list.lines) {
        items.push_back({&line.order, line.color, around(std::array{line.from, line.to}, list.projection)});
    }
    for (BoxInstance& box : list.boxes)
        items.push_back({&box.order, box.edge, around(box_corners(box), list.projection)});
    if (items.empty()) return false;
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const std::size_t i = pick(items, random), j = pick(items, random);
        const Item &a = items[i], &b = items[j];
        if (a.color == b.color || !a.rect.overlaps(b.rect)) continue;
        std::swap(*a.order, *b.order);
        what = formatted("%d and %d of %d lines and %d boxes", static_cast<int>(i), static_cast<int>(j),
                         static_cast<int>(list.lines.size()), static_cast<int>(list.boxes.size()));
        return true;
    }
    return false;
}

void fill(Image& image, glm::ivec2 min, glm::ivec2 max, Rgba color) {
    for (int y = std::max(min.y, 0); y < std::min(max.y, image.height); ++y) {
        for (int x = std::max(min.x, 0); x < std::min(max.x, image.width); ++x) {
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(255 * color[c]));
        }
    }
}

bool paint_block(Image& image, const Drawn&, Uniform& random, std::string& what) {
    const glm::ivec2 size(16, 11);
    const glm::ivec2 at(random.below(image.width - size.x), random.below(image.height - size.y));
    fill(image, at, at + size, hex(0xD01010));
    what = formatted("at (%d, %d)", at.x, at.y);
    return true;
}

bool paint_over_tick_label(Image& image, const Drawn& before, Uniform& random, std::string& what) {
    if (before.lists.size() != 1) return false;
    const DrawList& list = before.lists.front();
    const auto found = pick_if(list.texts, random, is_tick_label);
    if (!found) return false;
    const TextRun& text = list.texts[*found];
    fill(image, glm::floor(text.box.min), glm::ceil(text.box.max), list.background.value_or(list.palette.background));
    what = text.text;
    return true;
}

// No pixel of these differs by more than the tolerance: means of tiles tell.

template <class Change>
bool change_levels(Image& image, const Change& change) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(std::clamp(change(image.rgba[i]), 0, 255));
    }
    return true;
}

bool brighten(Image& image, const Drawn&, Uniform&, std::string&) {
    return change_levels(image, [](int level) { return level + 3; });
}

bool change_gamma(Image& image, const Drawn&, Uniform&, std::string&) {
    return change_levels(image,
                         [](int level) { return static_cast<int>(std::lround(255 * std::pow(level / 255.0, 1.02))); });
}

bool leave_six_bits(Image& image, const Drawn&, Uniform&, std::string&) {
    return change_levels(image, [](int level) { return level / 4 * 255 / 63; });
}

/// It is in the golden or in the picture: which of them makes no difference.
bool add_faint_grid(Image& image, const Drawn&, Uniform& random, std::string& what) {
    const int step = 8 + random.below(13), by = random.below(2) == 0 ? 3 : -3;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (x % step != 0 && y % step != 0) continue;
            for (int c = 0; c < 3; ++c)
                image.at(x, y)[c] = static_cast<std::uint8_t>(std::clamp(image.at(x, y)[c] + by, 0, 255));
        }
    }
    what = formatted("every %d pixels", step);
    return true;
}

constexpr Kind kKinds[] = {
    {"agent 1 mm aside", move_agent<10>, true},
    {"agent 3 mm aside", move_agent<30>, true},
    {"agent 1 cm aside", move_agent<100>, true},
    {"camera 0.1 degrees aside", turn_camera, true},
    {"time 1 % higher or lower", stretch_time, true},
    {"label 1 pixel aside", shift_label, true},
    {"box missing", remove_box},
    {"disk missing", remove_disk},
    {"line missing", remove_line},
    {"label missing", remove_label},
    {"tick label missing", remove_tick_label},
    {"every second tick label missing", remove_every_second_tick},
    {"tick label with another digit", change_tick_digit},
    {"time axis missing", hide_time_axis},
    {"legend row missing", remove_legend_row},
    {"one line 10-30 % wider or thinner", widen_line},
    {"all lines 10-30 % wider or thinner", widen_all_lines},
    {"two lines or boxes in the other order", exchange_order},
    {"line of the floor 5 % shorter", shorten_floor_line},
    {"line over the picture missing", remove_overlay_line},
    {"levels in the other order", reverse_levels},
    {"boxes 10-30 % more or less opaque", fade_boxes},
    {"agent's colour by 8-24 of 255", recolor_agent},
    {"agent renamed", rename_one_agent},
    {"level off by one", shift_level},
    {"red block of 16x11 painted", paint_block},
    {"tick label painted over", paint_over_tick_label},
    {"picture 3 of 255 brighter", brighten},
    {"gamma 1.02", change_gamma},
    {"6 bits a channel", leave_six_bits},
    {"faint grid missing", add_faint_grid},
};

}  // namespace

std::span<const Kind> kinds_of_change() { return kKinds; }

}  // namespace mobbscope::picture_tests
