#include <app/panels.h>

namespace mobbscope::app {

void menu_bar(Ui& ui) { static_cast<void>(ui); }

}  // namespace mobbscope::app
