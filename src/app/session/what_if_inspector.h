/// What queries would cost if the selected node were other. It is measured alone: the trees stay as they are.
#pragma once

#include <app/document/workspace.h>
#include <app/session/jobs.h>
#include <explain/what_if.h>

#include <memory>
#include <optional>
#include <string_view>

namespace mobbscope::app {

/// The section of its panel, as settings call it.
inline constexpr std::string_view kWhatIfSection = "what if";

class WhatIfInspector {
  public:
    WhatIfInspector(Workspace& workspace, Jobs& jobs) : workspace_(workspace), jobs_(jobs) {}

    /// The tree of the selected node; null: no node is selected.
    std::shared_ptr<const mobb::Tree> tree() const;
    /// Why nothing can be tried; empty: it can.
    std::string_view why_not() const;

    /// Tries all that there is to try in place of the selected node, in the background where that takes long. Requires
    /// that why_not() is empty.
    void measure();
    /// For the selected node.
    bool is_under_way() const;
    /// Of the selected node; null until it was measured.
    const WhatIf* found() const;

    int pointed = -1;  ///< the variant under the mouse; -1: none

  private:
    Workspace& workspace_;
    Jobs& jobs_;
    std::optional<WhatIf> found_;
    std::shared_ptr<const mobb::Tree> tried_tree_;  ///< the job's, or the last one's
    int tried_node_ = -1;                           ///< likewise
};

}  // namespace mobbscope::app
