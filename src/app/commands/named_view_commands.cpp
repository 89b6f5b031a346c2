#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

const std::vector<NamedView>& named_views(const Workspace& workspace) { return workspace.scene().debug.views; }

std::vector<std::string> view_names(const Workspace& workspace) {
    std::vector<std::string> out;
    for (const NamedView& named : named_views(workspace)) out.push_back(named.name);
    return out;
}

std::size_t view_named(const Workspace& workspace, const std::string& name) {
    return static_cast<std::size_t>(index_of_name(view_names(workspace), name, "view"));
}

bool has_views(const Workspace& workspace) { return !named_views(workspace).empty(); }
std::string_view why_no_view() { return "the scene has no named view"; }

/// The view that one went to, or saved, last.
bool has_present(const Workspace& workspace) {
    return std::ranges::find(named_views(workspace), workspace.named_view, &NamedView::name) !=
           named_views(workspace).end();
}
std::string present_name(const Workspace& workspace) { return has_present(workspace) ? workspace.named_view : ""; }
bool is_present(const Workspace& workspace, const std::string& name) { return workspace.named_view == name; }

std::string given_view_name(const std::string& text) {
    std::string name = given_name(text, "a view");
    if (camera_preset(name)) throw std::invalid_argument(in_quotes(name) + " is a camera; give the view another name");
    return name;
}

/// A view of that name becomes this one.
void save_view(Workspace& workspace, Notifications& notifications, Keys& keys, const std::string& text) {
    const std::string name = given_view_name(text);
    workspace.edit_debug("saving the view " + name, [&](DebugState& debug) {
        const auto known = std::ranges::find(debug.views, name, &NamedView::name);
        if (known == debug.views.end()) {
            debug.views.push_back({name, workspace.view()});
        } else {
            known->view = workspace.view();
        }
    });
    workspace.named_view = name;
    keys.section = "views";
    notifications.tell(MessageLevel::info, "Saved the view " + name);
}

/// The window's colours stay.
void go_to_view(Workspace& workspace, const std::string& name) {
    const NamedView& named = named_views(workspace)[view_named(workspace, name)];
    const auto see = [&](ViewState& view) {
        const Theme theme = view.theme;
        view = named.view;
        view.theme = theme;
    };
    const std::string found = named.name;
    workspace.change_view(see, EditName{"going to the view " + found, ""});
    workspace.named_view = found;
}

void rename_view(Workspace& workspace, const std::string& text) {
    const std::string name = given_view_name(text);
    const std::size_t index = view_named(workspace, workspace.named_view);
    const std::vector<std::string> names = view_names(workspace);
    if (names[index] != name && std::ranges::find(names, name) != names.end())
        throw std::invalid_argument("another view is named " + in_quotes(name));
    workspace.edit_debug("calling the view " + name, [&](DebugState& debug) { debug.views[index].name = name; });
    workspace.named_view = name;
}

void remove_view(Workspace& workspace, const std::string& name) {
    const std::size_t index = view_named(workspace, name);
    workspace.edit_debug("removing the view " + view_names(workspace)[index], [&](DebugState& debug) {
        debug.views.erase(debug.views.begin() + static_cast<std::ptrdiff_t>(index));
    });
}

}  // namespace

std::vector<Command> named_view_commands() {
    const std::vector<Command> rows{
        Command("view.save_as", "Save this view...", "Saves the present view with the scene, under a name.", save_view,
                {.argument = "NAME",
                 .enabled = {[](const Workspace& workspace) { return has_scene(workspace) && !workspace.in_excerpt(); },
                             [] {
                                 return std::string_view(
                                     "views cannot be saved in an excerpt: go back to the whole scene first");
                             }},
                 .also = "bookmark camera viewpoint"}),
        Command("view.go", "Go to view", "Shows a named view, with the trees that are fitted now.", go_to_view,
                {.argument = "NAME",
                 .enabled = {has_views, why_no_view},
                 .choices = view_names,
                 .chosen = is_present,
                 .also = "bookmark camera viewpoint"}),
        Command("view.rename", "Rename this view...", "Renames the named view that was shown last.", rename_view,
                {.argument = "NAME",
                 .enabled = {has_present, [] { return std::string_view("no named view was shown"); }},
                 .present = present_name}),
        Command("view.remove", "Remove view", "Removes a named view.", remove_view,
                {.argument = "NAME", .enabled = {has_views, why_no_view}, .choices = view_names}),
    };
    return in_menu("View/Named views", rows);
}

}  // namespace mobbscope::app
