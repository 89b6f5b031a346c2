#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/panels/ruler.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <base/sentences.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <explain/trace_comparison.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr const char* kNothing = "nothing";

void choose_what(Ui& ui, QueryInspector& queries) {
    const auto& with = ui.workspace.compare_with;
    const std::string now = !with ? kNothing : !with->fit ? "stored trace" : std::string(info(with->fit->tree).label);
    form_label(ui, "With", "The same query under other trees, or its stored trace");
    if (begin_dropdown(ui, "compare.with", now, "With")) {
        const auto entry = [&](const std::string& label, const std::string& mark, bool is_now) {
            const bool clicked = ImGui::Selectable(label.c_str(), is_now);
            ui.mark("compare.with." + mark, OwnKeys::none, label);
            if (is_now) ui.focus.begin_here();
            return clicked;
        };
        if (entry(kNothing, kNothing, !with)) ui.invoke("compare.none");
        for (const mobb::TreeKind kind : mobb::kTreeKinds) {
            const std::string name(mobb::name(kind));
            if (entry(std::string(info(kind).label), name, with && with->fit && with->fit->tree == kind))
                ui.invoke("compare.with", name);
        }
        if (queries.stored_trace() && entry("stored trace", "stored", with && !with->fit))
            ui.invoke("compare.with", "stored");
        ImGui::EndCombo();
    }
    if (!with || !with->fit) return;
    form_label(ui, "Leaf", "Samples in a leaf of the trees that are compared with");
    const auto leaf = number_field(ui, {.mark = "compare.leaf",
                                        .what = "The samples of a leaf",
                                        .now = static_cast<double>(with->fit->leaf),
                                        .least = 1,
                                        .most = std::numeric_limits<int>::max()});
    if (leaf) ui.invoke("compare.leaf", formatted("%.0f", *leaf));
}

/// For the heads of columns: the kinds of trees, or what else differs.
std::array<std::string, 2> short_names(const std::array<std::string, 2>& names) {
    const auto part = [&](std::size_t side, bool kind) {
        const std::size_t comma = names[side].find(", ");
        if (comma == std::string::npos) return names[side];
        return kind ? names[side].substr(0, comma) : names[side].substr(comma + 2);
    };
    const bool by_kind = part(0, true) != part(1, true);
    return {part(0, by_kind), part(1, by_kind)};
}

/// Tests of both sides and how many more the second made.
void compared_counters(Ui& ui, const std::array<std::string, 2>& names, const mobb::TestCounts& first,
                       const mobb::TestCounts& second) {
    const float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x;
    const auto line = [&](const std::string& label, const std::array<std::string, 3>& cells, ImU32 color,
                          ImFont* font) {
        constexpr std::array kRight{0.6f, 0.8f, 1.0f};
        text_line(ui.style.quiet, label);
        ImGui::PushFont(font);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const std::string text = fitted_text(cells[i], 0.2f * room - ui.px(4));
            ImGui::SameLine(left + kRight[i] * room - ImGui::CalcTextSize(text.c_str()).x);
            text_line(color, text);
            if (!copies_numbers(ui, text, ImGui::GetItemRectMin(), *font)) tell_whole(ui, text, cells[i]);
        }
        ImGui::PopFont();
    };
    const std::array<std::string, 2> heads = short_names(names);
    line("", {heads[0], heads[1], "more"}, ui.style.quiet, ui.style.caption);
    for (const mobb::TestKind test : mobb::kTestKinds) {
        const std::int64_t one = first[test], other = second[test];
        if (one == 0 && other == 0) continue;
        const std::string label = test == mobb::TestKind::time      ? "time tests"
                                  : test == mobb::TestKind::samples ? "sample pairs"
                                                                    : std::string(info(test.box()).title) + " tests";
        line(label,
             {std::to_string(one), std::to_string(other), (other > one ? "+" : "") + std::to_string(other - one)},
             ui.style.text, ui.style.mono);
    }
    ui.mark_only("compare.counters");
}

std::vector<DecisionCell> decision_cells(const std::vector<Decision>& decisions, const mobb::Trace& trace,
                                         const ChartAxis& axis) {
    std::vector<DecisionCell> out;
    for (const Decision& decision : decisions) {
        const float x0 = axis.pixel(decision.t0), x1 = axis.pixel(decision.t1);
        const mobb::Trace::Event event = trace[decision.step];
        const DecisionCell cell{x0, std::max(x1, x0 + 1), decision.depth, mark_of(event.test, event.outcome)};
        if (out.empty() || x1 - out.back().x0 >= 1) {
            out.push_back(cell);
        } else if (cell.depth > out.back().depth) {
            out.back().depth = cell.depth;
            out.back().mark = cell.mark;
        }
    }
    return out;
}

int depth_of(const TraversalComparison& traversals) {
    int out = 0;
    for (const auto& side : traversals.decisions) {
        for (const Decision& decision : side) out = std::max(out, decision.depth);
    }
    return out;
}

/// One side over the common time: each decision stands as deep as it was made.
void decision_strip(Ui& ui, const std::vector<DecisionCell>& cells, ImVec2 corner, ImVec2 size, float row) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, ui.style.raised);
    for (const DecisionCell& cell : cells) {
        const float left = corner.x + cell.x0, wide = corner.x + cell.x1;
        const float right = wide - left > ui.px(3) ? wide - ui.style.scale : wide;
        const float top = corner.y + row * static_cast<float>(cell.depth);
        list.AddRectFilled({left, corner.y}, {right, top}, to_im(with_alpha(ui.style.palette.axis, 0.18f)));
        outcome_cell(list, ui.style, {left, top}, {right, top + row}, cell.mark, 1);
    }
}

/// What both sides decided about a moment.
void moment_words(Ui& ui, const QueryFindings& findings, const FitComparison& other, double moment) {
    const ComparedTime* at = other.traversals.at(moment);
    if (!at) return words(ui.style.quiet, "No test was needed about " + with_unit(moment, "s") + ".");
    words(ui.style.text, "At " + with_unit(moment, "s") + ": " + earlier_words(at->earlier, other.names));
    ui.mark_only("compare.now");
    std::vector<DrawnAgent> sides = findings.sides;
    for (std::size_t side = 0; side < 2; ++side) {
        const Decision& decision = other.traversals.decision(*at, side);
        const mobb::Trace& trace = side == 0 ? ui.workspace.recorded()->trace : other.recorded.trace;
        if (side == 1) {
            for (std::size_t i = 0; i < 2; ++i) sides[i].placed = other.placed[i];
        }
        words(ui, ui.style.quiet,
              other.names[side] + ": depth " + std::to_string(decision.depth) + ", after " +
                  counted(decision.tests, "test", "tests") + "; " + step_sentence(sides, trace, decision.step),
              {trace[decision.step].gap});
    }
}

void compared_stored(Ui& ui, QueryInspector& queries, std::span<const DrawnAgent> sides) {
    const std::shared_ptr<const mobb::Trace> stored = queries.stored_trace();
    if (!stored) return words(ui.style.quiet, "The scene has no stored trace of this query.");
    const mobb::Trace& present = ui.workspace.recorded()->trace;
    const TraceCheck& check = queries.stored_check();
    words(check.agrees() ? ui.style.quiet : ui.style.warning,
          as_sentence(check_words(check, sides, *stored, present) + '.'));
    ui.mark_only("compare.words");
    const SteppedTraces both = traces_at(sides, *stored, present, ui.workspace.step());
    const std::string step = "Step " + std::to_string(ui.workspace.step());
    for (const auto& [whose, found] : {std::pair(", stored: ", &both.stored), std::pair(", now: ", &both.present)})
        words(both.agree ? ui.style.quiet : ui.style.warning, step + whose + *found);
    ui.mark_only("compare.now");
    if (check.difference) query_button(ui, "Go to the first difference", "compare.difference");
    compared_counters(ui, {"stored", "now"}, stored->counts(), present.counts());
}

}  // namespace

void QueryPictures::compare_strips(Ui& ui, QueryInspector& queries, const std::shared_ptr<const FitComparison>& other) {
    const TraversalComparison& traversals = other->traversals;
    const float width = ImGui::GetContentRegionAvail().x;
    const double t0 = traversals.times.front().t0, t1 = traversals.times.back().t1;
    if (compared_.of != other || compared_.width != static_cast<int>(width)) {
        const ChartAxis from_left{t0, t1, 0, width};
        compared_ = {other, static_cast<int>(width), {}, depth_of(traversals)};
        for (std::size_t side = 0; side < 2; ++side) {
            const mobb::Trace& trace = side == 0 ? ui.workspace.recorded()->trace : other->recorded.trace;
            compared_.sides[side] = decision_cells(traversals.decisions[side], trace, from_left);
        }
    }
    const auto rows = static_cast<float>(compared_.depth + 1);
    const float row = std::clamp(ui.px(54) / rows, ui.px(3), ui.px(9));
    const float height = row * rows, label = ui.style.caption->FontSize + ui.px(2);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{width, 2 * (label + height) + ui.px(4)};
    ImGui::InvisibleButton("strips", size);
    ui.mark_only("compare.strips");
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    const ChartAxis axis{t0, t1, at.x, at.x + width};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t side = 0; side < 2; ++side) {
        const float top = at.y + static_cast<float>(side) * (label + height + ui.px(4));
        draw_text(list, *ui.style.caption, {at.x, top}, ui.style.quiet, other->names[side]);
        decision_strip(ui, compared_.sides[side], {at.x, top + label}, {width, height}, row);
    }
    if (const auto moment = queries.compared_moment(); moment && *moment >= t0 && *moment <= t1) {
        const float x = axis.pixel(*moment);
        list.AddLine({x, at.y + label}, {x, at.y + size.y}, ui.style.text, ui.px(1.5f));
    }
    ruler(ui, *ui.style.caption, axis, at.y + size.y, " s");
    ImGui::Dummy({0, ui.style.caption->FontSize + ui.px(4)});
    if (!hovered && !active) return;
    const double time = std::clamp(axis.value(ImGui::GetIO().MousePos.x), t0, t1);
    const ComparedTime& under = *traversals.at(time);
    std::string told = with_unit(time, "s") + ": " + earlier_words(under.earlier, other->names);
    for (std::size_t side = 0; side < 2; ++side) {
        told += "\n" + other->names[side];
        told += ": " + decision_words(traversals.decision(under, side));
    }
    ImGui::SetTooltip("%s", told.c_str());
    ui.hovered_event = traversals.decision(under, 0).step;
    if (active && ui.workspace.view().time != time) ui.invoke("compare.at", formatted("%.17g", time));
}

void QueryPictures::compare(Ui& ui, QueryInspector& queries, const QueryFindings& findings) {
    const auto& with = ui.workspace.compare_with;
    // It may stand far below, and come from the palette.
    if (!std::exchange(compares_, with.has_value()) && with) ImGui::SetScrollHereY(0);
    if (!section(ui, "COMPARE")) return;
    choose_what(ui, queries);
    if (!with) return;
    const std::shared_ptr<const FitComparison> other = queries.comparison();
    if (!other) return compared_stored(ui, queries, findings.sides);
    words(ui, ui.style.text, comparison_words(other->traversals, other->names) + ".");
    ui.mark_only("compare.words");
    if (!other->traversals.times.empty()) {
        compare_strips(ui, queries, other);
        if (const auto moment = queries.compared_moment()) moment_words(ui, findings, *other, *moment);
    }
    compared_counters(ui, other->names, ui.workspace.recorded()->tests, other->recorded.tests);
    recording_note(ui, "compare");
    if (other->recorded.trace.stopped())
        words(ui.style.warning, "Of " + other->names[1] + ' ' + recording_words(other->recorded.trace) + ".");
}

}  // namespace mobbscope::app
