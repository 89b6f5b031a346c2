#include <app/commands/command.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <review/review_panels.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

using picture_tests::CaseOutcome;

std::string sum_of(const Review& review) {
    const auto left = std::ranges::count_if(review.cases(), [](const ReviewCase& one) { return !one.drawn(); });
    std::string out;
    if (left < std::ssize(review.cases())) out = picture_tests::sum_of(review.summary());
    if (left > 0)
        out += (out.empty() ? "" : ", ") + std::to_string(left) +
               (review.run.drawing()      ? " to draw"
                : review.output().empty() ? " not drawn"
                                          : " not in the report");
    return out;
}

std::string outcome_word(const ReviewCase& one) {
    if (one.state == ReviewCase::State::waiting) return "waits";
    if (one.state == ReviewCase::State::not_drawn) return "not drawn";
    if (one.accepted) return "accepted";
    switch (one.outcome()) {
        case CaseOutcome::passed:
            return "passed";
        case CaseOutcome::different:
            return "differs";
        case CaseOutcome::missing_golden:
            return "no golden";
        case CaseOutcome::failed:
            return one.result.message.find("crashed") != std::string::npos ? "crashed" : "refused";
        case CaseOutcome::skipped:
            return "skipped";
    }
    return "";
}

std::string outcome_words(const ReviewCase& one) {
    std::string out = outcome_word(one);
    const auto& figures = one.result.image;
    if (!one.drawn() || one.accepted || !figures) return out;
    if (!figures->same_size) return out + ", another size";
    const bool differs = one.outcome() == CaseOutcome::different;
    // The pixels are alike, but the numbers are not.
    if (differs && one.result.findings.size() == 1 && one.result.findings.front().golden.extension() == ".json") {
        return out + " in numbers";
    }
    if (!differs && figures->differing == 0) return out;
    return out + ", " + std::to_string(figures->differing) + " px, up to " + std::to_string(figures->largest);
}

ImU32 outcome_color(const Style& style, const ReviewCase& one) {
    if (!one.drawn()) return style.quiet;
    switch (one.outcome()) {
        case CaseOutcome::passed:
            return style.palette.dark ? to_im(style.palette.separated) : IM_COL32(0, 110, 80, 255);
        case CaseOutcome::different:
        case CaseOutcome::missing_golden:
            return style.warning;
        case CaseOutcome::failed:
            return style.error;
        case CaseOutcome::skipped:
            break;
    }
    return style.quiet;
}

void outcome_shape(ImDrawList& list, const Style& style, ImVec2 middle, float side, const ReviewCase& one) {
    const ImU32 color = outcome_color(style, one);
    const float r = side / 2;
    const float line = std::max(1.5f, side / 7);
    const auto stroke = [&](float x0, float y0, float x1, float y1) {
        list.AddLine({middle.x + x0 * r, middle.y + y0 * r}, {middle.x + x1 * r, middle.y + y1 * r}, color, line);
    };
    if (one.state == ReviewCase::State::waiting) return list.AddCircle(middle, r * 0.8f, color, 0, line * 0.7f);
    if (one.state == ReviewCase::State::not_drawn) return list.AddCircleFilled(middle, r * 0.3f, color);
    switch (one.outcome()) {
        case CaseOutcome::passed:
            stroke(-0.9f, 0.05f, -0.25f, 0.75f);
            stroke(-0.3f, 0.75f, 0.9f, -0.7f);
            break;
        case CaseOutcome::different:
            stroke(-0.9f, -0.35f, 0.9f, -0.35f);
            stroke(-0.9f, 0.35f, 0.9f, 0.35f);
            stroke(-0.45f, 0.95f, 0.45f, -0.95f);
            break;
        case CaseOutcome::missing_golden:
            list.AddCircle(middle, r * 0.75f, color, 0, line);
            stroke(-0.8f, 0.95f, 0.8f, -0.95f);
            break;
        case CaseOutcome::failed:
            stroke(-0.8f, -0.8f, 0.8f, 0.8f);
            stroke(-0.8f, 0.8f, 0.8f, -0.8f);
            break;
        case CaseOutcome::skipped:
            stroke(-0.8f, 0, 0.8f, 0);
            break;
    }
}

namespace {

/// Two lines: the name, and below what came of it. At the left a box to mark it by, its shape beside.
void case_row(Ui& ui, const Review& review, std::size_t index, float height, const NameList& names) {
    const ReviewCase& one = review.cases()[index];
    const std::string mark = "case." + one.file.name;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float box = ui.px(13);
    const float pad = ui.px(7);
    ImGui::PushID(mark.c_str());
    ImGui::SetItemAllowOverlap();
    const bool clicked = ImGui::InvisibleButton("##case", {width, height});
    ui.mark(mark);
    const bool hovered = ImGui::IsItemHovered();
    const bool shown = index == review.current();
    if (shown) ui.focus.begin_here();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + width, corner.y + height};
    if (shown || hovered) draw.AddRectFilled(corner, end, shown ? ui.style.raised : ui.style.border, ui.px(4));
    if (shown) draw.AddRectFilled(corner, {corner.x + ui.px(2), end.y}, ui.style.accent, ui.px(1));

    const ImVec2 box_min{corner.x + pad, corner.y + (height - box) / 2};
    const ImVec2 box_max{box_min.x + box, box_min.y + box};
    const float beyond = corner.x + 2 * pad + box;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool over_box = hovered && mouse.x < beyond;
    ui.marks.add(mark + ".mark", {{box_min.x, box_min.y}, {box_max.x, box_max.y}});
    // What can be accepted can be marked for it; of others the box is there to take the mark away.
    const bool has_box = one.marked || hovered || review.why_not_accept(index).empty();
    if (has_box) draw.AddRect(box_min, box_max, over_box ? ui.style.accent : ui.style.quiet, ui.px(3));
    if (one.marked) {
        draw.AddRectFilled({box_min.x + ui.px(3), box_min.y + ui.px(3)}, {box_max.x - ui.px(3), box_max.y - ui.px(3)},
                           ui.style.accent, ui.px(2));
    }
    const float side = ui.px(12);
    outcome_shape(draw, ui.style, {beyond + side / 2, corner.y + height / 2}, side, one);
    const float left = beyond + side + pad;
    const float line = ImGui::GetTextLineHeight();
    const float top = corner.y + (height - 2 * line) / 2;
    const float room = end.x - pad - left;
    const std::string name = fitted_name(one.file.name, room, names);
    const bool is_left_out = one.state == ReviewCase::State::not_drawn && !review.output().empty();
    const std::string whole_outcome = is_left_out ? "not in the report" : outcome_words(one);
    const std::string outcome = fitted_text(whole_outcome, room);
    draw.AddText({left, top}, ui.style.text, name.c_str());
    draw.AddText({left, top + line}, one.drawn() ? outcome_color(ui.style, one) : ui.style.quiet, outcome.c_str());
    if (hovered && over_box) ImGui::SetTooltip("Marks the case, to accept it with others (M)");
    if (!over_box) tell_whole(ui, name + "   " + outcome, one.file.name + "   " + whole_outcome);
    ImGui::PopID();
    if (!clicked) return;
    const bool marks = over_box || ImGui::GetIO().KeyCtrl;
    ui.invoke(marks ? "review.mark" : "review.show", one.file.name);
}

/// How far a run is stands in the status bar.
void run_row(Ui& ui, const Review& review) {
    if (review.run.drawing()) {
        command_button(ui, "Stop drawing", "review.cancel", "review.cancel");
    } else {
        command_button(ui, "Draw all again", "review.draw_all", "review.draw_all");
    }
}

void order_and_filter(Ui& ui, const Review& review) {
    bool failed_only = review.look.failed_only;
    if (ImGui::Checkbox("Only failing", &failed_only)) ui.invoke("review.failed_only");
    ui.mark("review.failed_only");
    const std::string now(kReviewOrders[static_cast<std::size_t>(review.look.order)]);
    flow(ui.px(112));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    if (!begin_dropdown(ui, "review.order", "by " + now, "Order")) return;
    for (const std::string_view order : kReviewOrders) {
        const std::string name(order);
        if (ImGui::Selectable(("by " + name).c_str(), name == now)) ui.invoke("review.order", name);
        ui.mark("review.order." + name);
        if (name == now) ui.focus.begin_here();
    }
    ImGui::EndCombo();
}

}  // namespace

void review_list(Ui& ui, const Review& review) {
    heading(ui, "PICTURE TESTS", counted(review.cases().size(), "case", "cases"));
    words(ui.style.quiet, sum_of(review));
    ui.mark_only("review.sum");
    run_row(ui, review);
    order_and_filter(ui, review);
    ImGui::Dummy({0, ui.px(2)});

    const std::vector<std::size_t> rows = review.listed();
    const float height = 2 * ImGui::GetTextLineHeight() + ui.px(8);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.px(1)});
    ImGui::BeginChild("rows", {0, 0}, false, ImGuiWindowFlags_NoBackground);
    // What is shown is in view when it changes.
    int& last = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), -1);
    const auto at = std::ranges::find(rows, review.current());
    if (std::exchange(last, static_cast<int>(review.current())) != last && at != rows.end()) {
        const float row = height + ui.px(1);
        const float top = static_cast<float>(at - rows.begin()) * row;
        const float view = ImGui::GetWindowHeight();
        if (top < ImGui::GetScrollY()) ImGui::SetScrollY(top);
        if (top + row > ImGui::GetScrollY() + view) ImGui::SetScrollY(top + row - view);
    }
    const NameList names(review.cases().size(), [&](std::size_t i) { return review.cases()[i].file.name; });
    clipped_rows(ui, "cases", static_cast<int>(rows.size()), height + ui.px(1),
                 [&](int i) { case_row(ui, review, rows[static_cast<std::size_t>(i)], height, names); });
    ImGui::EndChild();
    ImGui::PopStyleVar();
}

void review_way_back(Ui& ui) {
    const std::string& name = ui.session.files.visited();
    if (name.empty()) return;
    heading(ui, "PICTURE TEST");
    words(ui.style.text, name);
    command_button(ui, "Back to the picture tests", "review.back", "review.back");
}

}  // namespace mobbscope::app
