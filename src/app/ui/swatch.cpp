#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <explain/query_progress.h>
#include <render/query/query_boxes.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mobbscope::app {

namespace {

/// Diagonal lines inside a rectangle, rising to the right.
void hatch(ImDrawList& list, ImVec2 min, ImVec2 max, ImU32 color, float spacing, float width) {
    // Aligned to the window, not to the cell, so that neighbours go on in each other.
    const int first = static_cast<int>(std::ceil((min.x + min.y) / spacing));
    const int end = static_cast<int>(std::ceil((max.x + max.y) / spacing));
    for (int i = first; i < end; ++i) {
        const float sum = static_cast<float>(i) * spacing;
        const float x0 = std::max(min.x, sum - max.y);
        const float x1 = std::min(max.x, sum - min.y);
        if (x1 > x0) list.AddLine({x0, sum - x0}, {x1, sum - x1}, color, width);
    }
}

/// Level lines inside a rectangle.
void stripes(ImDrawList& list, ImVec2 min, ImVec2 max, ImU32 color, float spacing, float width) {
    // One at the very end is left out, whichever way that is rounded.
    const auto count = static_cast<int>(std::ceil((max.y - min.y) / spacing - 0.51f));
    for (int i = 0; i < count; ++i) {
        const float y = min.y + (static_cast<float>(i) + 0.5f) * spacing;
        list.AddLine({min.x, y}, {max.x, y}, color, width);
    }
}

struct MarkInfo {
    const char* headline;
    BoxState state;  ///< whose colour and line it has in pictures
};
/// In the order of EventMark. A time test that finds common time has no state of its own.
constexpr std::array<MarkInfo, kEventMarks> kMarks{{{"They share time", BoxState::under_test},
                                                    {"Apart in time", BoxState::apart_in_time},
                                                    {"Separated in space", BoxState::separated},
                                                    {"Boxes overlap", BoxState::overlap},
                                                    {"No hit in these samples", BoxState::overlap},
                                                    {"Avoidable overlap", BoxState::avoidable},
                                                    {"Hit", BoxState::hit}}};

const MarkInfo& info(EventMark mark) { return kMarks[static_cast<std::size_t>(mark)]; }

}  // namespace

const char* headline(EventMark mark) { return info(mark).headline; }

ImU32 mark_color(const Style& style, EventMark mark, float strength) {
    const Rgba color = mark == EventMark::shares_time ? style.palette.quiet_text
                                                      : outcome_style(info(mark).state, style.palette).color;
    return to_im(with_alpha(color, strength));
}

ImU32 mark_text(const Style& style, EventMark mark) {
    if (mark == EventMark::shares_time) return style.text;
    return to_im(readable(outcome_style(info(mark).state, style.palette).color, style.palette));
}

void dashed_line(ImDrawList& list, ImVec2 from, ImVec2 to, ImU32 color, float width, float on) {
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    if (length <= 0) return;
    const ImVec2 along{(to.x - from.x) / length, (to.y - from.y) / length};
    const int dashes = static_cast<int>(std::ceil(length / (2 * on)));
    for (int i = 0; i < dashes; ++i) {
        const float at = 2 * on * static_cast<float>(i);
        const float until = std::min(at + on, length);
        list.AddLine({from.x + along.x * at, from.y + along.y * at},
                     {from.x + along.x * until, from.y + along.y * until}, color, width);
    }
}

void outcome_cell(ImDrawList& list, const Style& style, ImVec2 min, ImVec2 max, EventMark mark, float strength) {
    const ImU32 color = mark_color(style, mark, strength);
    const float least = std::min(max.x - min.x, max.y - min.y);
    const bool plain = least < 5 * style.scale;  // too small for a pattern
    const float line = style.scale;
    switch (mark) {
        case EventMark::shares_time:
            list.AddRect(min, max, color, 0, 0, line);
            return;
        case EventMark::apart_in_time: {
            if (plain) {
                list.AddRectFilled(min, max, mark_color(style, mark, 0.5f * strength));
                return;
            }
            const float h = 0.5f * line;
            const float on = 2 * line;
            dashed_line(list, {min.x + h, min.y + h}, {max.x - h, min.y + h}, color, line, on);
            dashed_line(list, {max.x - h, min.y + h}, {max.x - h, max.y - h}, color, line, on);
            dashed_line(list, {max.x - h, max.y - h}, {min.x + h, max.y - h}, color, line, on);
            dashed_line(list, {min.x + h, max.y - h}, {min.x + h, min.y + h}, color, line, on);
            return;
        }
        case EventMark::separated:
            list.AddRectFilled(min, max, color);
            return;
        case EventMark::overlap:
        case EventMark::no_hit:
            if (plain) {
                list.AddRectFilled(min, max, color);
                return;
            }
            list.AddRectFilled(min, max, mark_color(style, mark, 0.25f * strength));
            hatch(list, min, max, color, 5 * line, 1.3f * line);
            list.AddRect(min, max, color, 0, 0, line);
            return;
        case EventMark::avoidable:
            if (plain) {
                list.AddRectFilled(min, max, color);
                return;
            }
            list.AddRectFilled(min, max, mark_color(style, mark, 0.25f * strength));
            stripes(list, min, max, color, 4 * line, 1.6f * line);
            list.AddRect(min, max, color, 0, 0, line);
            return;
        case EventMark::hit:
            list.AddRectFilled(min, max, color);
            if (!plain) {
                const ImU32 cross = to_im(with_alpha(style.palette.background, strength));
                list.AddLine(min, max, cross, 1.5f * line);
                list.AddLine({min.x, max.y}, {max.x, min.y}, cross, 1.5f * line);
            }
            return;
    }
}

void outcome_sign(Ui& ui, EventMark mark, float side) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + 0.5f * (ImGui::GetTextLineHeight() - side);
    outcome_cell(*ImGui::GetWindowDrawList(), ui.style, {at.x, top}, {at.x + side, top + side}, mark, 1);
    ImGui::Dummy({side, ImGui::GetTextLineHeight()});
}

void outcome_legend(Ui& ui) {
    struct Entry {
        EventMark mark;
        const char* text;
    };
    constexpr Entry kEntries[] = {{EventMark::separated, "separated in space"},
                                  {EventMark::apart_in_time, "apart in time"},
                                  {EventMark::overlap, "overlap, no hit"},
                                  {EventMark::avoidable, "avoidable overlap"},
                                  {EventMark::hit, "hit"}};
    ImGui::PushFont(ui.style.caption);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    const float side = ui.px(10);
    bool first = true;
    for (const Entry& entry : kEntries) {
        if (!first) flow(side + ui.px(4) + ImGui::CalcTextSize(entry.text).x);
        first = false;
        ImGui::BeginGroup();
        outcome_sign(ui, entry.mark, side);
        ImGui::SameLine(0, ui.px(4));
        ImGui::TextUnformatted(entry.text);
        ImGui::EndGroup();
    }
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

EventMark mark_of(mobb::TestKind test, mobb::Outcome outcome) {
    switch (outcome) {
        case mobb::Outcome::disjoint_in_time:
            return EventMark::apart_in_time;
        case mobb::Outcome::separated:
            return EventMark::separated;
        case mobb::Outcome::hit:
            return EventMark::hit;
        case mobb::Outcome::no_hit:
            return EventMark::no_hit;
        case mobb::Outcome::overlap:
            break;
    }
    return test == mobb::TestKind::time ? EventMark::shares_time : EventMark::overlap;
}

}  // namespace mobbscope::app
