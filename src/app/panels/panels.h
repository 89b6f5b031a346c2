/// The window's panels. Each draws itself into the current ImGui child window.
#pragma once

#include <app/panels/query_parts.h>
#include <app/ui/ui.h>
#include <app/viewport/viewport.h>

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mobbscope::app {

void menu_bar(Ui& ui);
void scene_panel(Ui& ui);                           ///< agents, clips, queries
void placement_panel(Ui& ui);                       ///< the selected agent by numbers
void tree_panel(Ui& ui);                            ///< how trees are fitted and how tight they are
void query_panel(Ui& ui, QueryPictures& pictures);  ///< the answer, and why
void crowd_panel(Ui& ui);                           ///< who is followed, its last choice, its plays, and who collides
void selection_panel(Ui& ui);                       ///< all numbers of what is selected
void timeline(Ui& ui, QueryPictures& pictures);     ///< two clocks: time and step
// Picture tests, which take the place of the scene's panels.
void review_list(Ui& ui);                                           ///< the cases and what came of them
std::optional<glm::ivec2> review_pictures(Ui& ui);                  ///< returns the pixel under the mouse
void review_facts(Ui& ui, const std::optional<glm::ivec2>& pixel);  ///< what differs, files, what can be done
void review_way_back(Ui& ui);                                       ///< over the scene of a case
void dialogs(Ui& ui);                                               ///< open, save, palette, help, unsaved changes
void messages(Ui& ui);

/// The whole window: panels with movable borders between them.
void window_layout(Ui& ui, std::vector<Viewport>& viewports, QueryPictures& pictures);

// The dialogs, one function each; dialogs() calls the one that is open.
void palette(Ui& ui);
void file_dialog(Ui& ui);  ///< open, add, save as, export: a path is asked for
void help_sheet(Ui& ui);
/// What the mouse does, as the help sheet says it; README says the same.
std::span<const std::pair<const char*, const char*>> mouse_help();
void about(Ui& ui);

}  // namespace mobbscope::app
