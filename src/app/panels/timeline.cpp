#include <app/panels.h>

namespace mobbscope::app {

void timeline(Ui& ui) { static_cast<void>(ui); }

}  // namespace mobbscope::app
