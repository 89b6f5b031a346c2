/// The figures of nodes in the window, with what has been counted of the scene's queries.
#pragma once

#include <app/document/workspace.h>
#include <explain/scene_figures.h>
#include <render/drawlist/color_scale.h>

#include <memory>
#include <span>

namespace mobbscope::app {

class NodeFigures {
  public:
    explicit NodeFigures(Workspace& workspace) : workspace_(workspace) {}

    /// Never null. Nothing is counted for it: that takes long.
    const std::shared_ptr<SceneFigures>& known();
    /// A figure of the nodes of a clip's tree; of what is not known all NaN. Valid until something else is asked for.
    std::span<const double> column(int clip, NodeField field);

    /// The boxes in the active view's picture, where a figure colours them; null: none does.
    std::shared_ptr<const ColoredValues> boxes;

  private:
    Workspace& workspace_;
    std::shared_ptr<SceneFigures> figures_ = std::make_shared<SceneFigures>(SceneFigures::Counting::elsewhere);
};

}  // namespace mobbscope::app
