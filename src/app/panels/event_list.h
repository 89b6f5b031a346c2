/// The tests of the query in view as a table: sorted, filtered, each row a step.
#pragma once

#include <app/ui/data_table.h>

namespace mobbscope::app {

class EventTable {
  public:
    /// The filter with its words, and the table below it, in what room there is. Requires a query in view with tests.
    void draw(Ui& ui, QueryInspector& queries);

  private:
    DataTable table_;
};

}  // namespace mobbscope::app
