/// The parts of the query panel, and the pictures of a trace that the timeline shows too. Each draws itself at the
/// cursor of the current ImGui window.
#pragma once

#include <app/document/query_look.h>
#include <app/panels/curves.h>
#include <app/panels/event_list.h>
#include <app/panels/level_strip.h>
#include <app/panels/recursion_picture.h>
#include <app/ui/ui.h>
#include <app/ui/widgets.h>
#include <explain/bodies.h>
#include <explain/query_findings.h>
#include <explain/trace_comparison.h>
#include <render/layout/box_colors.h>
#include <render/query/map_colors.h>
#include <scene/drawn_agent.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// A button of this panel, marked "query.<the command's last word>".
void query_button(Ui& ui, const char* label, const char* command);

// These need a query in the view and its findings.
class QueryBodies;
void query_answer(Ui& ui, QueryInspector& queries, const QueryFindings& findings, QueryBodies& bodies);
/// The lines of the proof as rows, and what the trees found instead. Nothing without lines.
void proof_section(Ui& ui, const QueryFindings& findings);
/// The line that the time cursor is in; none: it is in none.
std::optional<std::size_t> selected_line(const Workspace& workspace, const QueryProof& proof);
/// Lines of a proof, first .. last, that stand on the same pixel of an axis: a proof may have thousands.
struct LineRun {
    std::size_t first = 0, last = 0;
};
/// In order; the selected line is a run of its own.
std::vector<LineRun> line_runs(const QueryProof& proof, const ChartAxis& time, std::optional<std::size_t> selected);
/// The lines of the proof over their times, as bars with gaps; a click goes to one.
void proof_bars(Ui& ui, const QueryFindings& findings, const ChartAxis& time, ImVec2 corner, ImVec2 size);
void query_counters(Ui& ui, QueryInspector& queries, const QueryFindings& findings);
/// Says where recording stopped, if it did: below whatever shows the whole trace, "query.stopped.<where>".
void recording_note(Ui& ui, const std::string& where);
/// Buttons that step, and the slider over the trace.
void step_transport(Ui& ui);
/// What the event under test found, and of which nodes.
void current_test(Ui& ui, const QueryFindings& findings);
/// Both nodes projected on time and on every axis of a box test.
void why_axes(Ui& ui, const QueryFindings& findings);
/// Of a moment, a point of the recursion map or a sample: the tests that decided about it.
void reasons(Ui& ui, QueryInspector& queries, const QueryFindings& findings);
/// Where the tests are: branches of this query, or nodes over all queries of the scene.
void costliest(Ui& ui, QueryInspector& queries, CostInspector& costs, const QueryFindings& findings);
/// The pairs of samples that were measured.
void measured_pairs(Ui& ui, const QueryFindings& findings);
/// The pairs from the root to the present one, each a button, in what room the line has; those in the middle give way.
void way_to_pair(Ui& ui, const QueryFindings& findings);
/// The scene's breakpoints, each with how often it holds here, and a field for another one.
void break_when(Ui& ui, QueryInspector& queries);
/// The scene's bookmarks, with the notes on them.
void bookmarks(Ui& ui);

/// Decisions of a traversal that stand on one pixel, as the deepest of them.
struct DecisionCell {
    float x0 = 0, x1 = 0;  ///< pixels from the left
    int depth = 0;
    EventMark mark{};
};

/// The map of placements, with what it was last drawn from.
class MapPicture {
  public:
    /// Looks at the cells of another map than before. The rest is about this map.
    void follow(const std::shared_ptr<const PlacementMap>& map);
    /// The colours as they are while nobody has chosen others.
    const MapColors& usual_colors() const { return usual_colors_; }
    /// How many cells have values in equal parts of their range.
    const std::vector<std::size_t>& counts() const { return counts_; }
    void remake(const MapColors& colors, const Style& style, const Rect& area);
    void draw(Ui& ui, const Rect& area) const;

  private:
    struct Key {
        MapColors colors;
        bool dark = false;
        glm::vec2 min{0}, max{0};
        friend bool operator==(const Key&, const Key&) = default;
    };
    std::shared_ptr<const PlacementMap> map_;
    MapColors usual_colors_;
    std::vector<std::size_t> counts_;
    std::optional<Key> key_;  ///< what the image is of; none where it is of another map
    std::shared_ptr<const Image> image_;
    std::vector<PixelLine> hatch_;
};

/// The scene's named views as small pictures: one is drawn a frame, when it is shown first, and none amid a drag.
class ViewPictures {
  public:
    /// Nothing where the scene has none.
    void section(Ui& ui);

  private:
    struct Kept {
        std::shared_ptr<const FittedScene> fitted{};  ///< null: none is made yet
        ViewState view{};
        PictureSize size{};
        std::int64_t counted = 0;              ///< the revision of the figures that colour it; 0: none do
        std::shared_ptr<const Image> image{};  ///< null: it cannot be drawn
        bool shows(const Kept& wanted) const;
    };
    void one(Ui& ui, std::size_t index, ImVec2 size);
    void make(Session& session, std::size_t index, Kept wanted);

    std::vector<Kept> kept_;  ///< by the views' places in the scene
    bool makes_one_ = false;  ///< in this frame, and has not yet
};

/// Whose bars the timeline shows: found when that changes.
class PathBars {
  public:
    /// Those of the view that are not hidden. Valid until it changes.
    const std::vector<DrawnAgent>& of(const Workspace& workspace);

  private:
    std::shared_ptr<const FittedScene> of_;  ///< `shown_` refers to it
    std::optional<int> query_;
    std::vector<std::string> hidden_;
    std::vector<DrawnAgent> shown_;
};

/// How the figures of the boxes in the picture are spread: counted when they change.
struct BoxFigures {
    std::shared_ptr<const BoxColors> of{};
    ColorScale whole{};  ///< with a place for all of them, and of the pictures beside
    std::vector<std::size_t> counts{};
};

/// How near the bones of the query in view come to each other.
class QueryBodies {
  public:
    /// Found at the first call, or once measured where that takes long; null: not yet, or there are no skeletons.
    const BodyDistances* of(const std::shared_ptr<const QueryFindings>& findings);
    /// Whether bodies touch, in sentences, and a button to that moment.
    void show(Ui& ui, const std::shared_ptr<const QueryFindings>& findings);

  private:
    void measure(Ui& ui);

    struct Known {
        std::shared_ptr<const QueryFindings> of;
        std::optional<BodyDistances> distances;
    };
    std::shared_ptr<Known> known_;  ///< shared with the job that measures
};

/// The pictures of a trace, each with the cells that it was last drawn from: most frames draw the same ones.
class QueryPictures {
  public:
    EventTable events;
    DataTable nodes;
    LevelStrip levels;
    CurvePlots curves;
    QueryBodies bodies;
    /// Called above the pictures of a panel that scrolls: what the mouse is on below stays there when what stands above
    /// grows, so that a click may be the first of two.
    void stay();
    /// A's time by B's: every pair of nodes that was tested.
    void square(Ui& ui, QueryInspector& queries, const QueryFindings& findings);
    /// How far A and B are apart at each moment.
    void clearance(Ui& ui, QueryInspector& queries, const QueryFindings& findings, float height);
    /// The events of the trace as a strip, the present one marked; click and drag set the step. Nothing without a query
    /// in the view.
    void strip(Ui& ui, QueryInspector& queries, float width, float height);
    /// The recursion, depth downwards: a click steps to a pair's last test, or to the
    /// test that it is on. The wheel zooms it and the strip, a drag shifts it. Nothing without a query in the view.
    void icicle(Ui& ui, QueryInspector& queries, ImVec2 size);

    /// The query under another fit, or its stored trace, beside the present one.
    void compare(Ui& ui, QueryInspector& queries, const QueryFindings& findings);

    MapPicture map;
    ViewPictures views;
    PathBars paths;
    BoxFigures box_figures;

  private:
    void compare_strips(Ui& ui, QueryInspector& queries, const std::shared_ptr<const FitComparison>& other);
    void shift_icicle(Ui& ui, const EventRange& range, int count, float width, float most_scroll);

    /// What cells were made for.
    struct Cut {
        int width = 0, height = 0;  ///< pixels
        EventRange range{};
        FocusWindow focus{};
        friend bool operator==(const Cut&, const Cut&) = default;
    };
    template <class Cell>
    class Kept {
      public:
        /// The cells of these findings, made if they are not what is kept. Valid until the next call.
        template <class Make>
        const std::vector<Cell>& of(const std::shared_ptr<const QueryFindings>& findings, const Cut& cut,
                                    const Make& make) {
            const auto wanted = std::pair(findings, cut);
            if (made_for_ != wanted) cells_ = make();
            made_for_ = wanted;
            return cells_;
        }

      private:
        std::optional<std::pair<std::shared_ptr<const QueryFindings>, Cut>> made_for_;
        std::vector<Cell> cells_;
    };
    Kept<PairCell> square_, icicle_;
    Kept<ValueColumn> clearance_;
    Kept<StripCell> strip_;
    struct {
        std::shared_ptr<const FitComparison> of;
        int width = 0;
        std::array<std::vector<DecisionCell>, 2> sides;
        int depth = 0;  ///< of the deepest
    } compared_;
    bool compares_ = false;  ///< something was compared in the last frame
    float top_ = 0;          ///< where stay() was called last, pixels
    float scroll_ = 0;       ///< of the icicle, pixels
    int followed_ = -1;      ///< the step that was brought into strip and icicle last
    struct {
        EventRange range;
        float scroll = 0;
    } held_;  ///< when the drag of the icicle began
};

}  // namespace mobbscope::app
