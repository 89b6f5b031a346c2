/// What pictures of one scene have in common, from whatever side and at whatever time: the disks of its paths, the
/// figures of its nodes, and the query with its proof.
#pragma once

#include <explain/query_proof.h>
#include <explain/scene_figures.h>
#include <render/drawlist/draw_list.h>
#include <render/drawlist/shown_points.h>
#include <render/layout/box_colors.h>
#include <render/layout/color_bar.h>
#include <render/layout/framing.h>
#include <render/parts/paths.h>
#include <render/query/floor_boundary.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

/// Keeps what the last picture in space-time had. The same pictures come out as without. Not for several threads.
class KeptPaths {
  public:
    /// `figures`: of whatever scenes; never null.
    explicit KeptPaths(std::shared_ptr<const FittedScene> fitted,
                       std::shared_ptr<SceneFigures> figures = std::make_shared<SceneFigures>())
        : fitted_(std::move(fitted)), figures_(std::move(figures)) {}

    const std::shared_ptr<const FittedScene>& fitted() const { return fitted_; }

    /// Those of the scene that a view of a run shows (fitted_at), kept as long as the views show the same
    /// kind of picture, time and window; of any other scene these themselves.
    KeptPaths& shown_in(const ViewState& view);

    /// The query of a view, which must have one, and the proof of its answer: of the last query that was asked for,
    /// each made once.
    const RecordedQuery& recorded(const ViewState& view);
    const QueryProof& proof(const ViewState& view);
    /// Somebody has made the proof of the view's query already.
    void adopt_proof(const ViewState& view, std::shared_ptr<const QueryProof> proof);

    /// bounds_of the agents of a view.
    const Bounds& bounds(std::span<const DrawnAgent> agents, const ViewState& view);

    /// Sets the list's disks to those of the agents' paths, each with its focus. Needs the list's space. Returns them
    /// as points that the picture has to show: those of whom it shows, or of all where everybody is hidden.
    const ShownPoints& add_disks_of(DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view,
                                    std::vector<PathFocus> foci);

    /// What colours the boxes of the view that is drawn next, where pictures stand beside it; null: that of the view
    /// alone (box_colors).
    void adopt_colors(std::shared_ptr<const BoxColors> colors) { box_colors_ = std::move(colors); }
    /// Gives the list's boxes of levels the colours of the view's figure. Returns the bar of these; none: they have
    /// their agents'.
    std::optional<ColorBar> color_boxes(DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view);
    /// The bar of the disks' colours in the last list; none: they have their agents'.
    std::optional<ColorBar> heat_bar() const;

    /// floor_boundary of a view's query.
    const FloorLines& boundary(const ViewState& view);

    /// Of a query of the scene's trees in standard placements, each against itself: the mean over the clips, counted.
    /// None where one of them has no cost (why_no_cost).
    std::optional<double> box_tests();

  private:
    void add_places_of_all(const DrawList& list, std::span<const DrawnAgent> agents);
    int clip_of(const DrawnAgent& agent) const;
    void find_heat(std::span<const DrawnAgent> agents, const Palette& palette, Theme theme);

    struct Shapes {
        std::optional<int> query;
        glm::dvec3 origin{0};
        double time_height = 0;
        double time_window = 0;   ///< of a run, whose window begins at the origin's time
        std::vector<bool> whole;  ///< by agent
        Arrange arrange = Arrange::none;
        friend bool operator==(const Shapes&, const Shapes&) = default;
    };
    struct Colors {
        Theme theme = Theme::dark;
        std::vector<PathFocus> foci;
        std::vector<Rgba> agents;
        friend bool operator==(const Colors&, const Colors&) = default;
    };

    /// The colours of disks by how many tests of boxes hold them.
    struct Heat {
        Theme theme = Theme::dark;
        std::int64_t revision = 0;  ///< of the figures
        std::set<int> clips;        ///< that are drawn
        ColorScale scale{};
        std::map<int, std::shared_ptr<const std::vector<Rgba>>> colors{};  ///< by clip
    };

    struct Moment {
        Show show{};
        std::optional<double> time;
        double window = 0;
        friend bool operator==(const Moment&, const Moment&) = default;
    };

    std::shared_ptr<const FittedScene> fitted_;
    std::shared_ptr<SceneFigures> figures_;
    std::shared_ptr<const BoxColors> box_colors_;
    std::optional<Heat> heat_;
    bool shows_heat_ = false;  ///< in the last list
    Moment moment_;
    std::unique_ptr<KeptPaths> at_moment_;  ///< of a run
    /// By the view's query and arrangement.
    std::optional<std::pair<std::pair<std::optional<int>, Arrange>, Bounds>> bounds_;
    struct Asked {
        int query = 0;
        std::shared_ptr<const RecordedQuery> recorded;
        std::shared_ptr<const QueryProof> proof{};
    };
    std::optional<Asked> asked_;
    std::optional<std::pair<int, FloorLines>> boundary_;  ///< by query
    std::optional<std::optional<double>> box_tests_;
    std::optional<Shapes> shapes_;
    Colors colors_;
    SharedValues<DiskInstance> disks_;
    ShownPoints points_;
};

}  // namespace mobbscope
