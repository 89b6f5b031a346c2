#include <app/ui/swatch.h>
#include <app/ui/value_histogram.h>
#include <app/ui/widgets.h>

#include <algorithm>
#include <cmath>

namespace mobbscope::app {

namespace {

// Pixels at scale 1.
constexpr float kBarsHeight = 26;   // height
constexpr float kColorsHeight = 8;  // of colours below them
constexpr float kHandle = 5;        // half its width
constexpr float kLeastRange = 0.01f;

void bars(Ui& ui, const ValueHistogram& shown, ImVec2 at, float width) {
    const float height = ui.px(kBarsHeight), bar = ui.px(kColorsHeight);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    // Few of one value are seen beside many of another.
    const auto length = [](std::size_t count) { return std::sqrt(static_cast<float>(count)); };
    const float most = std::max(1.0f, length(*std::ranges::max_element(shown.counts)));
    const auto all = static_cast<float>(shown.counts.size());
    for (std::size_t i = 0; i < shown.counts.size(); ++i) {
        const float left = at.x + width * static_cast<float>(i) / all;
        const float right = at.x + width * static_cast<float>(i + 1) / all;
        const ImU32 color = to_im(shown.color((static_cast<float>(i) + 0.5f) / all));
        const float top = at.y + height * (1 - length(shown.counts[i]) / most);
        list.AddRectFilled({left, top}, {right, at.y + height}, color);
        list.AddRectFilled({left, at.y + height + ui.px(2)}, {right, at.y + height + ui.px(2) + bar}, color);
    }
}

/// Where it is dragged to; where it stands while it is not.
float handle(Ui& ui, const std::string& mark, float place, ImVec2 at, float width, bool& dragged) {
    const float height = ui.px(kBarsHeight), bar = ui.px(kColorsHeight);
    const float x = at.x + width * std::clamp(place, 0.0f, 1.0f);
    ImGui::SetCursorScreenPos({x - ui.px(kHandle), at.y});
    ImGui::InvisibleButton(mark.c_str(), {2 * ui.px(kHandle), height + bar + ui.px(6)});
    ui.mark_only(mark);
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
    const ImU32 color = lit ? ui.style.accent : ui.style.text;
    const float foot = at.y + height + ui.px(3) + bar;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({x, at.y}, {x, foot}, color, ui.px(1));
    list.AddTriangleFilled({x, foot - ui.px(3)}, {x + ui.px(kHandle), foot + ui.px(4)},
                           {x - ui.px(kHandle), foot + ui.px(4)}, color);
    if (lit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (!ImGui::IsItemActive() || ImGui::GetIO().MouseDelta.x == 0) return place;
    dragged = true;
    return std::clamp((ImGui::GetIO().MousePos.x - at.x) / width, 0.0f, 1.0f);
}

/// The values at the handles, each below its own, and the button that lets go of them; whether it was pressed.
bool ends(Ui& ui, const ValueHistogram& shown, ImVec2 at, float width) {
    const ImFont& font = *ui.style.caption;
    const float of_from = text_size(font, shown.from_text).x, of_to = text_size(font, shown.to_text).x;
    const float gap = ui.px(8), button = button_width("auto") + 2 * gap;
    const float last = std::max(of_from + gap, width - of_to);
    float from = std::clamp(width * shown.from - 0.5f * of_from, 0.0f, last - of_from - gap);
    float to = std::clamp(width * shown.to - 0.5f * of_to, from + of_from + gap, last);
    // The button takes the room between them where it has none beside them.
    if (shown.chosen && std::max({from, to - from - of_from, width - to - of_to}) < button) {
        from = 0;
        to = last;
    }
    const auto go_to = [&](float left) {
        ImGui::SetCursorScreenPos({at.x + left, at.y + ui.px(kBarsHeight + kColorsHeight + 8)});
    };
    go_to(from);
    text_line(ui.style.quiet, shown.from_text, ui.style.caption);
    go_to(to);
    text_line(ui.style.quiet, shown.to_text, ui.style.caption);
    if (!shown.chosen) return false;
    go_to(to - from - of_from >= button ? from + of_from + gap : from >= button ? 0 : to + of_to + gap);
    return small_button(ui, "auto", shown.mark + ".auto", "All values");
}

}  // namespace

float histogram_height(const Ui& ui) { return ui.px(kBarsHeight + kColorsHeight + 8) + ui.style.caption->FontSize; }

HistogramChange value_histogram(Ui& ui, const ValueHistogram& shown, float width) {
    HistogramChange out;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    bars(ui, shown, at, width);
    bool dragged = false;
    const float from = handle(ui, shown.mark + ".from", shown.from, at, width, dragged);
    const float to = handle(ui, shown.mark + ".to", shown.to, at, width, dragged);
    if (dragged) {
        const bool moves_from = from != shown.from;
        out.kind = HistogramChange::Kind::dragged;
        out.ends = {moves_from ? std::max(0.0f, std::min(from, to - kLeastRange)) : from,
                    moves_from ? to : std::min(1.0f, std::max(to, from + kLeastRange))};
    }
    if (ends(ui, shown, at, width)) out.kind = HistogramChange::Kind::automatic;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool over =
        mouse.x >= at.x && mouse.x < at.x + width && mouse.y >= at.y && mouse.y < at.y + ui.px(kBarsHeight);
    if (!over || !ImGui::IsWindowHovered()) return out;
    const auto all = static_cast<float>(shown.counts.size());
    const float part = std::floor((mouse.x - at.x) / width * all);
    const std::size_t count = shown.counts[static_cast<std::size_t>(std::clamp(part, 0.0f, all - 1))];
    ImGui::SetTooltip(
        "%s", (shown.at(part / all) + " to " + shown.at((part + 1) / all) + ": " + std::to_string(count)).c_str());
    return out;
}

}  // namespace mobbscope::app
