#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <base/sentences.h>
#include <base/text.h>
#include <explain/axis_intervals.h>
#include <explain/clearance.h>
#include <explain/query_sentence.h>
#include <explain/reasons.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

void node_line(Ui& ui, const QueryFindings& findings, std::size_t side, int node) {
    const DrawnAgent& agent = findings.sides[side];
    const mobb::Node& n = agent.placed.node(node);
    const Selection selection{Selection::Kind::node,
                              agent_in_view(ui.workspace.fitted(), ui.workspace.view(), static_cast<int>(side)), node};
    const std::string samples = std::to_string(n.first) + " .. " + std::to_string(n.end() - 1);
    ImGui::PushID(static_cast<int>(side));
    const float left = ImGui::GetCursorPosX();
    const float room = ImGui::GetContentRegionAvail().x;
    const bool selected = ui.workspace.selection == selection;
    ImGui::PushStyleColor(ImGuiCol_Text, to_im(readable(agent.color, ui.style.palette)));
    const std::string name = node_name(agent, node);
    const float name_width = ImGui::CalcTextSize(name.c_str()).x;
    if (ImGui::Selectable((name + "##node").c_str(), selected)) ui.workspace.select(selection);
    ImGui::PopStyleColor();
    ui.mark(side == 0 ? "query.node_a" : "query.node_b");
    if (ImGui::IsItemHovered()) {
        ui.hovered = selection;
        ImGui::SetTooltip("%s, samples %s\nClick to select", name.c_str(), samples.c_str());
    }
    ImGui::PushFont(ui.style.mono);
    const float width = ImGui::CalcTextSize(samples.c_str()).x;
    if (name_width + width + ui.px(12) < room) {
        ImGui::SameLine(left + room - width);
        text_line(ui.style.quiet, samples);
    }
    ImGui::PopFont();
    ImGui::PopID();
}

constexpr std::size_t kFewAxes = 3;
constexpr float kWide = 300;      // pixels at scale 1 from which name, bars and number stand on one line
constexpr float kBar = 5;         // height of a bar
constexpr float kUntried = 0.4f;  // strength of axes that the test did not come to

/// Two intervals on one line of numbers.
struct AxisRow {
    std::string name;
    mobb::Interval a, b;
    double span = 1;  ///< what the width of the bars stands for
    std::string shown;
    double value = 0;
    const char* unit = "m";
    ImU32 color = 0;  ///< of the number
    float strength = 1;
    bool separating = false;
};

/// The two bars, what they share or what lies between them.
void draw_bars(Ui& ui, const QueryFindings& findings, const AxisRow& row, ImVec2 min, ImVec2 max) {
    const double middle = 0.5 * (std::min(row.a.t0, row.b.t0) + std::max(row.a.t1, row.b.t1));
    const auto x = [&](double at) {
        return 0.5f * (min.x + max.x) + static_cast<float>((at - middle) / row.span) * (max.x - min.x);
    };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float bar = ui.px(kBar);
    const float y = 0.5f * (min.y + max.y);
    const auto draw = [&](const mobb::Interval& interval, const DrawnAgent& side, float top) {
        const float x0 = x(interval.t0);
        list.AddRectFilled({x0, top}, {std::max(x(interval.t1), x0 + ui.px(1.5f)), top + bar},
                           to_im(with_alpha(side.color, row.strength)));
    };
    draw(row.a, findings.sides[0], y - bar - ui.px(1));
    draw(row.b, findings.sides[1], y + ui.px(1));
    const double from = std::max(row.a.t0, row.b.t0);
    const double to = std::min(row.a.t1, row.b.t1);
    const float top = y - bar - ui.px(3);
    const float bottom = y + bar + ui.px(3);
    if (from < to) {
        const ImU32 color = to_im(with_alpha(ui.style.palette.quiet_text, 0.8f * row.strength));
        for (const double edge : {from, to})
            dashed_line(list, {x(edge), top}, {x(edge), bottom}, color, ui.px(1), ui.px(2));
    } else if (row.separating) {
        const ImU32 color = row.color;
        list.AddLine({x(to), top}, {x(to), bottom}, color, ui.px(1.5f));
        list.AddLine({x(from), top}, {x(from), bottom}, color, ui.px(1.5f));
        list.AddLine({x(to), y}, {x(from), y}, color, ui.px(1.5f));
    }
}

void draw_row(Ui& ui, const QueryFindings& findings, const AxisRow& row) {
    const float room = ImGui::GetContentRegionAvail().x;
    const bool wide = room >= ui.px(kWide);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight();
    const float inset = ui.px(6);
    const float bars = ui.px(2 * kBar + 8);
    const float height = wide ? std::max(line, bars) + ui.px(4) : line + bars + ui.px(4);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (row.separating) {
        list.AddRectFilled(at, {at.x + room, at.y + height}, mark_color(ui.style, EventMark::separated, 0.1f),
                           ui.px(4));
        list.AddRect(at, {at.x + room, at.y + height}, row.color, ui.px(4), 0, ui.px(1.5f));
    }
    ImGui::PushFont(ui.style.mono);
    const float number_width = ImGui::CalcTextSize(row.shown.c_str()).x;
    const float number_column = std::max(number_width, ImGui::CalcTextSize("apart 0.000 s").x);
    ImGui::PopFont();
    const float text_y = wide ? at.y + 0.5f * (height - line) : at.y + ui.px(2);
    const ImU32 name_color = row.separating ? ui.style.text : ui.style.quiet;
    list.AddText({at.x + inset, text_y}, name_color, row.name.c_str());
    ImGui::SetCursorScreenPos({at.x + room - inset - number_width, text_y});
    number(ui, row.shown, row.value, row.unit, row.color);
    const float name_column = ui.px(104);
    const ImVec2 min{at.x + (wide ? name_column : inset), wide ? at.y : at.y + ui.px(2) + line};
    const ImVec2 max{at.x + room - (wide ? number_column + 2 * inset : inset), at.y + height};
    draw_bars(ui, findings, row, min, max);
    ImGui::SetCursorScreenPos(at);
    ImGui::Dummy({room, height});
}

AxisRow axis_time_row(Ui& ui, const QueryFindings& findings, const mobb::Trace::Event& event) {
    const mobb::PlacedTree& a = findings.sides[0].placed;
    const mobb::PlacedTree& b = findings.sides[1].placed;
    AxisRow row;
    row.name = "time";
    row.a = {a.begin(a.node(event.a)), a.end(a.node(event.a))};
    row.b = {b.begin(b.node(event.b)), b.end(b.node(event.b))};
    row.span = std::max(row.a.t1, row.b.t1) - std::min(row.a.t0, row.b.t0);
    const double gap = std::max(row.a.t0, row.b.t0) - std::min(row.a.t1, row.b.t1);
    const bool apart = event.outcome == mobb::Outcome::disjoint_in_time;
    row.value = apart ? gap : -gap;
    row.unit = "s";
    row.shown =
        apart && gap < mobb::kMinOverlap ? "only touch" : (apart ? "apart " : "share ") + with_unit(row.value, "s");
    row.color = apart ? mark_text(ui.style, EventMark::apart_in_time) : ui.style.text;
    return row;
}

AxisRow axis_row(Ui& ui, const mobb::Trace::Event& event, const AxisInterval& axis, double span, bool tried) {
    AxisRow row;
    row.name = axis.name;
    row.a = {axis.a_min, axis.a_max};
    row.b = {axis.b_min, axis.b_max};
    row.span = span;
    row.separating = axis.axis == event.axis;
    row.strength = tried ? 1 : kUntried;
    // The one that separates has the number that the test found.
    row.value = row.separating ? event.gap : axis.gap;
    row.shown = signed_metres(row.value);
    row.color = row.separating ? mark_text(ui.style, EventMark::separated) : tried ? ui.style.text : ui.style.quiet;
    return row;
}

/// Those behind the axis that separates; eleven of them are better asked for.
void untried_axes(Ui& ui, const QueryFindings& findings, const mobb::Trace::Event& event,
                  std::span<const AxisInterval> axes, double span) {
    if (axes.empty()) return;
    if (axes.size() > kFewAxes) {
        const std::string label = std::to_string(axes.size()) + " axes not tried###untried";
        const bool open = ImGui::TreeNodeEx(label.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen);
        ui.mark("query.untried");
        if (!open) return;
    }
    for (const AxisInterval& axis : axes) draw_row(ui, findings, axis_row(ui, event, axis, span, false));
    if (axes.size() <= kFewAxes) words(ui.style.quiet, "The fainter axes were not tried: one gap is enough.");
}

constexpr std::size_t kMostPairs = 100;

/// The number of a sample in a table: a click asks which tests ended the search for it.
void sample_cell(Ui& ui, int side, int sample, ImU32 color) {
    ImGui::TableNextColumn();
    ImGui::PushID(side);
    ImGui::PushFont(ui.style.mono);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    const std::string text = std::to_string(sample);
    if (ImGui::Selectable((text + "##" + std::to_string(ImGui::TableGetRowIndex())).c_str())) {
        ui.invoke("reasons.of_sample", (side == 0 ? "a " : "b ") + text);
    }
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::PopID();
    ui.mark("sample." + std::string(side == 0 ? "a." : "b.") + text);
    if (!ImGui::IsItemHovered()) return;
    ui.hovered = {Selection::Kind::sample, agent_in_view(ui.workspace.fitted(), ui.workspace.view(), side), sample};
    ui.hovered_event = ui.workspace.step();
    ImGui::SetTooltip("Click for the tests that decided about it");
}

}  // namespace

void current_test(Ui& ui, const QueryFindings& findings) {
    const mobb::Trace::Event event = ui.workspace.recorded()->trace[ui.workspace.step()];
    const EventMark mark = mark_of(ui.workspace.recorded()->trace, findings.recursion, ui.workspace.step());
    if (!section(ui, "THIS TEST", "depth " + std::to_string(event.depth))) return;
    framed(ui, mark_color(ui.style, mark, 0.10f), mark_color(ui.style, mark), [&] {
        outcome_sign(ui, mark, ui.px(12));
        ImGui::SameLine(0, ui.px(7));
        words(mark_text(ui.style, mark), headline(mark));
        words(ui, ui.style.text, as_sentence(outcome_text(findings.sides, event) + '.'), {event.gap, -event.gap});
    });
    ui.mark("query.test");
    node_line(ui, findings, 0, event.a);
    node_line(ui, findings, 1, event.b);
    for (const std::string& ended : ended_words(findings.sides, findings.recursion, ui.workspace.step())) {
        words(ui.style.quiet, ended + '.');
    }
}

void why_axes(Ui& ui, const QueryFindings& findings) {
    const mobb::Trace::Event event = ui.workspace.recorded()->trace[ui.workspace.step()];
    if (section(ui, "IN TIME")) draw_row(ui, findings, axis_time_row(ui, findings, event));
    const std::vector<AxisInterval> axes = axis_intervals(findings.sides, event);
    if (axes.empty() || !section(ui, "ALONG EACH AXIS", "gap, m")) return;
    // All to one scale, so that they can be compared.
    double span = 0;
    for (const AxisInterval& axis : axes) {
        span = std::max(span, std::max(axis.a_max, axis.b_max) - std::min(axis.a_min, axis.b_min));
    }
    const auto separating =
        std::find_if(axes.begin(), axes.end(), [&](const AxisInterval& axis) { return axis.axis == event.axis; });
    const auto tried = static_cast<std::size_t>(separating - axes.begin()) + (separating == axes.end() ? 0 : 1);
    for (std::size_t i = 0; i < tried; ++i) draw_row(ui, findings, axis_row(ui, event, axes[i], span, true));
    untried_axes(ui, findings, event, std::span(axes).subspan(tried), span);
    if (separating == axes.end()) words(ui.style.quiet, "No axis has a gap, so the boxes may meet.");
}

void measured_pairs(Ui& ui, const QueryFindings& findings) {
    const mobb::Trace::Event event = ui.workspace.recorded()->trace[ui.workspace.step()];
    if (event.test != mobb::TestKind::samples || event.pairs.empty()) return;
    const mobb::PlacedClip& a = findings.sides[0].clip();
    const mobb::PlacedClip& b = findings.sides[1].clip();
    const auto radii = [&](const mobb::MeasuredPair& p) { return measured_radii(a, b, p.i, p.j); };
    const auto clearance = [&](const mobb::MeasuredPair& p) { return p.distance - radii(p); };
    const auto least = std::min_element(event.pairs.begin(), event.pairs.end(),
                                        [&](const auto& p, const auto& q) { return clearance(p) < clearance(q); });
    if (!section(ui, "PAIRS OF SAMPLES, METRES", std::to_string(event.pairs.size()))) return;
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ui.px(2), ui.px(1)});
    if (ImGui::BeginTable("pairs", 5, ImGuiTableFlags_SizingStretchProp)) {
        const std::array heads{findings.sides[0].label, findings.sides[1].label, std::string("apart"),
                               std::string("radii"), std::string("clear")};
        for (const std::string& head : heads) {
            ImGui::TableNextColumn();
            fitted_line(ui, ui.style.quiet, head, ImGui::GetContentRegionAvail().x, ui.style.caption);
        }
        const auto row = [&](const mobb::MeasuredPair& p, bool nearest) {
            ImGui::TableNextRow();
            const EventMark mark = clearance(p) < 0 ? EventMark::hit : EventMark::overlap;
            const ImU32 color = nearest ? mark_text(ui.style, mark) : ui.style.text;
            const auto cell = [&](const std::string& shown, double value, const char* unit) {
                ImGui::TableNextColumn();
                number(ui, shown, value, unit, color);
            };
            sample_cell(ui, 0, p.i, color);
            sample_cell(ui, 1, p.j, color);
            cell(formatted("%.3f", p.distance), p.distance, "m");
            cell(formatted("%.3f", radii(p)), radii(p), "m");
            cell(signed_metres(clearance(p)), clearance(p), "m");
            if (nearest) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, mark_color(ui.style, mark, 0.14f));
        };
        const std::size_t shown = std::min(event.pairs.size(), kMostPairs);
        for (std::size_t k = 0; k < shown; ++k) row(event.pairs[k], &event.pairs[k] == &*least);
        if (static_cast<std::size_t>(least - event.pairs.begin()) >= shown) row(*least, true);
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    if (event.pairs.size() > kMostPairs) {
        words(ui.style.quiet, "The first 100 and the nearest of " + std::to_string(event.pairs.size()) + ".");
    }
}

}  // namespace mobbscope::app
