#include <app/panels/bottom_tabs.h>

namespace mobbscope::app {

void node_list(Ui& ui) { level_strip(ui, clip_in_focus(ui.workspace)); }

}  // namespace mobbscope::app
