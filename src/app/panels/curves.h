/// What paths do over time, as plots below the timeline and on its axis: radius, speed, turning, cost.
#pragma once

#include <app/ui/ui.h>
#include <app/ui/widgets.h>
#include <explain/path_curves.h>
#include <explain/tree_cost.h>
#include <scene/drawn_agent.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace mobbscope::app {

/// With the curves that were drawn last: most frames draw the same ones.
class CurvePlots {
  public:
    /// `time`: that of the bars above, pixels of the window.
    void draw(Ui& ui, const ChartAxis& time);

  private:
    /// A path with its curves, in columns of pixels too.
    struct Path {
        DrawnAgent agent;
        AgentRef ref;
        std::array<PathCurve, kCurveCount> curves{};
        std::array<std::vector<ValueColumn>, kCurveCount> columns{};
    };
    /// What they were made for.
    struct Key {
        std::shared_ptr<const FittedScene> fitted;
        std::vector<AgentRef> refs;
        std::vector<std::shared_ptr<const TreeCost>> costs;  ///< by path; null: not known
        LevelRange levels;
        double t0 = 0, t1 = 1;
        int columns = 0;
        friend bool operator==(const Key&, const Key&) = default;
    };
    /// What is at the mouse.
    struct Point {
        const Path* path;
        int sample;
        double value;
        float y;
    };

    void update(Ui& ui, const ChartAxis& time);
    void plot(Ui& ui, const CurveInfo& curve, const ChartAxis& time, float height);
    ChartAxis values_of(const CurveInfo& curve, const Rect& area) const;
    void lines(const Ui& ui, const CurveInfo& curve, const Rect& area, const ChartAxis& values) const;
    std::vector<Point> points_at(const CurveInfo& curve, const ChartAxis& values, double time) const;
    void values_at_cursor(Ui& ui, const CurveInfo& curve, const Rect& area, const ChartAxis& values, double time,
                          float x) const;
    void point_at(Ui& ui, const CurveInfo& curve, const ChartAxis& time, const ChartAxis& values) const;

    std::optional<Key> key_;
    std::vector<Path> paths_;  ///< those that stand out last
    std::size_t shown_ = 0;    ///< paths in the picture, of which these are the first
};

}  // namespace mobbscope::app
