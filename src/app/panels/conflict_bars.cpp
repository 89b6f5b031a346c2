#include <app/panels/panels.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr float kBin = 3;               // width, pixels at scale 1
constexpr float kLeastShare = 0.35f;    // of the height that a bar of one conflict has among fuller ones
constexpr std::size_t kMostToldOf = 6;  // conflicts of a bar

/// The conflicts that begin in one bar, the deepest first.
using Bin = std::vector<int>;

std::string told_of(const std::vector<SceneConflict>& found, const Bin& bin) {
    std::string text;
    for (std::size_t i = 0; i < std::min(bin.size(), kMostToldOf); ++i)
        text += sentence(found[static_cast<std::size_t>(bin[i])]) + '\n';
    if (bin.size() > kMostToldOf) text += "and " + std::to_string(bin.size() - kMostToldOf) + " more\n";
    return text + (bin.size() == 1 ? "Click shows the two alone" : "Click shows the deepest; once more the next one");
}

/// A click on a bar goes from one of its conflicts to the next.
int next_in(const Bin& bin, int shown) {
    const auto at = std::ranges::find(bin, shown);
    return at == bin.end() || at + 1 == bin.end() ? bin.front() : *(at + 1);
}

}  // namespace

void conflict_bars(Ui& ui, const CrowdInspector& crowds, const ChartAxis& time, ImVec2 corner, ImVec2 size) {
    const std::vector<SceneConflict>& found = *crowds.conflicts();
    ImGui::SetCursorScreenPos(corner);
    ImGui::InvisibleButton("##conflicts", size);
    ui.mark_only("timeline.conflicts");
    const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
    const float width = ui.px(kBin);
    std::vector<Bin> bins(static_cast<std::size_t>(size.x / width) + 1);
    const auto bin_at = [&](float x) {
        const auto bin = static_cast<std::ptrdiff_t>((x - corner.x) / width);
        return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(bin, 0, std::ssize(bins) - 1));
    };
    for (std::size_t i = 0; i < found.size(); ++i)
        bins[bin_at(time.pixel(found[i].begin()))].push_back(static_cast<int>(i));
    std::size_t most = 1;
    for (const Bin& bin : bins) most = std::max(most, bin.size());
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + size.x, corner.y + size.y};
    draw.AddRectFilled(corner, end, ui.style.window, ui.px(2));
    const ImU32 color = to_im(ui.style.palette.hit);
    for (std::size_t i = 0; i < bins.size(); ++i) {
        if (bins[i].empty()) continue;
        const float left = corner.x + width * static_cast<float>(i);
        const float share = static_cast<float>(bins[i].size()) / static_cast<float>(most);
        const float height = size.y * (kLeastShare + (1 - kLeastShare) * share);
        const bool is_shown = std::ranges::find(bins[i], ui.workspace.conflict) != bins[i].end();
        const ImVec2 low{left, end.y - height};
        const ImVec2 high{left + width - ui.px(0.5f), end.y};
        draw.AddRectFilled(low, high, is_shown ? ui.style.text : color);
        for (const int conflict : bins[i])
            ui.marks.add("timeline.conflict." + std::to_string(conflict), {{low.x, low.y}, {high.x, high.y}});
    }
    if (!hovered) return;
    // The bar next to the mouse is meant, too.
    const std::size_t under = bin_at(ImGui::GetIO().MousePos.x);
    for (const std::size_t i : {under, under > 0 ? under - 1 : under, std::min(under + 1, bins.size() - 1)}) {
        if (bins[i].empty()) continue;
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        ImGui::SetTooltip("%s", told_of(found, bins[i]).c_str());
        if (clicked) ui.invoke("conflicts.go", std::to_string(next_in(bins[i], ui.workspace.conflict)));
        return;
    }
}

}  // namespace mobbscope::app
