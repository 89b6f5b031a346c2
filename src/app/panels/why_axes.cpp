#include <app/panels/outcome_cell.h>
#include <app/panels/query_parts.h>
#include <app/panels/section.h>

namespace mobbscope::app {

void why_axes(Ui& ui, const QueryFindings& findings) {
    static_cast<void>(ui);
    static_cast<void>(findings);
}

}  // namespace mobbscope::app
