#include <app/commands/situations.h>

#include <algorithm>
#include <array>

namespace mobbscope::app {

namespace {

bool in_file_dialog(const Dialogs& dialogs) { return dialogs.question(dialogs.behind_help()); }

template <Dialog dialog>
bool in_dialog(const Dialogs& dialogs) {
    return dialogs.behind_help() == dialog;
}

bool agent_is_selected(const Workspace& workspace) {
    return workspace.selection.on_path() && !workspace.crowd() && !workspace.scene().agents.empty();
}

}  // namespace

std::span<const Situation> situations() {
    static const std::vector<Situation> table{
        {"Choosing a file",
         "Type a path, or pick one of the list; Escape leads back to it from here.",
         in_file_dialog,
         {},
         {{"Tab", "Complete the path; where it is complete, go to the buttons"},
          {"Up, Down", "Pick a file or a folder"},
          {"Enter", "Go into the folder, or take the file"},
          {"Escape", "Leave it as it was"}}},
        {"Changes are not saved",
         "They are lost if you go on without saving; Escape leads back to the question.",
         in_dialog<Dialog::unsaved>,
         {},
         {{"Enter", "Save, and go on"}, {"D", "Go on without saving"}, {"Escape", "Stay"}}},
        {"Searching a command",
         "A few letters of its name are enough; Escape leads back to the search.",
         in_dialog<Dialog::palette>,
         {},
         {{"Up, Down", "Pick a line"}, {"Enter", "Run it, or give what it asks for"}, {"Escape", "Close the search"}}},
        {"Importing a clip",
         "Each option says which value was chosen automatically, and why; a change is imported at once.",
         in_dialog<Dialog::import_clip>,
         {},
         {{"Tab, Enter", "Go to the next option, and change it"},
          {"Ctrl+Z, Ctrl+Y", "Undo and redo what was changed"},
          {"Escape", "Close it"}}},
        {"Exporting a picture",
         "Choose its size and what is left out; the preview and the command line follow.",
         in_dialog<Dialog::export_picture>,
         {},
         {{"Enter", "Export it; where a file would be overwritten, Enter once more"},
          {"Tab, Enter", "Go to the next field, and change it"},
          {"Escape", "Close it; the settings stay"}}},
        {"Nothing is open",
         "Open a scene, motion clips or tracked people; they can also be dropped on the window.",
         [](const Workspace& workspace) { return workspace.empty(); },
         {"file.open", "file.demo", "file.recent", "go.palette"}},
        {"You look at one moment",
         "Everybody stands on the floor as they do at the time of the cursor.",
         [](const Workspace& workspace) { return workspace.view().show != Show::space_time; },
         {"view.moment", "view.plan", "time.play", "time.forward", "time.back", "crowd.follow", "view.top",
          "view.frame", "time.start", "time.end"}},
        {"You look at a query",
         "Go through its tests: the boxes that stand out are compared, and at the right stands why they are apart.",
         [](const Workspace& workspace) { return workspace.view().query.has_value(); },
         {"step.forward",        "step.back",         "step.first",          "step.last",
          "step.next_separated", "step.next_overlap", "step.next_avoidable", "step.previous_avoidable",
          "step.next_hit",       "step.into",         "step.over",           "step.out",
          "events.show",         "rows.find",         "breakpoint.here",     "breakpoint.next",
          "step.visited_back",   "bookmark.add",      "go.contact",          "view.frame",
          "query.next",          "query.previous",    "query.none",          "crowd.back"}},
        {"You look at a crowd",
         "Follow somebody, and see at each choice which moves could be taken and who ruled out the others.",
         [](const Workspace& workspace) { return is_crowd(workspace); },
         {"crowd.follow", "crowd.next_choice", "crowd.previous_choice", "crowd.stop", "time.play", "view.moment",
          "conflicts.find", "conflicts.next", "crowd.candidates", "view.frame"}},
        {"An agent is selected",
         "Drag its handles, or give numbers under PLACEMENT; every answer follows at once.",
         agent_is_selected,
         {"agent.duplicate", "agent.remove", "agent.rename", "query.add", "view.frame", "go.child", "edit.undo",
          "go.none"}},
        {"You look at a scene",
         "Show coarser and finer boxes, try other trees, or choose a query to see why two never meet.",
         [] { return true; },
         {"query.next", "view.finer", "view.coarser", "view.leaves", "tree.kind", "view.split", "time.play",
          "view.moment", "view.frame_all", "go.palette"}},
    };
    return table;
}

const Situation& present_situation(const Session& session) {
    const auto table = situations();
    const auto now = std::find_if(table.begin(), table.end() - 1, [&](const Situation& s) { return s.holds(session); });
    // A dialog lies over the screen.
    return session.screen && now->keys.empty() ? session.screen->situation() : *now;
}

std::span<const KeyHelp> focus_help() {
    static constexpr std::array<KeyHelp, 8> kKeys{{
        {"Tab, Shift+Tab", "Go to the next button, field or list, or the one before"},
        {"Arrows", "Go through a list, or to what is beside"},
        {"Enter, Space",
         "Press what has the focus; in a number, type it. Enter on a button gives the keys to the picture"},
        {"Up, Down", "Step a number; Shift finer, Ctrl coarser"},
        {"Escape", "Close what is topmost; back to the viewport"},
        {"Escape in a drag", "Cancel the drag"},
        {"Alt+F, Alt+E ...", "Open a menu by its letter"},
        {"Letters", "In a menu, go to what begins with them"},
    }};
    return kKeys;
}

}  // namespace mobbscope::app
