#include <app/ui/command_menu.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>

#include <algorithm>
#include <cfloat>
#include <map>
#include <optional>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostChoices = 40;  // more than these are found by the palette
constexpr float kWidestChoice = 0.5f;     // of the window

/// "Undo moving A".
std::string title_of(const Session& session, const Command& command) {
    return std::string(command.title) + (command.title_end ? command.title_end(session) : "");
}

void ask(Session& session, const Command& command) {
    session.queue.push([&session, &command] { ask_for_argument(session, command); });
}

/// Why the last item cannot be done, under the mouse; nothing for one that can.
void reason(const Session& session, const Command& command) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    const std::string why(why_not(session, command));
    if (!why.empty()) ImGui::SetTooltip("Not now: %s", why.c_str());
}

void choices_item(Ui& ui, const Command& command, const std::string& title, const std::string& mark) {
    const std::vector<std::string> all = command.choices(ui.session);
    if (!begin_menu(ui, title, mark, command.enabled(ui.session) && !all.empty())) return reason(ui.session, command);
    const NameList names(all.size(), [&](std::size_t i) { return title_of_choice(command, all[i]); });
    for (std::size_t i = 0; i < std::min(all.size(), kMostChoices); ++i) {
        const bool chosen = command.chosen && command.chosen(ui.session, all[i]);
        ImGui::PushID(static_cast<int>(i));
        const std::string choice = title_of_choice(command, all[i]);
        const std::string shown = fitted_name(choice, kWidestChoice * ImGui::GetIO().DisplaySize.x, names);
        if (ImGui::MenuItem(shown.c_str(), nullptr, chosen)) ui.invoke(command.id, all[i]);
        ImGui::PopID();
        ui.mark(mark + '.' + all[i], OwnKeys::none, choice);
        tell_whole(ui, shown, choice);
        if (chosen) ui.focus.begin_here();
    }
    if (all.size() > kMostChoices) {
        if (ImGui::MenuItem("More...")) ask(ui.session, command);
        ui.mark(mark + "...", OwnKeys::none, "More");
    }
    ImGui::EndMenu();
}

/// The items of an open menu, and its end.
void context_items(Ui& ui, const std::function<std::vector<MenuEntry>()>& entries) {
    std::map<std::string_view, int> seen;
    for (const MenuEntry& entry : entries()) {
        if (entry.id.empty()) {
            ImGui::Separator();
            continue;
        }
        const int count = ++seen[entry.id];
        ImGui::PushID(count);
        command_item(ui, entry, "context." + std::string(entry.id) + (count > 1 ? '.' + std::to_string(count) : ""));
        ImGui::PopID();
    }
    ImGui::EndPopup();
}

/// Menus are spaced alike, whatever they are opened from.
struct MenuSpacing {
    explicit MenuSpacing(const Ui& ui) {
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(8), ui.px(8)});
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), ui.px(5)});
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(8), ui.px(4)});
    }
    ~MenuSpacing() { ImGui::PopStyleVar(3); }
    MenuSpacing(const MenuSpacing&) = delete;
    MenuSpacing& operator=(const MenuSpacing&) = delete;
};

constexpr float kToolGap = 8;  // between groups, pixels at scale 1
constexpr const char* kMore = "\u00BB";

/// Lit while the command says it is on.
void tool_button(Ui& ui, const ToolButton& button) {
    const Command& command = command_named(button.id);
    const bool on = command.checked && command.checked(ui.session);
    ImGui::PushStyleColor(ImGuiCol_Button, on ? ui.style.raised : IM_COL32_BLACK_TRANS);
    // A toggle that is off steps back; what has no state does not.
    ImGui::PushStyleColor(ImGuiCol_Text, on || !command.checked ? ui.style.text : ui.style.quiet);
    command_button(ui, button.label, command.id.data(), "toolbar." + std::string(command.id));
    ImGui::PopStyleColor(2);
}

/// How many of the buttons fit, with the last one behind them if not all do.
std::size_t buttons_that_fit(const Ui& ui, std::span<const ToolButton> buttons, float room) {
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float more = button_width(kMore) + spacing;
    float used = 0;
    std::size_t fit = 0;
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        used += buttons[i].label ? button_width(buttons[i].label) + spacing : ui.px(kToolGap);
        if (used - spacing <= room) {
            if (used + more - spacing <= room) fit = i + 1;
            if (i + 1 == buttons.size()) return buttons.size();
        }
    }
    return fit;
}

}  // namespace

bool begin_menu(Ui& ui, const std::string& title, const std::string& mark, bool enabled) {
    if (!ui.focus.take(mark).empty()) ImGui::OpenPopup(title.c_str());
    const ImGuiID id = ImGui::GetID(title.c_str());
    const std::optional<Rect> before = ui.focus.last_place(mark);
    const bool open = ImGui::BeginMenu(title.c_str(), enabled);
    // The last item of an open menu is the popup.
    const Rect place = open && before ? *before : Ui::last_rect();
    ui.marks.add(mark, place);
    ui.focus.add_menu(mark, place, enabled ? id : 0, title, open);
    return open;
}

void command_item(Ui& ui, const MenuEntry& entry, const std::string& mark) {
    const std::span<const Command> table = commands(ui.session);
    const Command& command = command_named(entry.id, table);
    const std::string title = entry.title.empty() ? title_of(ui.session, command) : entry.title;
    if (command.choices && entry.argument.empty()) return choices_item(ui, command, title, mark);
    // With an argument its own key would do something else, and what is on is not said.
    const std::string shortcut(!entry.like.empty()      ? first_shortcut(command_named(entry.like, table))
                               : entry.argument.empty() ? first_shortcut(command)
                                                        : "");
    const bool checked = entry.argument.empty() && command.checked && command.checked(ui.session);
    if (ImGui::MenuItem(title.c_str(), shortcut.c_str(), checked, command.enabled(ui.session))) {
        const bool asks = command.needs_argument() && entry.argument.empty();
        asks ? ask(ui.session, command) : ui.invoke(command.id, entry.argument);
    }
    ui.mark(mark, OwnKeys::none, title);
    reason(ui.session, command);
}

void open_menu_at(ImGuiID menu, ImVec2 place) {
    ImVec2& mouse = ImGui::GetIO().MousePos;
    mouse = place;
    ImGui::OpenPopup(menu);
    // It lights up nothing of the menu until it moves.
    mouse = {-FLT_MAX, -FLT_MAX};
}

void context_menu(Ui& ui, const std::function<std::vector<MenuEntry>()>& entries, std::optional<ImVec2> place) {
    const MenuSpacing spacing(ui);
    if (ui.focus.opens_menu_of_last()) {
        const Rect rect = Ui::last_rect();
        open_menu_at(ImGui::GetItemID(), place.value_or(ImVec2{rect.min.x + ui.px(18), rect.max.y}));
    }
    if (ImGui::BeginPopupContextItem()) context_items(ui, entries);
}

void context_menu(Ui& ui, const char* name, const std::function<std::vector<MenuEntry>()>& entries) {
    const MenuSpacing spacing(ui);
    if (ImGui::BeginPopup(name)) context_items(ui, entries);
}

void tool_row(Ui& ui, std::span<const ToolButton> buttons) {
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth() - ui.px(6);
    const std::size_t fit = buttons_that_fit(ui, buttons, right - ImGui::GetCursorScreenPos().x);
    for (std::size_t i = 0; i < fit; ++i) {
        if (buttons[i].label) {
            tool_button(ui, buttons[i]);
            ImGui::SameLine();
        } else {
            ImGui::SameLine(0, ui.px(kToolGap));
        }
    }
    if (fit < buttons.size()) {
        if (ImGui::Button(kMore)) ImGui::OpenPopup("more");
        ui.mark("toolbar.more");
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("More buttons");
        const MenuSpacing spacing(ui);
        if (ImGui::BeginPopup("more")) {
            for (std::size_t i = fit; i < buttons.size(); ++i) {
                if (buttons[i].label) {
                    command_item(ui, {buttons[i].id}, "toolbar." + std::string(buttons[i].id));
                } else if (i > fit) {
                    ImGui::Separator();
                }
            }
            ImGui::EndPopup();
        }
    }
    if (fit == buttons.size()) ImGui::NewLine();
}

}  // namespace mobbscope::app
