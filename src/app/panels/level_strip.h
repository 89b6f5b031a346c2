/// The levels of a tree over time, one row each, coloured by a figure of its nodes.
#pragma once

#include <app/ui/ui.h>
#include <app/ui/widgets.h>
#include <render/drawlist/color_scale.h>
#include <scene/fitted_scene.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace mobbscope::app {

/// With the cells that were drawn last: most frames draw the same ones.
class LevelStrip {
  public:
    /// Of the tree of a clip that somebody plays, on the timeline's axis, so high at most (pixels); nothing where that
    /// is too low.
    void draw(Ui& ui, int clip, const ChartAxis& time, float most_height);

    /// A node, or several that stand on one pixel: the worst of them.
    struct Cell {
        float left = 0, right = 0;  ///< pixels
        int node = 0;
        double value = 0;
    };
    using Rows = std::vector<std::vector<Cell>>;  ///< by level, in the order of time

  private:
    /// What they were made for.
    struct Key {
        std::shared_ptr<const mobb::Tree> tree;
        ColoredFigure figure;
        std::optional<ValueRange> chosen{};  ///< ends of the colours
        std::array<double, 6> times{};       ///< of the tree and of the axis, with its pixels
        friend bool operator==(const Key&, const Key&) = default;
    };
    std::optional<Key> key_;
    std::vector<double> values_;  ///< by node, likewise
    ColorScale scale_;            ///< of all these, on all levels
    Rows rows_;
};

}  // namespace mobbscope::app
