#include <app/panels.h>

namespace mobbscope::app {

void job_progress(Ui& ui) { static_cast<void>(ui); }

}  // namespace mobbscope::app
