/// What stands for an event where it is debugged: in breakpoints and bookmarks.
#pragma once

#include <app/document/query_inspector.h>

#include <cstddef>
#include <optional>
#include <string>

namespace mobbscope::app {

/// "node(a) = 2.1": the filter that tests of a node pass; of side 1 "node(b)".
std::string node_filter(const mobb::Tree& tree, int side, int node);

/// "node(a) = 2.1 and node(b) = 2.3": the filter that both nodes of an event pass.
std::string pair_filter(const QueryInspector& queries, int event);

/// "A 2.1, B 2.3".
std::string name_of_event(const QueryInspector& queries, int event);

/// The scene's first bookmark on the step that is in view; none: there is none.
std::optional<std::size_t> present_bookmark(const Workspace& workspace);

}  // namespace mobbscope::app
