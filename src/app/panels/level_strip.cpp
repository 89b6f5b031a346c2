#include <app/panels/bottom_tabs.h>

namespace mobbscope::app {

void level_strip(Ui&, int) {}

}  // namespace mobbscope::app
