#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/number_options.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace mobbscope::app {

namespace {

constexpr float kWidth = 500;       // pixels at scale 1
constexpr float kFieldShare = 0.5;  // of the dialog's width

/// The numbers of an option; those that are wanted now, where they are others.
std::optional<Numbers> number_fields(Ui& ui, const std::string& mark, const NumberOptionInfo& option, Numbers now) {
    const std::size_t count = option.between == 0 ? 1 : 2;
    const float gap = ui.px(6);
    const float width = (ImGui::GetContentRegionAvail().x - (count == 2 ? gap : 0)) / static_cast<float>(count);
    std::optional<Numbers> wanted;
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(width);
        // Of a range the smaller number stays so.
        const bool range = option.between == ':';
        const auto number = number_field(ui, {.mark = count == 1 ? mark : mark + (i == 0 ? ".first" : ".second"),
                                              .what = std::string(option.title),
                                              .now = now[i],
                                              .unit = std::string(option.unit),
                                              .decimals = option.decimals,
                                              .step = option.step,
                                              .least = range && i == 1 ? now[0] : option.least,
                                              .most = range && i == 0 ? now[1] : option.most});
        if (!number) continue;
        wanted = now;
        (*wanted)[i] = *number;
    }
    return wanted;
}

/// A row for each option. `chosen`: where they are in the session.
template <class Options>
void option_fields(Ui& ui, const std::string& prefix, std::span<const NumberOption<Options>> all,
                   Options CrowdMaker::*chosen) {
    const float left = (1 - kFieldShare) * ImGui::GetWindowContentRegionMax().x;
    for (const NumberOption<Options>& option : all) {
        ImGui::AlignTextToFramePadding();
        text_line(ui.style.quiet, std::string(option.title));
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help_of(option).c_str());
        ImGui::SameLine(left);
        const auto wanted =
            number_fields(ui, prefix + std::string(option.key), option, option.get(ui.session.crowd_maker.*chosen));
        if (!wanted) continue;
        ui.later([&option, chosen, numbers = *wanted](CrowdMaker& maker) { option.set(maker.*chosen, numbers); });
    }
}

/// What begins the work, what brings back what holds by itself, and what closes the dialog; true if the work is to
/// begin.
template <class Options>
bool order_buttons(Ui& ui, const char* label, const std::string& prefix, Options CrowdMaker::*chosen, bool taken) {
    ImGui::Dummy({0, ui.px(4)});
    const bool begins = marked_button(ui, label, (prefix + "ok").c_str(), true) || (pressed(ImGuiKey_Enter) && !taken);
    ImGui::SameLine();
    if (marked_button(ui, "Defaults", (prefix + "defaults").c_str())) {
        ui.later([chosen](CrowdMaker& maker) { maker.*chosen = Options{}; });
    }
    ImGui::SameLine();
    if (marked_button(ui, "Cancel", (prefix + "cancel").c_str())) ui.later(&Dialogs::close);
    return begins;
}

bool are_keys_taken() { return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup) || ImGui::GetIO().WantTextInput; }

}  // namespace

void graph_dialog(Ui& ui, CrowdMaker& maker) {
    if (!maker.why_no_graph().empty()) {
        ui.later(&Dialogs::close);  // the clips are closed
        return;
    }
    const bool taken = are_keys_taken();
    begin_dialog(ui, "graph", {kWidth, 456});
    dialog_title(ui, "Build a motion graph");
    words(ui.style.quiet, maker.recordings_in_words() +
                              ". Poses that come again become hubs, and what lies between two of them a move.");
    ImGui::Dummy({0, ui.px(2)});
    bool whole = maker.graph.whole;
    if (ImGui::Checkbox("Take clips whole: each may follow each, and nothing is bounded", &whole)) {
        ui.later([whole](CrowdMaker& of) { of.graph.whole = whole; });
    }
    ui.mark("graph.whole");
    ImGui::BeginDisabled(maker.graph.whole);
    option_fields(ui, "graph.", graph_options(), &CrowdMaker::graph);
    ImGui::EndDisabled();
    const bool begins = order_buttons(ui, "Build", "graph.", &CrowdMaker::graph, taken);
    end_dialog();
    if (!begins) return;
    ui.later([](Dialogs& dialogs, CrowdMaker& of) {
        dialogs.close();
        of.build_graph(of.graph);
    });
}

void simulate_dialog(Ui& ui, CrowdMaker& maker) {
    if (!maker.why_no_crowd().empty()) {
        ui.later(&Dialogs::close);  // the graph is closed
        return;
    }
    const bool taken = are_keys_taken();
    begin_dialog(ui, "simulate", {kWidth, 414});
    dialog_title(ui, "Simulate a crowd");
    words(ui.style.quiet,
          maker.moves_in_words() + ": agents play its moves back to back; they collide only where a play is forced.");
    ImGui::Dummy({0, ui.px(2)});
    option_fields(ui, "simulate.", crowd_options(), &CrowdMaker::crowd);
    const SimulateOptions& options = maker.crowd.options;
    ImGui::PushFont(ui.style.caption);
    words(ui.style.quiet,
          formatted("%.3g m\u00B2 for each agent. Below 4 m\u00B2, simulating is slow and many plays are forced.",
                    options.area.x * options.area.y / options.agents));
    ImGui::PopFont();
    const bool begins = order_buttons(ui, "Simulate", "simulate.", &CrowdMaker::crowd, taken);
    end_dialog();
    if (!begins) return;
    ui.later([](Dialogs& dialogs, CrowdMaker& of) {
        dialogs.close();
        of.simulate(of.crowd);
    });
}

}  // namespace mobbscope::app
