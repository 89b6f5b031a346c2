#include <app/panels/query_parts.h>
#include <app/ui/widgets.h>
#include <explain/query_findings.h>

#include <array>

namespace mobbscope::app {

namespace {

struct Counter {
    const char* label;
    const char* doc;
    std::int64_t (*of)(const StepCounts&);
    bool beyond_the_paper = false;  ///< shown only where there was one
};

constexpr std::array<Counter, 7> kCounters{{
    {"time tests", "Do two nodes share time?", [](const StepCounts& c) { return c.tests.time; }},
    {"2D box tests", "Four axes on the floor", [](const StepCounts& c) { return c.tests.obb2d; }},
    {"3D box tests", "Up to fifteen axes in space-time", [](const StepCounts& c) { return c.tests.obb3d; }},
    {"moving box tests", "Four axes on the floor, at both ends of the common time",
     [](const StepCounts& c) { return c.tests.moving; }, true},
    {"AABB tests", "The world's x and y", [](const StepCounts& c) { return c.tests.aabb; }, true},
    {"sample pairs", "Pairs of disks whose distance was measured", [](const StepCounts& c) { return c.tests.samples; }},
    {"wasted", "Box tests that found an overlap which led to no hit", [](const StepCounts& c) { return c.wasted; }},
}};

void right_aligned(const std::string& text, float right, ImU32 color) {
    ImGui::SameLine(right - ImGui::CalcTextSize(text.c_str()).x);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

}  // namespace

void query_counters(Ui& ui, const QueryFindings& findings) {
    heading(ui, "TESTS");
    const StepCounts total = findings.recursion.total();
    const StepCounts now = findings.recursion.so_far.empty()
                               ? StepCounts{}
                               : findings.recursion.so_far[static_cast<std::size_t>(ui.session.step())];
    const float left = ImGui::GetCursorPosX();
    const float room = ImGui::GetContentRegionAvail().x;
    const float first = left + 0.68f * room;
    const float second = left + room;
    ImGui::PushFont(ui.style.caption);
    ImGui::TextUnformatted("");
    right_aligned("so far", first, ui.style.quiet);
    right_aligned("in all", second, ui.style.quiet);
    ImGui::PopFont();
    for (const Counter& counter : kCounters) {
        if (counter.beyond_the_paper && counter.of(total) == 0) continue;
        ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
        ImGui::TextUnformatted(counter.label);
        ImGui::PopStyleColor();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", counter.doc);
        ImGui::PushFont(ui.style.mono);
        right_aligned(std::to_string(counter.of(now)), first, ui.style.text);
        right_aligned(std::to_string(counter.of(total)), second, ui.style.quiet);
        ImGui::PopFont();
    }
    words(ui.style.quiet, gain_words(total.tests, findings.clearance));
}

}  // namespace mobbscope::app
