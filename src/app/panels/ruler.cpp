#include <app/panels/ruler.h>
#include <render/text/labels.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mobbscope::app {

void ruler(const Ui& ui, const ImFont& font, const ChartAxis& axis, float y, const char* unit) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const auto width_of = [&](const std::string& label) { return text_size(font, label + unit).x + ui.px(14); };
    const double step = ruler_step(axis.from, axis.to, axis.last - axis.first, width_of);
    // What is outside is clipped: the outermost stand inside.
    const float left = draw.GetClipRectMin().x;
    const float right = draw.GetClipRectMax().x;
    for (const double value : ticks(axis.from, axis.to, step)) {
        const float x = axis.pixel(value);
        draw.AddLine({x, y}, {x, y + ui.px(4)}, ui.style.quiet, ui.px(1));
        const std::string label = tick_text(value, step) + unit;
        const float width = text_size(font, label).x;
        const float at = std::clamp(x - 0.5f * width, left, std::max(left, right - width));
        draw_text(draw, font, {at, y + ui.px(5)}, ui.style.quiet, label);
    }
}

void height_lines(const Ui& ui, const Rect& area, const ChartAxis& values, const std::string& unit, bool beside,
                  std::optional<double> left_out) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImFont& font = *ui.style.caption;
    const float line = font.FontSize;
    const float height = values.first - values.last;
    // A few are enough, however high the chart is.
    const float room = beside ? std::max(1.3f * line, 0.25f * height) : 2 * line;
    const double step = ruler_step(values.from, values.to, height, [&](const std::string&) { return room; });
    for (const double value : ticks(values.from, values.to, step)) {
        const float y = std::floor(values.pixel(value));
        const std::string label = tick_text(value, step) + unit;
        // Inside a number needs room above its line.
        if (value == left_out || (!beside && y - line < area.min.y)) continue;
        draw.AddLine({area.min.x, y}, {area.max.x, y}, ui.style.border, ui.px(1));
        if (!beside) {
            text_over(ui, area, {area.min.x + ui.px(3), y - line}, ui.style.quiet, label);
            continue;
        }
        const float top = std::clamp(y - 0.5f * line, area.min.y, std::max(area.min.y, area.max.y - line));
        draw_text(draw, font, {area.min.x - ui.px(5) - text_size(font, label).x, top}, ui.style.quiet, label);
    }
}

void text_over(const Ui& ui, const Rect& area, ImVec2 at, ImU32 color, const std::string& text) {
    const ImVec2 size = text_size(*ui.style.caption, text);
    const float x = std::clamp(at.x, area.min.x + 2, std::max(area.min.x + 2, area.max.x - size.x - 2));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({x - 1, at.y}, {x + size.x + 1, at.y + size.y},
                       (ui.style.raised & ~IM_COL32_A_MASK) | 0xB0u << IM_COL32_A_SHIFT);
    draw_text(draw, *ui.style.caption, {x, at.y}, color, text);
}

void time_keys(const Ui& ui, const std::string& mark) {
    for (const Chord& chord : ui.focus.take(mark)) {
        if (chord.key != Key::enter) ui.invoke(chord.key == Key::right ? "time.forward" : "time.back");
    }
}

void scrub_to(const Ui& ui, double time) {
    ui.later([time](Playback& playback, Workspace& workspace) {
        playback.stop();
        workspace.change_view([&](ViewState& view) { view.time = time; });
    });
}

}  // namespace mobbscope::app
