/// Motion graphs that are cut out of the open clips, and crowds that play the open graph: made beside the window, then
/// opened in place of what is open, unsaved.
#pragma once

#include <app/session/files.h>
#include <crowd/graph/graph_options.h>
#include <crowd/simulation/crowd_order.h>

#include <string>
#include <string_view>

namespace mobbscope::app {

class CrowdMaker {
  public:
    CrowdMaker(Workspace& workspace, Files& files, Notifications& notifications)
        : workspace_(workspace), files_(files), notifications_(notifications) {}

    // What the dialogs have.
    GraphOptions graph;
    CrowdOrder crowd;

    /// Why the open scene cannot be cut into a graph, or played; empty: it can.
    std::string_view why_no_graph() const;
    std::string_view why_no_crowd() const;
    /// What is cut, or played, in a line.
    std::string recordings_in_words() const;
    std::string moves_in_words() const;

    /// What goes wrong becomes a message, and what is open stays; so it does when the work is cancelled.
    void build_graph(const GraphOptions& options);
    void simulate(const CrowdOrder& order);

  private:
    std::filesystem::path file_beside(const char* name) const;

    Workspace& workspace_;
    Files& files_;
    Notifications& notifications_;
};

/// "hubs=4 seconds=1:3 whole", over what holds by itself. Throws std::invalid_argument.
GraphOptions parse_graph_options(const std::string& text);
/// "agents=50 area=20x20", likewise.
CrowdOrder parse_crowd_order(const std::string& text);

}  // namespace mobbscope::app
