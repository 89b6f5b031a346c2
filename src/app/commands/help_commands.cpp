#include <app/commands/command.h>

namespace mobbscope::app {

std::span<const Command> help_commands() {
    static const std::vector<Command> table{
        {.id = "help.shortcuts",
         .title = "Shortcuts",
         .menu = "Help",
         .shortcut = "F1",
         .doc = "Lists all shortcuts and what the mouse does.",
         .run = [](Session& session, const std::string&) { session.open_dialog(Dialog::help); }},
        {.id = "help.about",
         .title = "About Mobbscope",
         .menu = "Help",
         .doc = "Says which version this is and what it shows.",
         .run = [](Session& session, const std::string&) { session.open_dialog(Dialog::about); }},
    };
    return table;
}

}  // namespace mobbscope::app
