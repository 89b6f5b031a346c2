#include <app/panels.h>

namespace mobbscope::app {

void scene_panel(Ui& ui) { static_cast<void>(ui); }

}  // namespace mobbscope::app
