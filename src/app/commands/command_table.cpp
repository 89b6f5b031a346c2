#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/commands/palette_entries.h>
#include <app/document/agents.h>
#include <base/text.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

namespace {

std::vector<Command> help_commands() {
    const std::vector<Command> rows{
        Command("help.shortcuts", "Help",
                "Says what can be done now, then lists all keys and what the mouse does; a search finds commands.",
                &Dialogs::open_help,
                {.shortcut = "F1",
                 .enabled = always,
                 .where = Where::everywhere,
                 .also = "keys keyboard manual documentation hotkeys"}),
        Command(
            "help.messages", "Messages", "Lists what was said: what went wrong, what to do, and what was done.",
            [](Dialogs& dialogs, Notifications& notifications) {
                dialogs.open(Dialog::messages);
                notifications.mark_read();
            },
            {.shortcut = "F8", .enabled = always, .where = Where::everywhere, .also = "log console warnings errors"}),
        Command("help.clear_messages", "Clear messages", "Empties the list of messages.", &Notifications::clear,
                {.enabled = {[](const Notifications& notifications) { return !notifications.all().empty(); },
                             []() -> std::string_view { return "there are none"; }},
                 .where = Where::everywhere}),
        Command("help.about", "About Mobbscope", "Says which version this is and what it shows.",
                [](Dialogs& dialogs) { dialogs.open(Dialog::about); }, {.enabled = always, .where = Where::everywhere}),
    };
    return in_menu("Help", rows);
}

/// Nothing is done to what is not shown.
std::vector<Command> only_where_shown(std::vector<Command> rows) {
    for (Command& row : rows) {
        if (row.where == Where::everywhere) continue;
        row.enabled.holds = [of = row.screen, holds = row.enabled.holds](const Session& session) {
            return session.screen == of && holds(session);
        };
    }
    return rows;
}

}  // namespace

std::vector<Command> commands_with(std::vector<Command> of_screens) {
    const auto placed = std::stable_partition(of_screens.begin(), of_screens.end(),
                                              [](const Command& row) { return row.behind.empty(); });
    const std::vector<Command> behind(placed, of_screens.end());
    of_screens.erase(placed, of_screens.end());
    std::vector<Command> table =
        joined({file_commands(),  edit_commands(),   clip_commands(),    view_commands(),  named_view_commands(),
                shown_commands(), tree_commands(),   node_commands(),    sweep_commands(), query_commands(),
                step_commands(),  reason_commands(), compare_commands(), map_commands(),   debug_commands(),
                go_commands(),    row_commands(),    crowd_commands(),   of_screens,       help_commands()});
    for (const Command& row : behind) table.insert(std::ranges::find(table, row.behind, &Command::id) + 1, row);
    return only_where_shown(std::move(table));
}

std::span<const Command> commands() {
    static const std::vector<Command> table = commands_with({});
    return table;
}

std::span<const Command> commands(const Session& session) {
    return session.commands ? std::span<const Command>(*session.commands) : commands();
}

void add_screen(Session& session, std::unique_ptr<Screen> screen) {
    session.screens.push_back(std::move(screen));
    std::vector<Command> rows;
    for (const auto& each : session.screens) {
        for (Command& row : each->commands()) {
            if (row.where == Where::home) row.screen = each.get();
            rows.push_back(std::move(row));
        }
    }
    session.commands = std::make_shared<const std::vector<Command>>(commands_with(std::move(rows)));
}

bool belongs_here(const Session& session, const Command& command) {
    return command.where == Where::everywhere || command.screen == session.screen;
}

std::string_view why_not(const Session& session, const Command& command) {
    if (command.enabled(session)) return "";
    if (!belongs_here(session, command)) {
        return session.screen ? session.screen->words().shown : command.screen->words().not_shown;
    }
    if (session.screen) return command.enabled.why_not(session);
    if (session.jobs.job()) return "work is in progress";
    return session.workspace.empty() ? "nothing is open" : command.enabled.why_not(session);
}

std::string_view why_no_step(const Workspace& workspace) {
    return workspace.view().query ? "there is none from here" : "no query is shown";
}

std::string_view why_no_tests(const Workspace& workspace) {
    return workspace.view().query ? "the query made no test" : "no query is shown";
}

bool has_tests(const Workspace& workspace) { return workspace.recorded() && !workspace.recorded()->trace.empty(); }

bool has_queries(const Workspace& workspace) { return !workspace.fitted().queries().empty(); }

const Command* find_command(std::string_view id, std::span<const Command> table) {
    const auto at = std::find_if(table.begin(), table.end(), [&](const Command& c) { return c.id == id; });
    return at == table.end() ? nullptr : &*at;
}

const Command& command_named(std::string_view id, std::span<const Command> table) {
    if (const Command* found = find_command(id, table)) return *found;
    std::vector<std::string> ids;
    for (const Command& command : table) ids.emplace_back(command.id);
    return table[static_cast<std::size_t>(index_of_name(ids, id, "command"))];
}

void run_command(Session& session, std::string_view id, const std::string& argument) {
    const Command& command = command_named(id, commands(session));
    const auto require = [&](bool holds, const std::string& what_is_wrong) {
        if (!holds) throw std::invalid_argument('"' + std::string(command.title) + "\" " + what_is_wrong);
    };
    require(command.enabled(session), "cannot be done now");
    require(!command.needs_argument() || !argument.empty(), "needs " + std::string(command.argument));
    require(!command.argument.empty() || argument.empty(), "takes nothing, but was given " + in_quotes(argument));
    command.run(session, argument);
}

void invoke(Session& session, std::string_view id, const std::string& argument) {
    session.queue.push([&session, id = std::string(id), argument] { run_command(session, id, argument); });
}

void ask_for_argument(Session& session, const Command& command) {
    DialogInput input{.text = command.present ? command.present(session) : "", .command = std::string(command.id)};
    input.selected = !input.text.empty();
    if (command.chosen) {
        const std::vector<std::string> all = matching_choices(session, command, input.text);
        const auto is_chosen = [&](const std::string& choice) { return command.chosen(session, choice); };
        const auto chosen = std::ranges::find_if(all, is_chosen);
        if (chosen != all.end()) input.picked = static_cast<int>(chosen - all.begin());
    }
    session.dialogs.open(Dialog::palette, std::move(input));
}

const Command* command_for(const Session& session, const Chord& chord) {
    for (const Command& command : commands(session)) {
        if (!belongs_here(session, command)) continue;
        for (const std::string& name : words_of(command.shortcut)) {
            if (chord_from_name(name) == chord) return &command;
        }
    }
    return nullptr;
}

std::string title_of_choice(const Command& command, const std::string& choice) {
    return command.choice_title ? command.choice_title(choice) : choice;
}

std::string_view first_shortcut(const Command& command) {
    return command.shortcut.substr(0, command.shortcut.find(' '));
}

Command option_command(const ViewOption& option) {
    CommandTraits traits{.menu = option.menu, .shortcut = option.shortcut, .enabled = always, .also = option.also};
    if (const auto value = option.toggle) {
        const auto flip = [value](Workspace& workspace) {
            workspace.change_view([&](ViewState& view) { view.*value = !(view.*value); });
        };
        traits.checked = [value](const Workspace& workspace) { return workspace.view().*value; };
        return {option.command, option.title, option.doc, flip, traits};
    }
    const auto choose = [&option](Workspace& workspace, const std::string& text) {
        const std::vector<std::string_view>& all = option.choices;
        // Without an argument the next one.
        const auto now = std::ranges::find(all, option.text(workspace.view()));
        const std::string wanted(text.empty() ? (now + 1 == all.end() ? all.front() : *(now + 1)) : text);
        if (std::ranges::find(all, wanted) == all.end()) {
            throw std::invalid_argument(refusal_of(option.refused_in_window, wanted) + ": give " + either(all));
        }
        workspace.change_view([&](ViewState& view) { option.parse(wanted, view); });
    };
    traits.argument = option.argument;
    traits.choices = [&option](const Session&) {
        return std::vector<std::string>(option.choices.begin(), option.choices.end());
    };
    if (!option.choice_titles.empty()) {
        traits.choice_title = [&option](const std::string& text) {
            const auto at = std::ranges::find(option.choices, text) - option.choices.begin();
            return std::string(option.choice_titles.at(static_cast<std::size_t>(at)));
        };
    }
    traits.chosen = [&option](const Workspace& workspace, const std::string& text) {
        return option.text(workspace.view()) == text;
    };
    return {option.command, option.title, option.doc, choose, traits};
}

std::vector<Command> in_menu(std::string_view menu, std::vector<Command> rows) {
    for (Command& row : rows) {
        if (row.menu.empty()) row.menu = menu;
        if (row.menu == kNoMenu) row.menu = {};
    }
    return rows;
}

std::vector<Command> joined(std::initializer_list<std::vector<Command>> parts) {
    std::vector<Command> out;
    for (const std::vector<Command>& part : parts) out.insert(out.end(), part.begin(), part.end());
    return out;
}

}  // namespace mobbscope::app
