#include <app/panels.h>

namespace mobbscope::app {

void messages(Ui& ui) { static_cast<void>(ui); }

}  // namespace mobbscope::app
