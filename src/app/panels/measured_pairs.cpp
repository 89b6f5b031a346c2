#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>

#include <algorithm>
#include <cstdio>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostPairs = 100;

std::string three_decimals(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", value);
    return text;
}

}  // namespace

void measured_pairs(Ui& ui, const QueryFindings& findings) {
    const mobb::Trace::Event event = ui.session.recorded()->trace[ui.session.step()];
    if (event.test != mobb::TestKind::samples || event.pairs.empty()) return;
    const mobb::PlacedClip& a = findings.sides[0].clip();
    const mobb::PlacedClip& b = findings.sides[1].clip();
    const auto radii = [&](const mobb::MeasuredPair& p) { return a.disk(p.i).r + b.disk(p.j).r; };
    const auto clearance = [&](const mobb::MeasuredPair& p) { return p.distance - radii(p); };
    const auto least = std::min_element(event.pairs.begin(), event.pairs.end(),
                                        [&](const auto& p, const auto& q) { return clearance(p) < clearance(q); });
    heading(ui, "PAIRS OF SAMPLES, METRES", std::to_string(event.pairs.size()));
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ui.px(2), ui.px(1)});
    if (ImGui::BeginTable("pairs", 5, ImGuiTableFlags_SizingStretchProp)) {
        const char* const heads[] = {"A", "B", "apart", "radii", "clear"};
        ImGui::PushFont(ui.style.caption);
        ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
        ImGui::TableNextRow();
        for (const char* head : heads) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(head);
        }
        ImGui::PopStyleColor();
        ImGui::PopFont();
        const auto row = [&](const mobb::MeasuredPair& p, bool nearest) {
            ImGui::TableNextRow();
            const EventMark mark = clearance(p) < 0 ? EventMark::hit : EventMark::overlap;
            const ImU32 color = nearest ? mark_text(ui.style, mark) : ui.style.text;
            ImGui::TableNextColumn();
            number(ui, std::to_string(p.i), p.i, "", color);
            ImGui::TableNextColumn();
            number(ui, std::to_string(p.j), p.j, "", color);
            ImGui::TableNextColumn();
            number(ui, three_decimals(p.distance), p.distance, "m", color);
            ImGui::TableNextColumn();
            number(ui, three_decimals(radii(p)), radii(p), "m", color);
            ImGui::TableNextColumn();
            number(ui, signed_metres(clearance(p)), clearance(p), "m", color);
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
