/// The tests of the query in view as a table: sorted, filtered, each row a step.
#pragma once

#include <app/ui/ui.h>

#include <memory>
#include <string>
#include <vector>

namespace mobbscope::app {

class EventTable {
  public:
    /// The filter with its words, and the table below it, in what room there is. Requires a query in view with tests.
    void draw(Ui& ui, QueryInspector& queries);

  private:
    void table(Ui& ui, QueryInspector& queries);
    void row(Ui& ui, QueryInspector& queries, int index) const;
    /// Scrolls to the row of the present step, where that has changed or rows have.
    void follow(int step, float row_height, float head_height);

    std::shared_ptr<const std::vector<int>> rows_;  ///< as they were drawn last
    int step_ = -1;                                 ///< likewise
    int present_ = -1;                              ///< its row; -1: it has none
    std::string order_{};                           ///< by what they are filtered and sorted
};

}  // namespace mobbscope::app
