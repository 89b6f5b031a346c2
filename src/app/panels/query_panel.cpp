#include <app/panels.h>

namespace mobbscope::app {

void query_panel(Ui& ui) { static_cast<void>(ui); }

}  // namespace mobbscope::app
