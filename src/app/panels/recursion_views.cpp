#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/thing_menus.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <render/text/labels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr float kSquareAhead = 0.28f;  // strength of what comes after the present step

/// What both axes cover, and where.
struct Square {
    Square(ImVec2 corner, float side, mobb::Interval of_a, mobb::Interval of_b)
        : min(corner),
          max{corner.x + side, corner.y + side},
          a(of_a),
          b(of_b),
          x{a.t0, a.t1, min.x, max.x},
          y{b.t0, b.t1, max.y, min.y} {}

    ImVec2 min, max;
    mobb::Interval a, b;
    ChartAxis x, y;
};

bool contains(const PairCell& cell, ImVec2 at, ImVec2 mouse) {
    return mouse.x >= at.x + static_cast<float>(cell.x0) && mouse.x < at.x + static_cast<float>(cell.x1) &&
           mouse.y >= at.y + static_cast<float>(cell.y0) && mouse.y < at.y + static_cast<float>(cell.y1);
}

/// The last cell that the mouse was in when the menu of the last widget was opened, with its tests.
void cell_menu(Ui& ui, QueryInspector& queries, const Recursion& recursion, const std::vector<PairCell>& cells,
               ImVec2 at) {
    context_menu(ui, [&]() -> std::vector<MenuEntry> {
        const ImVec2 mouse = ImGui::GetMousePosOnOpeningCurrentPopup();
        const auto under =
            std::find_if(cells.rbegin(), cells.rend(), [&](const PairCell& cell) { return contains(cell, at, mouse); });
        if (under == cells.rend()) return test_menu(ui.workspace, queries, ui.workspace.step());
        return test_menu(ui.workspace, queries, recursion.pairs[static_cast<std::size_t>(under->pair)].last);
    });
}

/// Draws each cell with its pair, its corners and whether its test is past; null or the last one that the mouse is in.
template <class Draw>
const PairCell* draw_cells(const Recursion& recursion, const std::vector<PairCell>& cells, ImVec2 at, int step,
                           const Draw& draw) {
    const PairCell* under = nullptr;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    for (const PairCell& cell : cells) {
        const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(cell.pair)];
        const ImVec2 min{at.x + static_cast<float>(cell.x0), at.y + static_cast<float>(cell.y0)};
        const ImVec2 max{at.x + static_cast<float>(cell.x1), at.y + static_cast<float>(cell.y1)};
        draw(cell, pair, min, max, pair.first <= step);
        if (contains(cell, at, mouse)) under = &cell;
    }
    return under;
}

/// Where both times are equal: only what it crosses can hit.
void common_time(ImDrawList& list, const Style& style, const Square& square) {
    const double t0 = std::max(square.a.t0, square.b.t0);
    const double t1 = std::min(square.a.t1, square.b.t1);
    if (t1 <= t0) return;
    list.AddLine({square.x.pixel(t0), square.y.pixel(t0)}, {square.x.pixel(t1), square.y.pixel(t1)}, style.accent,
                 1.3f * style.scale);
}

/// The lines of the proof along the common time, each between two ticks. Returns the one that the mouse is on.
std::optional<std::size_t> proof_intervals(Ui& ui, const QueryFindings& findings, const Square& square) {
    const auto selected = selected_line(ui.workspace, findings.proof);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    std::optional<std::size_t> under;
    for (const LineRun& run : line_runs(findings.proof, square.x, selected)) {
        const double t0 = findings.proof.lines[run.first].t0, t1 = findings.proof.lines[run.last].t1;
        const ImVec2 from{square.x.pixel(t0), square.y.pixel(t0)};
        const ImVec2 to{square.x.pixel(t1), square.y.pixel(t1)};
        const ImVec2 way{to.x - from.x, to.y - from.y};
        const float length = std::max(std::hypot(way.x, way.y), 1e-3f);
        const ImVec2 across{-way.y / length, way.x / length};
        const ImU32 color = mark_color(ui.style, EventMark::separated);
        const float width = ui.px(run.first == selected ? 4.5f : 2.5f), tick = ui.px(5);
        // On ground of its own: cells that are separated have the same colour.
        for (const auto& [ink, more] : {std::pair(ui.style.window, ui.px(2)), std::pair(color, 0.0f)}) {
            list.AddLine(from, to, ink, width + more);
            for (const ImVec2 end : {from, to}) {
                list.AddLine({end.x - tick * across.x, end.y - tick * across.y},
                             {end.x + tick * across.x, end.y + tick * across.y}, ink, ui.px(1.5f) + more);
            }
        }
        const ImVec2 at{mouse.x - from.x, mouse.y - from.y};
        const float along = (at.x * way.x + at.y * way.y) / length, aside = at.x * across.x + at.y * across.y;
        if (along >= 0 && along <= length && std::abs(aside) <= tick) under = run.first;
    }
    return under;
}

void axis_labels(Ui& ui, const QueryFindings& findings, const Square& square) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImFont& font = *ui.style.caption;
    const auto text = [&](ImVec2 at, ImU32 color, const std::string& words) {
        draw_text(list, font, at, color, words);
    };
    const auto width = [&](const std::string& words) { return text_size(font, words).x; };
    const ImU32 color_a = to_im(readable(findings.sides[0].color, ui.style.palette));
    const ImU32 color_b = to_im(readable(findings.sides[1].color, ui.style.palette));
    const float below = square.max.y + ui.px(3);
    const std::string from = formatted("%.2f s", square.a.t0), to = formatted("%.2f s", square.a.t1);
    text({square.min.x, below}, color_a, from);
    text({square.max.x - width(to), below}, color_a, to);
    const std::string name_a = findings.sides[0].label + " \u2192";
    const float middle = 0.5f * (square.min.x + square.max.x - width(name_a));
    if (middle > square.min.x + width(from) + ui.px(4)) text({middle, below}, color_a, name_a);
    const float above = square.min.y - font.FontSize - ui.px(3);
    text({square.min.x, above}, color_b,
         findings.sides[1].label + formatted(" \u2191  %.2f s to %.2f s", square.b.t0, square.b.t1));
}

/// Of a pair whose children lie in it: a corner with a line beside it, which leaves them to be seen.
void avoidable_corner(ImDrawList& list, const Style& style, ImVec2 min, ImVec2 max, float strength) {
    const ImU32 color = mark_color(style, EventMark::avoidable, strength);
    const float side = std::min(6 * style.scale, 0.5f * std::min(max.x - min.x, max.y - min.y));
    list.AddTriangleFilled(min, {min.x + side, min.y}, {min.x, min.y + side}, color);
    list.AddRect(min, max, color, 0, 0, style.scale);
}

constexpr float kIcicleAhead = 0.35f;  // strength of what comes after the present step

/// Pairs that went on to others stay quiet: what they found stands below them.
void draw_inner(ImDrawList& list, const Style& style, ImVec2 min, ImVec2 max, const RecursionPair& pair,
                float strength) {
    list.AddRectFilled(min, max, style.raised);
    if (pair.avoidable) outcome_cell(list, style, min, max, EventMark::avoidable, 0.6f * strength);
    if (pair.hit)
        list.AddRectFilled({min.x, max.y - 2 * style.scale}, max, mark_color(style, EventMark::hit, strength));
}

/// How much of the strip's height an event takes: what says more stands taller.
constexpr std::array<float, kEventMarks> kHeights{0.14f, 0.3f, 0.55f, 0.7f, 0.7f, 0.85f, 1.0f};

constexpr float kStripAhead = 0.4f;  // strength of what comes after the present step

void draw_cell(ImDrawList& list, const Style& style, const StripCell& cell, ImVec2 at, float height, float strength) {
    const float width = cell.x1 - cell.x0;
    const float gap = width >= 3 * style.scale ? style.scale : 0;
    // Taller ones behind: the top of each is seen, so a column shows all that is in it.
    for (std::size_t m = kEventMarks; m-- > 0;) {
        if (cell.marks[m] == 0) continue;
        const float top = at.y + height * (1 - kHeights[m]);
        list.AddRectFilled({at.x + cell.x0, top}, {at.x + cell.x1 - gap, at.y + height},
                           mark_color(style, static_cast<EventMark>(m), strength));
    }
}

/// The event that a cell leads to: its first, or the present one if it is in it.
int event_of(const StripCell& cell, int step) { return step >= cell.first && step < cell.end ? step : cell.first; }

std::string tooltip(const QueryFindings& findings, const mobb::Trace& trace, const StripCell& cell, int step) {
    std::string out = step_sentence(findings.sides, trace, event_of(cell, step));
    if (cell.end - cell.first == 1) return out;
    out += "\nevents " + std::to_string(cell.first) + " to " + std::to_string(cell.end - 1) + " stand here";
    for (std::size_t m = kEventMarks; m-- > 0;) {
        if (cell.marks[m] == 0) continue;
        out += "\n" + std::to_string(cell.marks[m]) + "  " + headline(static_cast<EventMark>(m));
    }
    return out;
}

}  // namespace

void QueryPictures::square(Ui& ui, QueryInspector& queries, const QueryFindings& findings) {
    const Recursion& recursion = findings.recursion;
    const float caption = ui.style.caption->FontSize;
    const float label = caption + ui.px(5);
    const float side = std::floor(std::min(ImGui::GetContentRegionAvail().x, ui.px(340)));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const Square square({at.x, at.y + label}, side, recursion.pairs.front().time_a, recursion.pairs.front().time_b);
    const int size = static_cast<int>(side);
    if (size < 16) return;
    ImGui::SetCursorScreenPos(square.min);
    ImGui::InvisibleButton("square", {side, side});
    ui.mark_only("query.square");
    const bool hovered = ImGui::IsItemHovered();
    const bool clicked = ImGui::IsItemClicked();

    const std::vector<PairCell>& cells = square_.of(
        queries.findings(), size, size, [&] { return square_cells(recursion, square.a, square.b, size, size); });
    cell_menu(ui, queries, recursion, cells, square.min);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(square.min, square.max, ui.style.raised);
    const int step = ui.workspace.step();
    const int present = recursion.pair_of[static_cast<std::size_t>(step)];
    // Later cells lie in earlier ones: the last that the mouse is in is the smallest.
    const PairCell* under = draw_cells(
        recursion, cells, square.min, step,
        [&](const PairCell& cell, const RecursionPair& pair, ImVec2 min, ImVec2 max, bool past) {
            const float strength = past ? 1 : kSquareAhead;
            if (pair.has_children()) {
                list.AddRect(min, max, to_im(with_alpha(ui.style.palette.axis, 0.6f * strength)), 0, 0, ui.style.scale);
                if (pair.avoidable) avoidable_corner(list, ui.style, min, max, strength);
            } else {
                const float gap = cell.x1 - cell.x0 > 4 ? 1.0f : 0.0f;
                outcome_cell(list, ui.style, min, {max.x - gap, max.y - gap}, mark_of(pair), strength);
            }
        });
    common_time(list, ui.style, square);
    const RecursionPair& now = recursion.pairs[static_cast<std::size_t>(present)];
    // However small the pair is, its outline is seen.
    const ImVec2 first{square.x.pixel(now.time_a.t0), square.y.pixel(now.time_b.t0)};
    const ImVec2 last{square.x.pixel(now.time_a.t1), square.y.pixel(now.time_b.t1)};
    const ImVec2 middle{0.5f * (first.x + last.x), 0.5f * (first.y + last.y)};
    const float half_x = std::max(ui.px(4), last.x - middle.x + ui.px(1));
    const float half_y = std::max(ui.px(4), first.y - middle.y + ui.px(1));
    list.AddRect({middle.x - half_x, middle.y - half_y}, {middle.x + half_x, middle.y + half_y}, ui.style.text, 0, 0,
                 ui.px(2));
    const auto line = proof_intervals(ui, findings, square);
    axis_labels(ui, findings, square);
    ImGui::SetCursorScreenPos({at.x, square.max.y + label});
    ImGui::Dummy({0, 0});
    if (hovered && line) {
        ImGui::SetTooltip("%s", tile_words(findings.sides, findings.proof, *line).c_str());
        if (clicked) ui.invoke("proof.line", std::to_string(*line));
        return;
    }
    if (!hovered || !under) return;
    const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(under->pair)];
    const std::string more =
        under->merged > 1 ? "\nand " + std::to_string(under->merged - 1) + " smaller pairs here" : "";
    ImGui::SetTooltip("%s%s", step_sentence(findings.sides, ui.workspace.recorded()->trace, pair.last).c_str(),
                      more.c_str());
    if (clicked) ui.invoke("step.to", std::to_string(pair.last));
}

void QueryPictures::icicle(Ui& ui, QueryInspector& queries, ImVec2 size) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    const int width = static_cast<int>(size.x);
    if (!findings || findings->recursion.pairs.empty() || width < 1) return;
    const Recursion& recursion = findings->recursion;
    const int most = static_cast<int>(ui.px(20));
    const int row = std::clamp(static_cast<int>(size.y) / std::max(1, recursion.depth), 2, most);
    const std::vector<PairCell>& cells =
        icicle_.of(findings, width, row, [&] { return icicle_cells(recursion, width, row); });

    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("icicle", size);
    ui.mark_only("query.icicle");
    cell_menu(ui, queries, recursion, cells, at);
    const bool hovered = ImGui::IsItemHovered();
    const bool clicked = ImGui::IsItemClicked();
    const int step = ui.workspace.step();
    const int present = recursion.pair_of[static_cast<std::size_t>(step)];
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
    const auto draw = [&](const PairCell& cell, const RecursionPair& pair, ImVec2 min, ImVec2 end, bool past) {
        const float gap = cell.x1 - cell.x0 > 3 && row > 4 ? 1.0f : 0.0f;
        const ImVec2 max{end.x - gap, end.y - gap};
        const float strength = past ? 1 : kIcicleAhead;
        if (pair.has_children()) {
            draw_inner(list, ui.style, min, max, pair, strength);
        } else {
            outcome_cell(list, ui.style, min, max, mark_of(pair), strength);
        }
        if (pair.has_children() && cell.merged == 1) {
            const std::string name =
                node_name(findings->sides[0], pair.a) + "  " + node_name(findings->sides[1], pair.b);
            const ImVec2 text = ImGui::CalcTextSize(name.c_str());
            if (text.x + ui.px(8) < max.x - min.x && text.y <= max.y - min.y) {
                list.AddText({min.x + ui.px(4), 0.5f * (min.y + max.y - text.y)}, past ? ui.style.text : ui.style.quiet,
                             name.c_str());
            }
        }
        if (cell.pair == present) list.AddRect(min, max, ui.style.text, 0, 0, ui.px(2));
    };
    const PairCell* under = draw_cells(recursion, cells, at, step, draw);
    list.PopClipRect();
    if (!hovered || !under) return;
    const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(under->pair)];
    const std::string more = under->merged > 1 ? "\nand " + std::to_string(under->merged - 1) + " more pairs here" : "";
    ImGui::SetTooltip("%s\n%d events here and below%s",
                      step_sentence(findings->sides, ui.workspace.recorded()->trace, pair.last).c_str(),
                      pair.end - pair.first, more.c_str());
    if (clicked) ui.invoke("step.to", std::to_string(pair.last));
}

void QueryPictures::strip(Ui& ui, QueryInspector& queries, float width, float height) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    const int columns = static_cast<int>(width);
    if (!findings || findings->recursion.pairs.empty() || columns < 1) return;
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    const std::vector<StripCell>& cells =
        strip_.of(findings, columns, 0, [&] { return strip_cells(trace, findings->recursion, columns); });

    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("strip", {width, height});
    ui.mark_only("query.strip");
    const auto cell_at = [&](float x) {
        const auto cell =
            std::partition_point(cells.begin(), cells.end() - 1, [&](const StripCell& c) { return at.x + c.x1 <= x; });
        return *cell;
    };
    const int step = ui.workspace.step();
    context_menu(ui, [&] {
        const StripCell cell = cell_at(ImGui::GetMousePosOnOpeningCurrentPopup().x);
        return test_menu(ui.workspace, queries, event_of(cell, step));
    });
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, ui.style.raised);
    const float room = height - ui.px(4);  // the rest is for the marker
    for (const StripCell& cell : cells) {
        draw_cell(list, ui.style, cell, {at.x, at.y + ui.px(4)}, room, cell.first <= step ? 1 : kStripAhead);
    }
    const std::vector<int>& breaks = queries.break_steps();
    for (const StripCell& cell : cells) {
        const auto first = std::ranges::lower_bound(breaks, cell.first);
        if (first == breaks.end() || *first >= cell.end) continue;
        list.AddRectFilled({at.x + cell.x0, at.y}, {at.x + std::max(cell.x1, cell.x0 + ui.px(2)), at.y + ui.px(3)},
                           ui.style.error);
    }
    const auto present =
        std::partition_point(cells.begin(), cells.end(), [&](const StripCell& c) { return c.end <= step; });
    const float x = at.x + 0.5f * (present->x0 + present->x1);
    const float r = ui.px(4);
    list.AddTriangleFilled({x - r, at.y}, {x + r, at.y}, {x, at.y + r}, ui.style.text);
    list.AddLine({x, at.y}, {x, at.y + height}, ui.style.text, ui.px(1.5f));

    const bool active = ImGui::IsItemActive();
    if (!active && !ImGui::IsItemHovered()) return;
    const StripCell cell = cell_at(ImGui::GetIO().MousePos.x);
    ImGui::SetTooltip("%s", tooltip(*findings, trace, cell, step).c_str());
    if (active && event_of(cell, step) != step) ui.invoke("step.to", std::to_string(event_of(cell, step)));
}

}  // namespace mobbscope::app
