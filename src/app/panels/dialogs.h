/// The dialogs, one function each; dialogs() calls the one that is open.
#pragma once

#include <app/ui/ui.h>

namespace mobbscope::app {

void palette(Ui& ui);
void file_dialog(Ui& ui);  ///< open, add, save as, export: a path is asked for
void help_sheet(Ui& ui);
void about(Ui& ui);

}  // namespace mobbscope::app
