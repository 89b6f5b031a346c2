#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/commands/palette_entries.h>
#include <app/commands/situations.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

/// A line of the sheet: a command that can be run from there, a key that is no command's, words, or a heading.
struct Line {
    enum class Kind { heading, words, keys, command };
    Kind kind = Kind::keys;
    std::string keys, what, doc;
    const Command* command = nullptr;
};

constexpr std::array<std::pair<const char*, const char*>, 8> kMouse{{
    {"Left drag", "Turn the scene"},
    {"Right drag", "Shift the scene"},
    {"Wheel", "Go nearer, or away"},
    {"Click", "Select"},
    {"Right click", "What can be done with it"},
    {"Drop files", "Open or add them"},
    {"Hover", "Say what is there"},
    {"Click a number", "Copy it with all its digits"},
}};

std::string keys_of(const Command& command) {
    std::string out;
    for (const std::string& chord : words_of(command.shortcut)) out += (out.empty() ? "" : ", ") + chord;
    return out;
}

Line line_of(const Command& command) {
    std::string what(command.title);
    if (what.ends_with("...")) what.resize(what.size() - 3);
    return {Line::Kind::command, keys_of(command), what, std::string(command.doc), &command};
}

void add_heading(std::vector<Line>& out, std::string_view title) {
    out.push_back({Line::Kind::heading, "", std::string(title), "", nullptr});
}

/// What can be done now, then all that has keys, by menu; then the keys of panels, and the mouse.
std::vector<Line> all_lines(const Session& session) {
    std::vector<Line> out;
    const Situation& now = present_situation(session);
    add_heading(out, now.title);
    out.push_back({Line::Kind::words, "", std::string(now.words), "", nullptr});
    for (const KeyHelp& key : now.keys) {
        out.push_back({Line::Kind::keys, std::string(key.keys), std::string(key.what), "", nullptr});
    }
    for (const std::string_view id : now.commands) {
        const Command& command = command_named(id, commands(session));
        if (command.enabled(session)) out.push_back(line_of(command));
    }
    add_heading(out, "Keys in panels, lists and menus");
    for (const KeyHelp& key : focus_help()) {
        out.push_back({Line::Kind::keys, std::string(key.keys), std::string(key.what), "", nullptr});
    }
    add_heading(out, "Mouse");
    for (const auto& [keys, what] : kMouse) out.push_back({Line::Kind::keys, keys, what, "", nullptr});
    std::string_view menu;
    for (const Command& command : commands(session)) {
        if (command.shortcut.empty() || !belongs_here(session, command)) continue;
        const std::string_view of = command.menu.substr(0, command.menu.find('/'));
        if (of != menu) add_heading(out, of);
        menu = of;
        out.push_back(line_of(command));
    }
    return out;
}

/// What has all the words of the search in its title, its sentence or its keys; commands without keys too.
std::vector<Line> lines_with(const Session& session, const std::string& search) {
    std::vector<std::pair<double, Line>> found;
    const auto add = [&](const Line& line) {
        // What can be done now stands first, and of equals what stands in a menu.
        double score = line.command && !line.command->enabled(session) ? -1000 : 0;
        if (line.command && line.command->menu.empty()) score -= 1;
        for (const std::string& word : words_of(search)) {
            const auto in_title = word_score(word, line.what);
            const auto in_keys = word_score(word, line.keys);
            const auto in_doc = word_score(word, line.doc);
            if (!in_title && !in_keys && !in_doc) return;
            score += in_title ? 3 + *in_title : in_keys ? 2 + *in_keys : *in_doc;
        }
        found.emplace_back(score, line);
    };
    for (const Command& command : commands(session)) add(line_of(command));
    for (const KeyHelp& key : focus_help()) {
        add({Line::Kind::keys, std::string(key.keys), std::string(key.what), "", nullptr});
    }
    for (const auto& [keys, what] : kMouse) add({Line::Kind::keys, keys, what, "", nullptr});
    for (const Situation& situation : situations()) {
        for (const KeyHelp& key : situation.keys) {
            add({Line::Kind::keys, std::string(key.keys), std::string(key.what), std::string(situation.title),
                 nullptr});
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Line> out;
    for (auto& [score, line] : found) out.push_back(std::move(line));
    return out;
}

/// Where keys, titles and sentences begin, pixels from the left.
struct HelpColumns {
    float what = 0, doc = 0;
};

HelpColumns help_columns(const Ui& ui, const std::vector<Line>& lines) {
    float keys = 0;
    float what = 0;
    for (const Line& line : lines) {
        if (line.kind == Line::Kind::heading || line.kind == Line::Kind::words) continue;
        keys = std::max(keys, text_size(*ui.style.mono, line.keys).x);
        if (line.kind == Line::Kind::command) what = std::max(what, ImGui::CalcTextSize(line.what.c_str()).x);
    }
    const float pad = ui.px(8);
    return {pad + keys + ui.px(16), pad + keys + what + ui.px(34)};
}

/// Draws one; true if it was clicked.
bool help_row(Ui& ui, const Line& line, const HelpColumns& columns, std::size_t index, bool picked) {
    const float height = ImGui::GetTextLineHeight() + ui.px(6);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    if (line.kind == Line::Kind::heading) {
        if (index > 0) ImGui::Dummy({0, ui.px(8)});
        text_line(ui.style.accent, line.what, ui.style.caption);
        return false;
    }
    if (line.kind == Line::Kind::words) {
        words(ui.style.quiet, line.what);
        ImGui::Dummy({0, ui.px(2)});
        return false;
    }
    const bool can = line.command && why_not(ui.session, *line.command).empty();
    bool clicked = false;
    if (line.command) {
        ImGui::PushID(static_cast<int>(index));
        clicked = ImGui::Selectable("##line", picked, 0, {0, height});
        ImGui::PopID();
        ui.mark_only("help." + std::string(line.command->id));
    } else {
        if (picked)
            ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height},
                                                      ImGui::GetColorU32(ImGuiCol_Header));
        ImGui::Dummy({width, height});
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = at.y + 0.5f * (height - ImGui::GetFontSize());
    draw_text(list, *ui.style.mono, {at.x + ui.px(8), y}, can || !line.command ? ui.style.text : ui.style.quiet,
              line.keys);
    const ImU32 color = can || !line.command ? ui.style.text : ui.style.quiet;
    list.AddText({at.x + columns.what, y}, color, line.what.c_str());
    // Why it cannot be done now says more than what it would do.
    const std::string doc =
        line.command && !can ? "(" + std::string(why_not(ui.session, *line.command)) + ")" : line.doc;
    const float room = width - columns.doc - ui.px(8);
    if (line.command && room > ui.px(60)) {
        list.AddText({at.x + columns.doc, y}, ui.style.quiet, fitted_text(doc, room).c_str());
    }
    if (line.command && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s%s", line.doc.c_str(), can ? "\nClick or Enter: do it" : "");
    }
    return clicked;
}

void run_from_help(Session& session, const Command& command) {
    if (!command.enabled(session)) return;
    session.queue.push([&session, &command] {
        // Through the dialog that it may lie over.
        while (session.dialogs.now != Dialog::none) session.dialogs.close();
        if (command.needs_argument() || command.choices) {
            ask_for_argument(session, command);
        } else {
            run_command(session, command.id);
        }
    });
}

/// Up and Down go from one line that says something to the next.
bool move_over_lines(int& picked, const std::vector<Line>& lines) {
    const auto says = [&](int i) {
        const Line::Kind kind = lines[static_cast<std::size_t>(i)].kind;
        return kind == Line::Kind::keys || kind == Line::Kind::command;
    };
    const auto count = static_cast<int>(lines.size());
    const int before = picked;
    const bool moved = move_picked(picked, count);
    const int way = moved && picked < before ? -1 : 1;
    for (int i = picked; i >= 0 && i < count; i += way) {
        if (!says(i)) continue;
        picked = i;
        return moved;
    }
    picked = before;
    return moved;
}

}  // namespace

std::span<const std::pair<const char*, const char*>> mouse_help() { return kMouse; }

void help_sheet(Ui& ui) {
    DialogInput& input = ui.session.dialogs.input;
    begin_dialog(ui, "help", {980, 680});
    dialog_title(ui, "Help");
    const FieldEvents events = text_field(ui, "Search commands and keys");
    ui.mark("help.search");
    ImGui::Dummy({0, ui.px(2)});
    const bool searched = !words_of(input.text).empty();
    const std::vector<Line> lines = searched ? lines_with(ui.session, input.text) : all_lines(ui.session);
    const bool moved = move_over_lines(input.picked, lines);
    const HelpColumns columns = help_columns(ui, lines);
    ImGui::BeginChild(searched ? "found" : "lines", {0, -ImGui::GetFrameHeightWithSpacing() - ui.px(4)});
    if (events.changed) ImGui::SetScrollY(0);
    if (lines.empty()) ImGui::TextDisabled("No match.");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), ui.px(1)});
    int taken = -1;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool picked = static_cast<int>(i) == input.picked;
        if (help_row(ui, lines[i], columns, i, picked)) taken = static_cast<int>(i);
        if (moved && picked) ImGui::SetScrollHereY();
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
    if (events.entered) {
        taken = input.picked;
        input.fresh = true;
    }
    if (taken >= 0 && taken < static_cast<int>(lines.size())) {
        if (const Command* command = lines[static_cast<std::size_t>(taken)].command)
            run_from_help(ui.session, *command);
    }
    if (marked_button(ui, "Close", "help.close")) ui.later(&Dialogs::close);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("Up and Down go through the list; Enter does what is picked.");
    end_dialog();
}

}  // namespace mobbscope::app
