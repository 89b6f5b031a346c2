/// The figures of nodes in the window, with what has been counted of the scene's queries.
#pragma once

#include <app/document/views.h>
#include <app/document/workspace.h>
#include <explain/scene_figures.h>
#include <render/layout/box_colors.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mobbscope::app {

class NodeFigures {
  public:
    NodeFigures(Workspace& workspace, Views& views) : workspace_(workspace), views_(views) {}

    /// Never null. Nothing is counted for it, as that takes long: it has what was counted of each view's fit.
    const std::shared_ptr<SceneFigures>& known();
    /// A figure of the nodes of a clip's tree, of the active view's fit; all NaN where it is not known. Valid as long
    /// as somebody has the tree.
    std::span<const double> column(int clip, NodeField field);

    /// What colours the boxes of the view at a place; null: no figure does. While levels are linked, views with colours
    /// by one figure have one scale. The same pointer as long as nothing of that changes.
    const std::shared_ptr<const BoxColors>& boxes(std::size_t place);
    /// Those of the active view.
    const std::shared_ptr<const BoxColors>& boxes() { return boxes(views_.active()); }

  private:
    struct Colored {
        std::shared_ptr<const FittedScene> fitted;
        ViewState view;
        std::shared_ptr<const BoxColors> boxes{};
    };
    bool are_colored_now() const;

    Workspace& workspace_;
    Views& views_;
    std::shared_ptr<SceneFigures> figures_ = std::make_shared<SceneFigures>(SceneFigures::Counting::elsewhere);
    std::vector<Colored> colored_;  ///< by the view's place
    std::int64_t revision_ = 0;     ///< of the figures that they are of
    bool linked_ = false;           ///< their levels were
};

}  // namespace mobbscope::app
