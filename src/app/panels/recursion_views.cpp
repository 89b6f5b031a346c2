#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/thing_menus.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <explain/reasons.h>
#include <render/text/labels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

constexpr float kOutOfFocus = 0.1f;  // strength of what is not in the focus

/// The pair of the event that is under the mouse in any panel.
std::optional<int> hovered_pair(const Workspace& workspace, const Recursion& recursion) {
    const int event = workspace.hovered_event;
    if (event < 0 || event >= static_cast<int>(recursion.pair_of.size())) return std::nullopt;
    return recursion.pair_of[static_cast<std::size_t>(event)];
}

EventRange shown_range(const Workspace& workspace) {
    return workspace.look.zoom.value_or(EventRange{0, workspace.recorded()->trace.size()});
}

constexpr int kLeastZoom = 8;         // events
constexpr double kZoomANotch = 1.25;  // of the wheel

/// The range with so many events, `first` within all of them.
EventRange range_at(double first, int size, int events) {
    const int from = static_cast<int>(std::lround(std::clamp(first, 0.0, static_cast<double>(events - size))));
    return {from, from + size};
}

void set_zoom(Ui& ui, const EventRange& range, int events) {
    ui.later([range, events](Workspace& workspace) {
        workspace.look.zoom = range.size() < events ? std::optional(range) : std::nullopt;
    });
}

/// The wheel over the last widget, which shows a range of the events from `left` on, zooms around the mouse.
void zoom_by_wheel(Ui& ui, const EventRange& range, int events, float left, float width) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!ImGui::IsItemHovered() || io.MouseWheel == 0 || io.KeyShift) return;
    const double share = std::clamp((io.MousePos.x - left) / width, 0.0f, 1.0f);
    const double wanted = range.size() * std::pow(kZoomANotch, -io.MouseWheel);
    const int size =
        static_cast<int>(std::lround(std::clamp(wanted, std::min<double>(kLeastZoom, events), double(events))));
    set_zoom(ui, range_at(range.first + share * (range.size() - size), size, events), events);
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

/// The tests of a pair, as a second level in the lower part of its span where they are wide enough.
class IcicleTests {
  public:
    IcicleTests(const mobb::Trace& trace, const Recursion& recursion, float left, float each, int first, int row,
                float least)
        : trace_(trace), recursion_(recursion), left_(left), each_(each), first_(first), row_(row), least_(least) {}

    /// How much of a pair's span its tests take.
    float height_of(const RecursionPair& pair) const { return are_shown(pair) ? height() : 0; }
    float x(int event) const { return left_ + each_ * static_cast<float>(event - first_); }
    void draw(ImDrawList& list, const Style& style, const RecursionPair& pair, ImVec2 max, float strength) const {
        if (!are_shown(pair)) return;
        const float top = max.y - height();
        for (int event = pair.first; event <= pair.last; ++event) {
            list.AddRectFilled({x(event), top}, {x(event + 1) - 1, max.y},
                               mark_color(style, mark_of(trace_, recursion_, event), strength));
        }
        list.AddLine({x(pair.first), top}, {x(pair.last + 1) - 1, top}, style.window, style.scale);
    }
    /// The test that is at a place, `y` from the first row's top; elsewhere in the span the last one.
    int event_at(const RecursionPair& pair, ImVec2 place) const {
        const float bottom = static_cast<float>((pair.depth + 1) * row_);
        if (!are_shown(pair) || place.y < bottom - height() || place.x >= x(pair.last + 1)) return pair.last;
        return std::clamp(first_ + static_cast<int>((place.x - left_) / each_), pair.first, pair.last);
    }

  private:
    bool are_shown(const RecursionPair& pair) const {
        return each_ >= least_ && (pair.last > pair.first || pair.has_children());
    }
    float height() const { return std::floor(0.3f * static_cast<float>(row_)); }

    const mobb::Trace& trace_;
    const Recursion& recursion_;
    float left_, each_;
    int first_, row_;
    float least_;
};

/// Both nodes with their owners' names, or with less room without; on a filling that it can be read on.
void draw_label(Ui& ui, const QueryFindings& findings, const RecursionPair& pair, ImVec2 min, ImVec2 max, bool past) {
    if (!pair.has_children() && pair.outcome == mobb::Outcome::overlap) return;
    const float room = max.x - min.x - ui.px(8);
    const auto without_name = [](const std::string& name) { return name.substr(name.rfind(' ') + 1); };
    const std::string a = node_name(findings.sides[0], pair.a);
    const std::string b = node_name(findings.sides[1], pair.b);
    const std::string named = a + " / " + b;
    const std::string bare = without_name(a) + " / " + without_name(b);
    for (const std::string& label : {named, bare}) {
        const ImVec2 text = text_size(*ui.style.caption, label);
        if (text.x > room || text.y > max.y - min.y) continue;
        ImU32 ink = past ? ui.style.text : ui.style.quiet;
        const bool is_filled =
            !pair.has_children() && (pair.outcome == mobb::Outcome::separated || pair.outcome == mobb::Outcome::hit);
        if (is_filled && past) ink = to_im(Rgba(0, 0, 0, 1));
        return draw_text(*ImGui::GetWindowDrawList(), *ui.style.caption, {min.x + ui.px(4), min.y + ui.px(1)}, ink,
                         label);
    }
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

void way_to_pair(Ui& ui, const QueryFindings& findings) {
    const int pair = findings.recursion.pair_of[static_cast<std::size_t>(ui.workspace.step())];
    std::vector<int> chain;
    for (int at = pair; at >= 0; at = findings.recursion.pairs[static_cast<std::size_t>(at)].parent)
        chain.push_back(at);
    std::ranges::reverse(chain);
    ImGui::PushFont(ui.style.caption);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(2), ui.px(1)});
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32_BLACK_TRANS);
    const auto label = [&](int at) {
        const RecursionPair& of = findings.recursion.pairs[static_cast<std::size_t>(at)];
        return node_name(findings.sides[0], of.a) + " / " + node_name(findings.sides[1], of.b);
    };
    const float between = button_width(">");
    const auto room_of = [&](int at) { return button_width(label(at).c_str()) + between; };
    // The present one comes first, then the root, then those above the present one.
    const float width = ImGui::GetContentRegionAvail().x;
    std::size_t from = chain.size() - 1;
    const bool with_root = from == 0 || room_of(chain.front()) + room_of(chain.back()) + between <= width;
    float room = width - room_of(chain.back()) - between - (with_root ? room_of(chain.front()) : 0);
    while (from > 1 && room_of(chain[from - 1]) <= room) room -= room_of(chain[--from]);
    const auto crumb = [&](std::size_t i) {
        if (i > 0) {
            if (with_root) ImGui::SameLine(0, 0);
            text_line(ui.style.quiet, i == from && (from > 1 || !with_root) ? " \u2026 " : " \u203A ");
            ImGui::SameLine(0, 0);
        }
        const RecursionPair& of = findings.recursion.pairs[static_cast<std::size_t>(chain[i])];
        ImGui::PushStyleColor(ImGuiCol_Text, i + 1 == chain.size() ? ui.style.text : ui.style.quiet);
        const std::string mark = "crumb." + std::to_string(i);
        ImGui::PushID(static_cast<int>(i));
        if (small_button(ui, label(chain[i]).c_str(), mark)) ui.invoke("step.to", std::to_string(of.last));
        ImGui::PopID();
        ImGui::PopStyleColor();
        if (ImGui::IsItemHovered()) ui.hovered_event = of.last;
    };
    if (with_root) crumb(0);
    for (std::size_t i = std::max<std::size_t>(from, 1); i < chain.size(); ++i) crumb(i);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

void QueryPictures::stay() {
    const float top = ImGui::GetCursorPosY();
    const float moved = top - std::exchange(top_, top);
    // The click may still be held.
    if (moved == 0 || !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) return;
    if (ImGui::GetIO().MousePos.y > ImGui::GetCursorScreenPos().y - moved)
        ImGui::SetScrollY(ImGui::GetScrollY() + moved);
}

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
        queries.findings(), {size, size}, [&] { return square_cells(recursion, square.a, square.b, size, size); });
    cell_menu(ui, queries, recursion, cells, square.min);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(square.min, square.max, ui.style.raised);
    const int step = ui.workspace.step();
    const int present = recursion.pair_of[static_cast<std::size_t>(step)];
    const ShownEvents shown{{0, static_cast<int>(recursion.pair_of.size())}, &queries.in_focus()};
    // Later cells lie in earlier ones: the last that the mouse is in is the smallest.
    const PairCell* under = draw_cells(
        recursion, cells, square.min, step,
        [&](const PairCell& cell, const RecursionPair& pair, ImVec2 min, ImVec2 max, bool past) {
            const float strength = !shown.has(pair.last) ? kOutOfFocus : past ? 1 : kSquareAhead;
            if (pair.has_children()) {
                list.AddRect(min, max, to_im(with_alpha(ui.style.palette.axis, 0.6f * strength)), 0, 0, ui.style.scale);
                if (pair.avoidable) avoidable_corner(list, ui.style, min, max, strength);
            } else {
                const float gap = cell.x1 - cell.x0 > 4 ? 1.0f : 0.0f;
                outcome_cell(list, ui.style, min, {max.x - gap, max.y - gap}, mark_of(pair), strength);
            }
        });
    common_time(list, ui.style, square);
    // However small a pair is, its outline is seen.
    const auto outline = [&](int of, ImU32 color) {
        const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(of)];
        const ImVec2 first{square.x.pixel(pair.time_a.t0), square.y.pixel(pair.time_b.t0)};
        const ImVec2 last{square.x.pixel(pair.time_a.t1), square.y.pixel(pair.time_b.t1)};
        const ImVec2 middle{0.5f * (first.x + last.x), 0.5f * (first.y + last.y)};
        const float half_x = std::max(ui.px(4), last.x - middle.x + ui.px(1));
        const float half_y = std::max(ui.px(4), first.y - middle.y + ui.px(1));
        list.AddRect({middle.x - half_x, middle.y - half_y}, {middle.x + half_x, middle.y + half_y}, color, 0, 0,
                     ui.px(2));
    };
    if (const auto pair = hovered_pair(ui.workspace, recursion)) outline(*pair, ui.style.accent);
    outline(present, ui.style.text);
    if (const auto& point = ui.workspace.look.point) {
        list.AddCircle({square.x.pixel(point->time_a), square.y.pixel(point->time_b)}, ui.px(4), ui.style.text, 0,
                       ui.px(1.5f));
    }
    const auto line = proof_intervals(ui, findings, square);
    axis_labels(ui, findings, square);
    ImGui::SetCursorScreenPos({at.x, square.max.y + label});
    ImGui::Dummy({0, 0});
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double time_a = square.x.value(mouse.x);
    if (hovered && line) {
        ImGui::SetTooltip("%s", tile_words(findings.sides, findings.proof, *line).c_str());
        // The time cursor selects the line.
        if (clicked) ui.invoke("reasons.at", formatted("%.17g", time_a));
        return;
    }
    if (!hovered || !under) return;
    const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(under->pair)];
    ui.hovered_event = pair.last;
    const std::string more =
        under->merged > 1 ? "\nand " + std::to_string(under->merged - 1) + " smaller pairs here" : "";
    ImGui::SetTooltip("%s%s", step_sentence(findings.sides, ui.workspace.recorded()->trace, pair.last).c_str(),
                      more.c_str());
    if (!clicked) return;
    ui.invoke("step.to", std::to_string(pair.last));
    const double time_b = square.y.value(mouse.y);
    // On the diagonal both are one moment.
    if (std::abs(square.y.pixel(time_a) - mouse.y) < ui.px(5)) {
        ui.invoke("reasons.at", formatted("%.17g", time_a));
    } else {
        ui.invoke("reasons.of_point", formatted("%.17g %.17g", time_a, time_b));
    }
}

void QueryPictures::shift_icicle(Ui& ui, const EventRange& range, int count, float width, float most_scroll) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActivated()) held_ = {range, scroll_};
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
        const ImVec2 by = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left);
        const double first = held_.range.first - static_cast<double>(by.x / width) * held_.range.size();
        const EventRange wanted = range_at(first, held_.range.size(), count);
        if (wanted != range) set_zoom(ui, wanted, count);
        scroll_ = held_.scroll - by.y;
    }
    if (ImGui::IsItemHovered() && io.KeyShift) scroll_ -= io.MouseWheel * ui.px(30);
    scroll_ = std::clamp(scroll_, 0.0f, most_scroll);
}

void QueryPictures::icicle(Ui& ui, QueryInspector& queries, ImVec2 size) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    const int width = static_cast<int>(size.x);
    if (!findings || findings->recursion.pairs.empty() || width < 1) return;
    const Recursion& recursion = findings->recursion;
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    const int count = trace.size();
    const int step = ui.workspace.step();
    const int present = recursion.pair_of[static_cast<std::size_t>(step)];
    const EventRange range = shown_range(ui.workspace);
    const ShownEvents shown{range, &queries.in_focus()};
    const float event_width = size.x / static_cast<float>(range.size());
    const bool zoomed = ui.workspace.look.zoom.has_value();
    const int row = icicle_row(size.y, recursion.depth, ui.style.scale, zoomed ? event_width : 0);
    const std::vector<PairCell>& cells = icicle_.of(findings, {width, row, range, ui.workspace.look.focus},
                                                    [&] { return icicle_cells(recursion, shown, width, row); });

    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("icicle", size);
    ui.mark_only("query.icicle");
    const float most_scroll = std::max(0.0f, static_cast<float>(row * recursion.depth) - size.y);
    const int depth = recursion.pairs[static_cast<std::size_t>(present)].depth;
    if (std::exchange(followed_, step) != step) {
        scroll_ = std::clamp(scroll_, static_cast<float>((depth + 1) * row) - size.y, static_cast<float>(depth * row));
        if (step < range.first || step >= range.end) {
            set_zoom(ui, range_at(step - 0.5 * range.size(), range.size(), count), count);
        }
    }
    shift_icicle(ui, range, count, size.x, most_scroll);
    zoom_by_wheel(ui, range, count, corner.x, size.x);
    const ImVec2 at{corner.x, corner.y - std::floor(scroll_)};
    cell_menu(ui, queries, recursion, cells, at);
    const bool hovered = ImGui::IsItemHovered();
    const bool held = ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left);
    const ImGuiIO& io = ImGui::GetIO();
    const float reach = io.MouseDragThreshold;
    const bool clicked = ImGui::IsItemDeactivated() && io.MouseDragMaxDistanceSqr[0] < reach * reach;
    const IcicleTests tests{trace, recursion, at.x, event_width, range.first, row, ui.px(5)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
    const auto draw = [&](const PairCell& cell, const RecursionPair& pair, ImVec2 min, ImVec2 end, bool past) {
        const float gap = cell.x1 - cell.x0 > 3 && row > 4 ? 1.0f : 0.0f;
        const ImVec2 max{end.x - gap, end.y - gap};
        const float strength = past ? 1 : kIcicleAhead;
        if (pair.has_children()) {
            draw_inner(list, ui.style, min, max, pair, strength);
        } else {
            outcome_cell(list, ui.style, min, max, mark_of(pair), strength);
        }
        if (cell.merged > 1) return;
        tests.draw(list, ui.style, pair, max, past ? 1 : kIcicleAhead);
        draw_label(ui, *findings, pair, min, {max.x, max.y - tests.height_of(pair)}, past);
    };
    const PairCell* under = draw_cells(recursion, cells, at, step, draw);
    const auto outline = [&](int of, ImU32 color) {
        const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(of)];
        const float x0 = tests.x(pair.first);
        const float y0 = at.y + static_cast<float>(pair.depth * row);
        list.AddRect({x0, y0}, {std::max(tests.x(pair.end), x0 + 2) - 1, y0 + static_cast<float>(row) - 1}, color, 0, 0,
                     ui.px(2));
    };
    if (const auto pair = hovered_pair(ui.workspace, recursion)) outline(*pair, ui.style.accent);
    outline(present, ui.style.text);
    if (most_scroll > 0) {
        const float whole = static_cast<float>(row * recursion.depth);
        const float right = corner.x + size.x;
        const float top = corner.y + scroll_ / whole * size.y;
        list.AddRectFilled({right - ui.px(3), top}, {right, top + size.y / whole * size.y}, ui.style.quiet, ui.px(1));
    }
    list.PopClipRect();
    if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) set_zoom(ui, {0, count}, count);
    if (!hovered || !under || held) return;
    const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(under->pair)];
    const int event = under->merged > 1 ? pair.last : tests.event_at(pair, {io.MousePos.x, io.MousePos.y - at.y});
    ui.hovered_event = event;
    const std::string more = under->merged > 1 ? "\nand " + std::to_string(under->merged - 1) + " more pairs here" : "";
    const std::string ended = how_it_ended(recursion, under->pair);
    ImGui::SetTooltip("%s\n%d events here and below%s%s%s", step_sentence(findings->sides, trace, event).c_str(),
                      pair.end - pair.first, ended.empty() ? "" : ": ", ended.c_str(), more.c_str());
    if (clicked) ui.invoke("step.to", std::to_string(event));
}

void QueryPictures::strip(Ui& ui, QueryInspector& queries, float width, float height) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    const int columns = static_cast<int>(width);
    if (!findings || findings->recursion.pairs.empty() || columns < 1) return;
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    const EventRange range = shown_range(ui.workspace);
    const std::vector<StripCell>& cells = strip_.of(findings, {columns, 0, range, ui.workspace.look.focus}, [&] {
        return strip_cells(trace, findings->recursion, {range, &queries.in_focus()}, columns);
    });

    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("strip", {width, height});
    ui.mark_only("query.strip");
    zoom_by_wheel(ui, range, trace.size(), at.x, width);
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
    const auto marker = [&](int event, ImU32 color) {
        if (event < range.first || event >= range.end) return;
        const auto cell =
            std::partition_point(cells.begin(), cells.end(), [&](const StripCell& c) { return c.end <= event; });
        const float x = at.x + 0.5f * (cell->x0 + cell->x1);
        const float r = ui.px(4);
        list.AddTriangleFilled({x - r, at.y}, {x + r, at.y}, {x, at.y + r}, color);
        list.AddLine({x, at.y}, {x, at.y + height}, color, ui.px(1.5f));
    };
    marker(ui.workspace.hovered_event, ui.style.accent);
    marker(step, ui.style.text);

    const bool active = ImGui::IsItemActive();
    if (!active && !ImGui::IsItemHovered()) return;
    const StripCell cell = cell_at(ImGui::GetIO().MousePos.x);
    ui.hovered_event = event_of(cell, step);
    ImGui::SetTooltip("%s", tooltip(*findings, trace, cell, step).c_str());
    if (active && event_of(cell, step) != step) ui.invoke("step.to", std::to_string(event_of(cell, step)));
}

}  // namespace mobbscope::app
