#include <app/panels.h>

namespace mobbscope::app {

void dialogs(Ui& ui) { static_cast<void>(ui); }

}  // namespace mobbscope::app
