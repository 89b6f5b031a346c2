#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <base/text.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace mobbscope::app {

namespace {

bool shows_query(const Workspace& workspace) { return workspace.view().query.has_value(); }
Condition with_query() {
    return {shows_query, []() -> std::string_view { return "no query is shown"; }};
}

constexpr std::array<std::string_view, 6> kAxes{"dx,dy",     "dheading,dstart", "dx,dstart",
                                                "dy,dstart", "dx,dheading",     "dy,dheading"};

std::string axes_of(const MapChoice& choice) {
    return std::string(name(choice.across)) + ',' + std::string(name(choice.up));
}

void show(MapInspector& maps, const std::string& text) {
    const auto all = map_show_names();
    const auto next = (static_cast<std::size_t>(maps.choice.show) + 1) % all.size();
    const auto wanted = map_show_from_name(text.empty() ? all[next] : text);
    if (!wanted) throw std::invalid_argument("a map cannot show " + in_quotes(text) + ": give " + either(all));
    maps.choice.show = *wanted;
    maps.choice.colors.reset();
}

void axes(MapInspector& maps, const std::string& text) {
    const auto now = std::ranges::find(kAxes, axes_of(maps.choice));
    const std::string wanted(!text.empty()                                  ? text
                             : now == kAxes.end() || now + 1 == kAxes.end() ? std::string(kAxes.front())
                                                                            : std::string(*(now + 1)));
    const std::size_t comma = wanted.find(',');
    const auto across = map_axis_from_name(wanted.substr(0, comma));
    const auto up = comma == std::string::npos ? std::nullopt : map_axis_from_name(wanted.substr(comma + 1));
    if (!across || !up || across == up)
        throw std::invalid_argument(in_quotes(text) + " is not two axes of a map: give two of " +
                                    listed(map_axis_names()) + ", as dx,dy");
    maps.choice.across = *across;
    maps.choice.up = *up;
    maps.choice.extent.reset();
}

void extent(MapInspector& maps, const std::string& text) {
    if (text.empty() || text == "auto") return maps.choice.extent.reset();
    const std::size_t comma = text.find(',');
    const auto across = parse_range(text.substr(0, comma));
    const auto up = comma == std::string::npos ? std::nullopt : parse_range(text.substr(comma + 1));
    if (!across || !up)
        throw std::invalid_argument(in_quotes(text) + " is not an extent: give auto, or two ranges like -5:5,-5:5");
    MapOrder order;
    order.across = {maps.choice.across, across->first, across->second};
    order.up = {maps.choice.up, up->first, up->second};
    check(order);
    maps.choice.extent = {order.across, order.up};
}

void range(MapInspector& maps, const std::string& text) {
    if (text.empty() || text == "auto") return maps.choice.colors.reset();
    const auto values = parse_range(text);
    if (!values || !(values->first < values->second))
        throw std::invalid_argument(in_quotes(text) + " is not a range of values: give auto, or two like 0:2.5");
    maps.choice.colors = values;
}

void place_in_map(MapInspector& maps, const std::string& text) {
    maps.place_b(maps.axes(), two_numbers(text, "the place in the map"));
}

std::string present_extent(const MapInspector& maps) {
    const auto map = maps.map();
    if (!map) return "auto";
    const auto of = [](const MapRange& r) { return format_double(r.from) + ':' + format_double(r.to); };
    return of(map->order.across) + ',' + of(map->order.up);
}

std::string present_range(const MapInspector& maps) {
    const auto& colors = maps.choice.colors;
    return colors ? format_double(colors->first) + ':' + format_double(colors->second) : "auto";
}

std::string present_place(const MapInspector& maps) {
    const glm::dvec2 at = offset_between({}, maps.query().b.placement, maps.axes());
    return format_double(at.x) + ' ' + format_double(at.y);
}

}  // namespace

std::vector<Command> map_commands() {
    const std::vector<Command> rows{
        Command("map.panel", "Map of placements",
                "Shows a map of the answers for places of B of the query in view; or folds it.",
                [](Settings& settings, const MapInspector& maps) {
                    settings.folded[std::string(kMapSection)] = maps.is_shown;
                },
                {.shortcut = "Shift+M",
                 .enabled = with_query(),
                 .checked = [](const MapInspector& maps) { return maps.is_shown; },
                 .also = "heat heatmap configuration space where"}),
        Command("map.show", "Map shows",
                "Chooses what the map shows: answers, the least clearance, or the tests that a query takes.", show,
                {.menu = "Query/Map",
                 .argument = "[answer|clearance|tests]",
                 .choices =
                     [](const Session&) {
                         const auto all = map_show_names();
                         return std::vector<std::string>(all.begin(), all.end());
                     },
                 .chosen = [](const MapInspector& maps,
                              const std::string& text) { return name(maps.choice.show) == text; }}),
        Command(
            "map.axes", "Axes of the map", "Chooses what of B's placement the map changes, to the right and upwards.",
            axes,
            {.menu = "Query/Map",
             .argument = "[AXIS,AXIS]",
             .choices = [](const Session&) { return std::vector<std::string>(kAxes.begin(), kAxes.end()); },
             .chosen = [](const MapInspector& maps, const std::string& text) { return axes_of(maps.choice) == text; }}),
        Command("map.extent", "Extent of the map",
                "Chooses the ranges of the map's axes; auto: all placements where the two can meet.", extent,
                {.menu = kNoMenu, .argument = "[auto|A:B,A:B]", .enabled = with_query(), .present = present_extent}),
        Command("map.range", "Colours of the map",
                "Chooses the values at the ends of the map's colours; auto: the least and the largest.", range,
                {.menu = kNoMenu, .argument = "[auto|A:B]", .enabled = with_query(), .present = present_range}),
        Command("map.place", "Place B in the map", "Places B of the query in view along the map's two axes.",
                place_in_map,
                {.menu = kNoMenu,
                 .argument = "U V",
                 .enabled = {[](const MapInspector& maps) { return maps.why_not_placed().empty(); },
                             []() -> std::string_view { return "no query of an agent is shown"; }},
                 .present = present_place}),
    };
    return in_menu("Query", rows);
}

}  // namespace mobbscope::app
