#include <app/panels/bottom_tabs.h>

namespace mobbscope::app {

void curves(Ui&) {}

}  // namespace mobbscope::app
