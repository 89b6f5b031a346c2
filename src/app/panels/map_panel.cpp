#include <app/panels/panels.h>
#include <app/ui/swatch.h>
#include <app/ui/value_histogram.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/query/map_colors.h>
#include <render/text/labels.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

// Pixels at scale 1.
constexpr float kLeastSide = 96;
constexpr float kMostSide = 520;
constexpr float kHatch = 7;      // between lines
constexpr float kLowRoom = 860;  // windows with less keep the map folded at first
constexpr std::size_t kImageSlot = 40;

const char* axis_title(MapAxis axis) {
    switch (axis) {
        case MapAxis::dx:
            return "x";
        case MapAxis::dy:
            return "y";
        case MapAxis::dheading:
            return "turned";
        case MapAxis::dstart:
            break;
    }
    return "start";
}

std::string with_axis_unit(MapAxis axis, double value) {
    if (axis == MapAxis::dheading) return formatted("%.0f\u00B0", value + 0.0);
    return formatted("%.2f ", value + 0.0) + std::string(axis_unit(axis));
}

/// "x 1.25 m, y -0.50 m"
std::string place_words(const MapOrder& order, glm::dvec2 at) {
    return std::string(axis_title(order.across.axis)) + ' ' + with_axis_unit(order.across.axis, at.x) + ", " +
           axis_title(order.up.axis) + ' ' + with_axis_unit(order.up.axis, at.y);
}

std::string range_words(const MapRange& range) {
    return with_axis_unit(range.axis, range.from) + " to " + with_axis_unit(range.axis, range.to);
}

MapColors colors_of(const MapInspector& maps, const MapPicture& picture) {
    const auto& chosen = maps.choice.colors;
    return chosen ? MapColors{chosen->first, chosen->second} : picture.usual_colors();
}

/// The axes, and what is shown over them.
void controls(Ui& ui, const MapInspector& maps) {
    const Command& axes = *find_command("map.axes", commands(ui.session));
    const std::string now = std::string(name(maps.choice.across)) + ',' + std::string(name(maps.choice.up));
    const auto words_of_axes = [](const std::string& text) {
        const std::size_t comma = text.find(',');
        return std::string(axis_title(*map_axis_from_name(text.substr(0, comma)))) + ", " +
               axis_title(*map_axis_from_name(text.substr(comma + 1)));
    };
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), ui.px(1)});
    ImGui::SetNextItemWidth(ui.px(96));
    if (begin_dropdown(ui, "map.axes", words_of_axes(now), "")) {
        for (const std::string& text : axes.choices(ui.session)) {
            if (ImGui::Selectable(words_of_axes(text).c_str(), text == now)) ui.invoke("map.axes", text);
            ui.mark("map.axes." + text);
        }
        ImGui::EndCombo();
    }
    ImGui::PopStyleVar();
    ImGui::SameLine(0, ui.px(4));
    std::vector<ChoiceWord> shows;
    for (const std::string_view show : map_show_names()) shows.push_back({std::string(show), std::string(show)});
    const int pressed = word_choice(ui, "map.show", shows, static_cast<int>(maps.choice.show));
    if (pressed >= 0) ui.invoke("map.show", shows[static_cast<std::size_t>(pressed)].name);
}

void caption(Ui& ui, ImVec2 at, const std::string& left, const std::string& right, float width) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImFont& font = *ui.style.caption;
    draw_text(list, font, at, ui.style.quiet, left);
    const float room = text_size(font, right).x;
    if (text_size(font, left).x + room + ui.px(8) < width)
        draw_text(list, font, {at.x + width - room, at.y}, ui.style.quiet, right);
}

ImVec2 to_vec(glm::vec2 v) { return {v.x, v.y}; }

}  // namespace

void MapPicture::follow(const std::shared_ptr<const PlacementMap>& map) {
    if (map_ == map) return;
    map_ = map;
    usual_colors_ = mobbscope::usual_colors(*map);
    constexpr int kBars = 64;
    counts_ = value_counts(*map, usual_colors_, kBars);
    key_.reset();
}

void MapPicture::remake(const MapColors& colors, const Style& style, const Rect& area) {
    const Key key{colors, style.palette.dark, area.min, area.max};
    if (key_ == key) return;
    key_ = key;
    image_ = std::make_shared<const Image>(map_image(*map_, colors, style.palette));
    hatch_ = hit_hatch(*map_, area, kHatch * style.scale);
}

void MapPicture::draw(Ui& ui, const Rect& area) const {
    const PlacementMap& map = *map_;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 min = to_vec(area.min), max = to_vec(area.max);
    list.AddRectFilled(min, max, ui.style.raised);
    if (const ImTextureID texture = ui.painter.image(kImageSlot, image_, false)) list.AddImage(texture, min, max);
    list.PushClipRect(min, max, true);
    const ImU32 hatch = to_im(hatch_color(map.order.show, ui.style.palette));
    for (const PixelLine& line : hatch_) list.AddLine(to_vec(line.from), to_vec(line.to), hatch, ui.style.scale);
    const ImU32 edge = to_im(boundary_color(ui.style.palette));
    for (const MapLine& line : map.boundary) {
        list.AddLine(to_vec(map_pixel(map.order, area, line.from)), to_vec(map_pixel(map.order, area, line.to)), edge,
                     1.4f * ui.style.scale);
    }
    list.PopClipRect();
    list.AddRect(min, max, ui.style.border);
}

namespace {

/// How many cells have which value, and the range of the colours.
void histogram(Ui& ui, const MapInspector& maps, const PlacementMap& map, const MapPicture& picture, float width) {
    const MapColors whole = picture.usual_colors(), colors = colors_of(maps, picture);
    const char* unit = map.order.show == MapShow::clearance ? " m" : " tests";
    const auto text = [unit](double value) { return brief(std::round(value * 100) / 100) + unit; };
    const auto value_at = [&](float place) {
        return whole.from + static_cast<double>(place) * (whole.to - whole.from);
    };
    const auto place_of = [&](double value) {
        return static_cast<float>((value - whole.from) / (whole.to - whole.from));
    };
    const HistogramChange change = value_histogram(
        ui,
        {.mark = "map.range",
         .counts = picture.counts(),
         .color = [&](float place) { return value_color(map.order.show, value_at(place), colors, ui.style.palette); },
         .from = place_of(colors.from),
         .to = place_of(colors.to),
         .at = [&](float place) { return text(value_at(place)); },
         .from_text = text(colors.from),
         .to_text = text(colors.to),
         .chosen = maps.choice.colors.has_value()},
        width);
    if (change.kind == HistogramChange::Kind::automatic) ui.invoke("map.range", "auto");
    if (change.kind != HistogramChange::Kind::dragged) return;
    const std::pair wanted(value_at(change.ends.first), value_at(change.ends.second));
    ui.later([wanted](MapInspector& now) { now.choice.colors = wanted; });
}

/// The mouse in the map: what is there, and B goes where it is pressed.
void mouse(Ui& ui, MapInspector& maps, const PlacementMap& map, const Rect& area) {
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    const ImGuiIO& io = ImGui::GetIO();
    const auto value_at = [&](ImVec2 pixel) {
        const glm::dvec2 share((pixel.x - area.min.x) / area.size().x, (area.max.y - pixel.y) / area.size().y);
        const glm::dvec2 inside(std::clamp(share.x, 0.0, 1.0), std::clamp(share.y, 0.0, 1.0));
        const MapRange &across = map.order.across, &up = map.order.up;
        return glm::dvec2(across.from + inside.x * (across.to - across.from), up.from + inside.y * (up.to - up.from));
    };
    const glm::dvec2 at = value_at(io.MousePos);
    const std::string why = maps.why_not_placed();
    const bool pressed = ImGui::IsItemActivated(), dragged = active && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0);
    if ((pressed || dragged) && why.empty())
        ui.later([axes = map.order, at](MapInspector& now) { now.place_b(axes, at); });
    if (hovered && io.MouseWheel != 0) {
        const double factor = std::pow(0.85, static_cast<double>(io.MouseWheel));
        const auto zoomed = [factor](MapRange range, double about) {
            return MapRange{range.axis, about + (range.from - about) * factor, about + (range.to - about) * factor};
        };
        const std::pair extent(zoomed(map.order.across, at.x), zoomed(map.order.up, at.y));
        ui.later([extent](MapInspector& now) { now.choice.extent = extent; });
    }
    if (!hovered && !active) return;
    // Of the very place where a click would put B: beside a boundary the cell's middle may say the other answer.
    std::string text = place_words(map.order, at) + "\n" + maps.words_at(map.order, at);
    text += "\n" + (why.empty() ? std::string("Click or drag: it goes there. Wheel: zooms") : why);
    // Beside the map, which it would cover.
    ImGui::SetNextWindowPos({area.min.x - ui.px(12), io.MousePos.y}, ImGuiCond_Always, {1, 0.5f});
    ImGui::SetTooltip("%s", text.c_str());
}

/// A ring where B stands now; at the edge where that is outside.
void ring(Ui& ui, const PlacementMap& map, const Rect& area, glm::dvec2 at) {
    const glm::vec2 pixel = map_pixel(map.order, area, at);
    const glm::vec2 inside{std::clamp(pixel.x, area.min.x, area.max.x), std::clamp(pixel.y, area.min.y, area.max.y)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircle(to_vec(inside), ui.px(6), IM_COL32(0, 0, 0, 255), 0, ui.px(4));
    list.AddCircle(to_vec(inside), ui.px(6), IM_COL32_WHITE, 0, ui.px(1.8f));
}

}  // namespace

MapLayout map_layout(const Ui& ui, ImVec2 room) {
    MapLayout out;
    const bool screen = ui.session.screen != nullptr;
    if (screen || !ui.session.maps.can_be()) return out;
    out.folded_at_first = room.y < ui.px(kLowRoom);
    const float around = 2 * ImGui::GetStyle().WindowPadding.y + ui.px(6) + 2 * ui.px(5) + ui.style.caption->FontSize;
    out.height = around;
    if (is_folded(ui.session.settings, std::string(kMapSection), out.folded_at_first)) return out;
    const float line = ui.style.caption->FontSize;
    const float below =
        ui.session.maps.choice.show == MapShow::answer ? ImGui::GetTextLineHeight() : histogram_height(ui);
    const float parts = ImGui::GetFrameHeight() + ui.px(8) + 2 * (line + ui.px(4)) + ui.px(6) + below +
                        ImGui::GetFrameHeight() + ui.px(10);
    const float width = room.x - 2 * ImGui::GetStyle().WindowPadding.x;
    out.side =
        std::floor(std::clamp(std::min(width, 0.62f * room.y - around - parts), ui.px(kLeastSide), ui.px(kMostSide)));
    out.height = around + parts + out.side;
    return out;
}

void map_panel(Ui& ui, MapInspector& maps, MapPicture& picture, const MapLayout& layout) {
    const ImVec2 corner = ImGui::GetWindowPos();
    ImGui::GetWindowDrawList()->AddLine(corner, {corner.x + ImGui::GetWindowWidth(), corner.y}, ui.style.border);
    const auto whole = maps.seconds();
    std::string cells = std::to_string(kUsualMapCells) + " x " + std::to_string(kUsualMapCells);
    if (ui.session.options.attended && maps.is_shown)
        cells = whole ? cells + formatted(" in %.0f ms", std::ceil(1e3 * *whole)) : cells + "\u2026";
    maps.is_shown = section(ui, "WHERE COULD B STAND?", cells, layout.folded_at_first);
    if (!maps.is_shown || layout.side <= 0 || !maps.can_be()) return;
    maps.update();
    controls(ui, maps);
    const std::shared_ptr<const PlacementMap> map = maps.map();
    const float line = ui.style.caption->FontSize;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const Rect area{{at.x, at.y + line + ui.px(3)}, {at.x + layout.side, at.y + line + ui.px(3) + layout.side}};
    ImGui::SetCursorScreenPos(to_vec(area.min));
    ImGui::InvisibleButton("map", {layout.side, layout.side});
    ui.mark_only("query.map");
    if (map) {
        const MapOrder& order = map->order;
        caption(ui, at, std::string(axis_title(order.up.axis)) + " \u2191  " + range_words(order.up), "", layout.side);
        picture.follow(map);
        picture.remake(colors_of(maps, picture), ui.style, area);
        picture.draw(ui, area);
        ring(ui, *map, area, maps.place_of_b(*map));
        mouse(ui, maps, *map, area);
        caption(ui, {area.min.x, area.max.y + ui.px(2)}, range_words(order.across),
                std::string(axis_title(order.across.axis)) + " \u2192", layout.side);
    }
    ImGui::SetCursorScreenPos({at.x, area.max.y + line + ui.px(8)});
    if (map && map->order.show != MapShow::answer) histogram(ui, maps, *map, picture, layout.side);
    const bool on_floor = ui.workspace.view().boundary;
    if (map && map->order.show == MapShow::answer && map->step == 1)
        fitted_line(ui, ui.style.quiet, map_words(*map, maps.query().a.name, maps.query().b.name), width);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(3), ui.px(1)});
    bool wanted = on_floor;
    if (ImGui::Checkbox("boundary on the floor", &wanted)) ui.invoke("view.boundary");
    ImGui::PopStyleVar();
    ui.mark("map.boundary");
    if (maps.choice.extent) {
        ImGui::SameLine();
        if (small_button(ui, "whole map", "map.extent.auto", "All placements where the two can meet"))
            ui.invoke("map.extent", "auto");
    }
}

}  // namespace mobbscope::app
