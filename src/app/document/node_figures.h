/// The figures of nodes in the window, with what has been counted of the scene's queries.
#pragma once

#include <app/document/workspace.h>
#include <explain/scene_figures.h>
#include <render/drawlist/color_scale.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace mobbscope::app {

class NodeFigures {
  public:
    explicit NodeFigures(Workspace& workspace) : workspace_(workspace) {}

    /// Never null. Nothing is counted for it, as that takes long: it has what was counted of each view's fit.
    const std::shared_ptr<SceneFigures>& known();
    /// A figure of the nodes of a clip's tree, of the active view's fit; all NaN where it is not known. Valid as long
    /// as somebody has the tree.
    std::span<const double> column(int clip, NodeField field);

    /// The boxes in the active view's picture, where a figure colours them; null: none does.
    const std::shared_ptr<const ColoredValues>& boxes() const;
    /// Those in the picture of the view at a place, as it was drawn last. Returns whether they are others than before.
    bool show(std::size_t place, const std::shared_ptr<const ColoredValues>& boxes);
    /// While levels are linked, the ranges of the boxes in the other pictures that have colours by this figure, for the
    /// view at a place.
    std::vector<std::shared_ptr<const std::vector<double>>> beside(std::size_t place,
                                                                   const ColoredFigure& figure) const;

  private:
    Workspace& workspace_;
    std::shared_ptr<SceneFigures> figures_ = std::make_shared<SceneFigures>(SceneFigures::Counting::elsewhere);
    std::vector<std::shared_ptr<const ColoredValues>> shown_;  ///< by the view's place
};

}  // namespace mobbscope::app
