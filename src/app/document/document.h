/// What is open: a scene with its fits, and how it is seen. Values; how one becomes another is here too.
#pragma once

#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// A query as it is found again when others were added or removed: the names of its two, and how many queries before it
/// ask the same names.
using QueryKey = std::tuple<std::string, std::string, int>;
/// Requires a query of that index.
QueryKey query_key(const FittedScene& fitted, int query);

/// The index of that query; none if nobody asks it.
std::optional<int> find_query(const FittedScene& fitted, const QueryKey& key);

/// A query as its steps are remembered: other kinds of trees take other tests.
using StepKey = std::pair<QueryKey, mobb::TreeKind>;
/// ... with the fit in use. Requires a query of that index.
StepKey step_key(const FittedScene& fitted, int query);

/// The steps of a query that were looked at.
struct QuerySteps {
    Step left{};                   ///< where it was left
    std::optional<Step> before{};  ///< where the last jump, or the last run of single steps, began; none: none yet
    bool by_one = false;           ///< the last move was a single step
};

/// What all views of a document have in common.
struct ViewLinks {
    bool camera = true;     ///< what the picture is of, from where, how high a second is, and who is followed
    bool time = true;       ///< the time cursor with its slices, and the slab
    bool level = true;      ///< the levels that are shown, whose boxes and disks, and what their colours say
    bool selection = true;  ///< what is selected, in each view its own tree's node over the same samples
    bool query = true;      ///< the query and its step: in each view its own traversal's about the same moment
    friend bool operator==(const ViewLinks&, const ViewLinks&) = default;
};

/// One of these, for whoever goes through all.
struct ViewLink {
    std::string_view name;     ///< as files and scripts call it
    std::string_view command;  ///< that turns it on and off
    std::string_view title, doc;
    bool ViewLinks::*on;
};
inline constexpr std::array<ViewLink, 5> kViewLinks{{
    {"camera", "view.link_cameras", "Link cameras",
     "Of several views: all show space-time, a moment or the floor plan as the active one does, from its camera.",
     &ViewLinks::camera},
    {"time", "view.link_times", "Link times", "Of several views: all show the time and the slab of the active one.",
     &ViewLinks::time},
    {"level", "view.link_levels", "Link levels",
     "Of several views: all show the levels and the agents of the active one, in the same colours.", &ViewLinks::level},
    {"selection", "view.link_selections", "Link selections",
     "Of several views: all point out what is selected; of a node, the one of their tree over the same samples.",
     &ViewLinks::selection},
    {"query", "view.link_queries", "Link queries and steps",
     "Of several views: all show the query of the active one, each at its own step about the same moment.",
     &ViewLinks::query},
}};

/// One view of the document's scene: how it is seen, and with which of its fits.
struct SceneView {
    std::shared_ptr<const FittedScene> fitted;  ///< with the view's fit in use; never null
    ViewState view;
};

/// The most that stand side by side.
inline constexpr std::size_t kMostViews = 4;

/// What an excerpt was taken from. An excerpt is a scene of its own, made of two paths of a run or a scene.
struct ExcerptSource {
    std::shared_ptr<const FittedScene> fitted;  ///< of the whole; never null
    ViewState view;                             ///< of the whole, when it was left
    std::shared_ptr<const FittedScene> saved;   ///< the excerpt as it was made, or saved last
    std::map<StepKey, QuerySteps> steps{};      ///< of the whole
    int opening = 0;                            ///< likewise
    std::vector<SceneView> beside{};            ///< likewise, and what follows
    std::size_t place = 0;
    ViewLinks links{};
};

/// The scene with its fits, and how it is seen: the active view, which commands and panels are about, and those beside
/// it. All views are of one scene. Values: a state once reached can be returned to at no cost, as the
/// scene is immutable and shared.
struct Document {
    std::shared_ptr<const FittedScene> fitted;          ///< with the active view's fit in use; never null
    ViewState view;                                     ///< the active one
    std::shared_ptr<const ExcerptSource> excerpt_of{};  ///< of an excerpt; else null
    std::vector<SceneView> beside{};                    ///< the other views, from left to right
    std::size_t place = 0;                              ///< how many of them stand to the left of the active one
    ViewLinks links{};                                  ///< what the views have in common
    std::map<StepKey, QuerySteps> steps{};              ///< that were looked at
    int opening = 0;                                    ///< which one it is of: of files or an excerpt, each its own
};

/// The document that an excerpt was taken from, as it was left.
Document whole_of(const ExcerptSource& source);

/// All views of a document, from left to right.
std::vector<SceneView> views_of(const Document& document);
/// These are its views now, at least one, and the one at `place` is active.
void set_views(Document& document, std::vector<SceneView> views, std::size_t place);

/// A scene with the fit that it says, seen as it says; trees that `previous` (null: none) has are shared. Throws
/// what `progress` throws, such as Cancelled, and std::invalid_argument if a fit option is out of range: those of a
/// scene that was read are checked.
Document document_of(Scene scene, const FittedScene* previous, const Progress& progress = {});

/// The document with another scene, whose `fit` are the options of the fit in use and whose `view` is the active one.
/// Its other fits and views are made anew for that scene; trees that `present` or `fitted_beside` (null: none) has are
/// shared. Throws as document_of does.
Document with_scene(const Document& present, Scene scene, const FittedScene* fitted_beside = nullptr,
                    const Progress& progress = {});

/// The place of a fit of those options among `fitted.fits()`; it is made if there is none, under that name or with a
/// number behind it. Throws std::invalid_argument for options out of range, or an empty name.
std::size_t fit_with(FittedScene& fitted, const std::string& name, const mobb::FitOptions& options);

/// Whether with_scene is done in an instant.
bool quick_to_fit(const Scene& scene, const FittedScene& present, const FittedScene* fitted_beside);

/// The view has the part of a tree that it shows alone from one of `before`: of `now` that is the node over the same
/// samples; where there is none, nothing is alone any more.
void keep_part(ViewState& view, const FittedScene& now, const FittedScene& before);
/// The view without what the scene does not have: queries, names, nodes.
ViewState clamped(ViewState view, const FittedScene& fitted);
/// The same of all views of a document.
void clamp_views(Document& document);

}  // namespace mobbscope::app
