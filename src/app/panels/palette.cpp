#include <app/commands/palette_entries.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>

#include <string>

namespace mobbscope::app {

namespace {

constexpr float kLeastSays = 60;  // pixels at scale 1

/// What a line of the list shows.
struct PaletteRow {
    std::string text;
    std::string says{};    ///< behind it
    std::string detail{};  ///< at the right
    std::string key{};
    bool enabled = true;
};

/// One line of the list: what it is, and to the right what it belongs to and its key.
bool palette_row(Ui& ui, int index, bool picked, const PaletteRow& row) {
    const float height = ImGui::GetTextLineHeight() + ui.px(8);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(index);
    const bool clicked = ImGui::Selectable("##row", picked, 0, {0, height});
    ImGui::PopID();
    ui.mark_only("palette." + std::to_string(index));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float text_height = ImGui::GetFontSize();
    const float y = at.y + (height - text_height) / 2;
    const float pad = ui.px(8);
    float right = at.x + width - pad;
    const auto put = [&](const ImFont& font, const std::string& what) {
        if (what.empty()) return;
        right -= text_size(font, what).x;
        draw_text(draw, font, {right, y + (text_height - font.FontSize) / 2}, ui.style.quiet, what);
        right -= 2 * pad;
    };
    put(*ui.style.mono, row.key);
    put(*ui.style.caption, row.detail);
    const std::string shown = fitted_name(row.text, right - at.x - pad);
    draw.AddText({at.x + pad, y}, row.enabled ? ui.style.text : ui.style.quiet, shown.c_str());
    tell_whole(ui, shown, row.text);
    const float says = at.x + pad + ImGui::CalcTextSize(shown.c_str()).x + 2 * pad;
    if (!row.says.empty() && right - says > ui.px(kLeastSays)) {
        ImGui::PushFont(ui.style.caption);
        draw_text(draw, *ui.style.caption, {says, y + (text_height - ui.style.caption->FontSize) / 2}, ui.style.quiet,
                  fitted_text(row.says, right - says));
        ImGui::PopFont();
    }
    return clicked;
}

void run(Session& session, const Command& command, const std::string& argument) {
    session.queue.push([&session, &command, argument] {
        if (argument.empty() && (command.needs_argument() || command.choices)) {
            return ask_for_argument(session, command);
        }
        session.dialogs.close();
        run_command(session, command.id, argument);
    });
}

/// A list of `count` lines that follows the keys; `draw` draws one and says whether it was clicked. Returns the line
/// that was taken, or -1.
template <class Draw>
int pick_from_list(DialogInput& input, int count, bool entered, const Draw& draw) {
    bool moved = move_picked(input.picked, count);
    int taken = entered && count > 0 ? input.picked : -1;
    ImGui::BeginChild("list");
    moved |= ImGui::IsWindowAppearing();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ImGuiListClipper clipper;
    clipper.Begin(count);
    if (moved) clipper.ForceDisplayRangeByIndices(input.picked, input.picked + 1);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            if (draw(i, i == input.picked)) taken = i;
            if (moved && i == input.picked) ImGui::SetScrollHereY();
        }
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
    return taken;
}

void all(Ui& ui, Dialogs& dialogs) {
    DialogInput& input = dialogs.input;
    const bool entered = text_field(ui, "Search commands, agents, clips, queries, nodes (A 2.1), step 400").entered;
    ui.mark("palette.input");
    ImGui::Dummy({0, ui.px(2)});
    const std::vector<PaletteEntry> entries = palette_entries(ui.session, input.text);
    if (entries.empty()) ImGui::TextDisabled("No match.");
    const auto draw = [&](int i, bool picked) {
        const PaletteEntry& entry = entries[static_cast<std::size_t>(i)];
        const std::string detail = entry.why_not.empty() ? entry.detail : entry.why_not;
        const bool clicked =
            palette_row(ui, i, picked, {entry.title, entry.says, detail, entry.shortcut, entry.why_not.empty()});
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(entry.command->doc).c_str());
        return clicked;
    };
    const int taken = pick_from_list(input, static_cast<int>(entries.size()), entered, draw);
    if (taken < 0 || !entries[static_cast<std::size_t>(taken)].why_not.empty()) {
        if (entered) input.fresh = true;
        return;
    }
    const PaletteEntry& entry = entries[static_cast<std::size_t>(taken)];
    run(ui.session, *entry.command, entry.argument);
}

/// The second step: what the command is to be done with.
void argument(Ui& ui, Dialogs& dialogs, const Command& command) {
    DialogInput& input = dialogs.input;
    ImGui::TextUnformatted(std::string(command.title).c_str());
    const bool entered = text_field(ui, std::string(command.argument).c_str()).entered;
    ui.mark("palette.input");
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    ImGui::TextWrapped("%s", std::string(command.doc).c_str());
    ImGui::PopStyleColor();
    const std::vector<std::string> choices = matching_choices(ui.session, command, input.text);
    const auto draw = [&](int i, bool picked) {
        const std::string& choice = choices[static_cast<std::size_t>(i)];
        const bool chosen = command.chosen && command.chosen(ui.session, choice);
        return palette_row(ui, i, picked, {.text = title_of_choice(command, choice), .detail = chosen ? "now" : ""});
    };
    const int taken = pick_from_list(input, static_cast<int>(choices.size()), entered, draw);
    if (taken >= 0) return run(ui.session, command, choices[static_cast<std::size_t>(taken)]);
    if (!entered) return;
    if (input.text.empty()) {
        input.fresh = true;
        return;
    }
    run(ui.session, command, input.text);
}

}  // namespace

void palette(Ui& ui, Dialogs& dialogs) {
    const Command* command = find_command(dialogs.input.command, commands(ui.session));
    // A number needs no list.
    const bool has_list = !command || command->choices;
    begin_dialog(ui, "palette", {560, has_list ? 420.0f : 130.0f}, 0.25f);
    command ? argument(ui, dialogs, *command) : all(ui, dialogs);
    end_dialog();
}

}  // namespace mobbscope::app
