#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <base/text.h>

#include <algorithm>
#include <stdexcept>

namespace mobbscope::app {

namespace {

bool has_source(const Workspace& workspace, int clip) {
    const auto& clips = workspace.scene().clips;
    return clip >= 0 && static_cast<std::size_t>(clip) < clips.size() && clips[static_cast<std::size_t>(clip)].source;
}

/// The clip that import commands are about: of the dialog, else the selected one or that of the selected agent, else
/// the first from a file; -1: none.
int clip_to_import(const Dialogs& dialogs, const Imports& imports, const Workspace& workspace) {
    if (dialogs.now == Dialog::import_clip) return imports.edited.clip;
    const Selection& selected = workspace.selection;
    if (selected.kind == Selection::Kind::clip && has_source(workspace, selected.index)) return selected.index;
    if (selected.on_path()) {
        const auto who = placed_agent_of(workspace.fitted(), selected.path);
        if (who && has_source(workspace, who->clip)) return who->clip;
    }
    const auto& clips = workspace.scene().clips;
    const auto at = std::ranges::find_if(clips, [](const SceneClip& clip) { return clip.source.has_value(); });
    return at == clips.end() ? -1 : static_cast<int>(at - clips.begin());
}

/// The clip of the dialog, the selected one, that of the selected agent, or the only one; -1: none.
int clip_to_move(const Dialogs& dialogs, const Imports& imports, const Workspace& workspace) {
    if (dialogs.now == Dialog::import_clip) return imports.edited.clip;
    const Selection& selected = workspace.selection;
    if (selected.kind == Selection::Kind::clip) return selected.index;
    const auto who = selected.on_path() ? placed_agent_of(workspace.fitted(), selected.path) : std::nullopt;
    if (who) return who->clip;
    return workspace.scene().clips.size() == 1 ? 0 : -1;
}

bool can_move(const Workspace& workspace) {
    return has_scene(workspace) && !workspace.crowd() && !workspace.scene().graph;
}

std::string_view why_not_move(const Workspace& workspace) {
    return workspace.crowd() ? "a run cannot be edited" : "the motion graph was cut out of these clips";
}

/// held or linear, and behind it whose.
void set_motion(Dialogs& dialogs, Imports& imports, Workspace& workspace, const std::string& text) {
    const std::string_view both = trimmed(text);
    const std::size_t end = std::min(both.find(' '), both.size());
    const auto motion = mobb::motion_from_name(both.substr(0, end));
    if (!motion) throw std::invalid_argument("motion is held or linear, not " + in_quotes(both.substr(0, end)));
    const std::string_view named = trimmed(both.substr(end));
    const int clip =
        named.empty() ? clip_to_move(dialogs, imports, workspace) : index_of_name(clip_names(workspace), named, "clip");
    if (clip < 0) throw std::invalid_argument("select the clip, or an agent that plays it");
    imports.set_motion(clip, dialogs.now == Dialog::import_clip && imports.edited.whole_file, *motion);
}

bool can_import(const Workspace& workspace, const Dialogs& dialogs, const Imports& imports) {
    return !workspace.crowd() && !workspace.scene().graph && clip_to_import(dialogs, imports, workspace) >= 0;
}

std::string_view why_no_import(const Workspace& workspace) {
    if (workspace.crowd()) return "a run cannot be edited";
    return workspace.scene().graph ? "the motion graph was cut out of these clips" : "no clip comes from a file";
}

std::vector<std::string> names_of_sources(const Workspace& workspace) {
    std::vector<std::string> out;
    for (const SceneClip& clip : workspace.scene().clips) {
        if (clip.source) out.push_back(clip.name);
    }
    return out;
}

/// A clip's name, and behind it the option that the dialog is opened for.
void open_dialog(Imports& imports, Dialogs& dialogs, Workspace& workspace, const std::string& text) {
    if (text.empty()) return imports.open(clip_to_import(dialogs, imports, workspace));
    const std::vector<std::string> names = clip_names(workspace);
    std::string name(trimmed(text));
    std::string option;
    const std::size_t blank = name.rfind(' ');
    if (std::ranges::find(names, name) == names.end() && blank != std::string::npos &&
        import_option(name.substr(blank + 1))) {
        option = name.substr(blank + 1);
        name = trimmed(std::string_view(name).substr(0, blank));
    }
    imports.open(index_of_name(names, name, "clip"), option);
}

void set(Imports& imports, Dialogs& dialogs, Workspace& workspace, const std::string& text) {
    const std::string_view both = trimmed(text);
    const std::size_t end = std::min(both.find(' '), both.size());
    std::vector<std::string> keys;
    for (const ImportOption& option : kImportOptions) keys.emplace_back(option.key);
    const int option = index_of_name(keys, both.substr(0, end), "import option");
    imports.set(clip_to_import(dialogs, imports, workspace),
                dialogs.now == Dialog::import_clip && imports.edited.whole_file, keys[static_cast<std::size_t>(option)],
                std::string(trimmed(both.substr(end))));
}

}  // namespace

std::vector<Command> clip_commands() {
    const std::vector<Command> rows{
        Command("clip.import", "Import options...",
                "Shows how a clip is read from its file, what was guessed and why, and changes it.", open_dialog,
                {.argument = "[CLIP [OPTION]]",
                 .enabled = {can_import, why_no_import},
                 .choices = names_of_sources,
                 .also = "unit scale axis radius root fps"}),
        Command("clip.set", "Set import option",
                "Reads the selected clip from its file with another value of an import option; without a value as the "
                "file says.",
                set, {.menu = kNoMenu, .argument = "OPTION [VALUE]", .enabled = {can_import, why_no_import}}),
        Command("clip.motion", "Motion between samples",
                "Lets the selected clip's disks stay until the next sample (held), or run straight to it (linear).",
                set_motion,
                {.argument = "MOTION [CLIP]",
                 .enabled = {can_move, why_not_move},
                 .choices =
                     [] { return std::vector<std::string>(mobb::motion_names().begin(), mobb::motion_names().end()); },
                 .chosen =
                     [](const Dialogs& dialogs, const Imports& imports, const Workspace& workspace,
                        const std::string& motion) {
                         const int clip = clip_to_move(dialogs, imports, workspace);
                         return clip >= 0 && name(workspace.fitted().tree(clip).clip().motion()) == motion;
                     },
                 .also = "interpolate interpolation"}),
    };
    return in_menu("Edit", rows);
}

}  // namespace mobbscope::app
