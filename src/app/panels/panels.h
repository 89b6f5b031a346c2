/// The window's panels. Each draws itself into the current ImGui child window.
#pragma once

#include <app/panels/query_parts.h>
#include <app/ui/ui.h>
#include <app/ui/widgets.h>
#include <app/viewport/viewport.h>

#include <span>
#include <utility>
#include <vector>

namespace mobbscope::app {

void menu_bar(Ui& ui);
void scene_panel(Ui& ui, QueryInspector& queries);         ///< agents, clips, queries
float placement_height(const Ui& ui, Settings& settings);  ///< pixels; 0: nobody is selected who can be placed
void placement_panel(Ui& ui);                              ///< the selected agent by numbers; else nothing
void sweep_panel(Ui& ui, SweepInspector& sweeps);          ///< which tree to ship
/// How trees are fitted, what they cost, and what stands out in them.
void tree_panel(Ui& ui, Jobs& jobs, QueryInspector& queries, FitCosts& costs, FitNotices& notices, BoxFigures& boxes);
/// What a query of a clip's tree costs, by kind of test and by level, and how tight its levels are.
void cost_section(Ui& ui, QueryInspector& queries, FitCosts& costs, int clip);
/// The fits of several views by level: how tight they are, and what a query costs; of one view nothing.
void compared_fits_panel(Ui& ui, FitCosts& costs);
/// All views side by side, each under a title, with what they have in common below; one alone without these.
void views_panel(Ui& ui, std::vector<Viewport>& viewports);
/// What stands out in the tree of a clip; nothing where nothing does.
void findings_panel(Ui& ui, FitNotices& notices, int clip);
void query_panel(Ui& ui, QueryInspector& queries, QueryPictures& pictures);  ///< the answer, and why
/// How high the map of placements is, and its side; pixels.
struct MapLayout {
    float height = 0;  ///< 0: no query is in view
    float side = 0;    ///< 0: it is folded
    bool folded_at_first = false;
};
/// `room`: of the column that it stands in.
MapLayout map_layout(const Ui& ui, ImVec2 room);
void map_panel(Ui& ui, MapInspector& maps, MapPicture& picture, const MapLayout& layout);
void crowd_panel(Ui& ui, CrowdInspector& crowds);  ///< who is followed, its last choice, its plays, and who collides
/// When conflicts begin, as bars of so many in a place (corner and size, pixels).
void conflict_bars(Ui& ui, const CrowdInspector& crowds, const ChartAxis& time, ImVec2 corner, ImVec2 size);
void last_choice(Ui& ui, CrowdInspector& crowds);  ///< of who is followed in a run, with its candidates
void selection_panel(Ui& ui);                      ///< all numbers of what is selected
void node_links(Ui& ui);  ///< the way to the selected node, and the nodes beside and below it; of a sample to its leaf
void timeline(Ui& ui, Playback& playback, QueryInspector& queries,
              QueryPictures& pictures);  ///< two clocks: time and step

void dialogs(Ui& ui);  ///< open, save, palette, help, unsaved changes, messages
void messages(Ui& ui, Notifications& notifications, Dialogs& dialogs);  ///< those over the picture
float message_bell(Ui& ui, Notifications& notifications);  ///< at the menu bar's right end; returns where it begins
float status_height(const Ui& ui);                         ///< pixels
void status_bar(Ui& ui, QueryInspector& queries,
                ImVec2 size);  ///< how many there are of what, what is under the mouse, work under way

/// The whole window: panels with movable borders between them.
void window_layout(Ui& ui, std::vector<Viewport>& viewports, QueryPictures& pictures);

// The dialogs, one function each; dialogs() calls the one that is open.
void palette(Ui& ui, Dialogs& dialogs);
void file_dialog(Ui& ui, Dialogs& dialogs,
                 Settings& settings);  ///< open, add, save as, where to export: a path is asked for
void help_sheet(Ui& ui);
/// What the mouse does, as the help sheet says it; docs/window.md says the same.
std::span<const std::pair<const char*, const char*>> mouse_help();
void about(Ui& ui);
void message_list(Ui& ui, Dialogs& dialogs, Notifications& notifications);
void import_dialog(Ui& ui, Imports& imports);  ///< how a clip is read from its file
/// The clip in the import dialog as it is: path, skeleton, radius over time, trim.
void import_preview(Ui& ui, Imports& imports, const SceneClip& clip);
void export_dialog(Ui& ui);  ///< how a picture is exported: size, background, what is left out, a preview, the command
void graph_dialog(Ui& ui, CrowdMaker& maker);     ///< the options of a motion graph that is cut out of the open clips
void simulate_dialog(Ui& ui, CrowdMaker& maker);  ///< ... of a crowd that plays the open one
void history_list(Ui& ui);                        ///< what can be undone and redone, and the way there

}  // namespace mobbscope::app
