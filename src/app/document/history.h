/// The document and its past: undo and redo of every edit.
#pragma once

#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// A query as it is found again when others were added or removed: the names of its two, and how many queries before it
/// ask the same names.
using QueryKey = std::tuple<std::string, std::string, int>;
/// Requires a query of that index.
QueryKey query_key(const FittedScene& fitted, int query);

/// What an excerpt was taken from. An excerpt is a scene of its own, made of two paths of a run or a crowd.
struct ExcerptSource {
    std::shared_ptr<const FittedScene> fitted;  ///< of the whole; never null
    ViewState view;                             ///< of the whole, when it was left
    std::shared_ptr<const FittedScene> saved;   ///< the excerpt as it was made, or saved last
    std::map<QueryKey, Step> steps{};           ///< of the whole: where queries were left
};

/// One view of the document's scene: how it is seen, and with which of its fits.
struct SceneView {
    std::shared_ptr<const FittedScene> fitted;  ///< with the view's fit in use; never null
    ViewState view;
};

/// The scene with its fits, and how it is seen: the active view, which commands and panels are about, and those beside
/// it. All views are of one scene and one time. Values: a state once reached can be returned to at no cost, as the
/// scene is immutable and shared.
struct Document {
    std::shared_ptr<const FittedScene> fitted;          ///< with the active view's fit in use; never null
    ViewState view;                                     ///< the active one
    std::shared_ptr<const ExcerptSource> excerpt_of{};  ///< of an excerpt; else null
    std::vector<SceneView> beside{};                    ///< the other views, from left to right
    std::size_t place = 0;                              ///< how many of them stand to the left of the active one
    bool linked_cameras = true;                         ///< all views have one camera
    std::map<QueryKey, Step> steps{};                   ///< where queries were left
};

/// Groups what belongs together: one drag, one number typed.
struct EditName {
    std::string title;  ///< "Move A", for the menu: "Undo Move A"
    std::string group;  ///< an edit joins the last one if both have this group and it is still open; empty: never
};

/// Goes back at most 499 states, and no further than the states hold kMostBytes beyond the oldest (scenes share what
/// they have in common): the oldest are forgotten first, and undo then ends at the oldest that is left.
class History {
  public:
    static constexpr std::size_t kMostBytes = std::size_t{512} << 20;

    explicit History(Document document, std::size_t most_bytes = kMostBytes) : most_bytes_(most_bytes) {
        reset(std::move(document));
    }

    const Document& now() const { return states_[now_]->document; }

    /// Forgets the past: another file was opened.
    void reset(Document document);
    /// The document is now this; what was undone is forgotten.
    void change(Document document, const EditName& name);
    /// Only how it is seen has changed. Looking around of one kind (moving the view, stepping ...) is one state, and it
    /// does not clear what can be redone.
    void change_view(Document document);
    /// The present state is this instead; no edit of its own.
    void amend(Document document);
    /// How the scene is seen is changed in all states.
    void amend_views(const std::function<void(ViewState&)>& change);
    /// The next edit starts a group of its own, even under the same name.
    void close_group() { open_ = false; }

    bool can_undo() const { return now_ > 0; }
    bool can_redo() const { return now_ + 1 < states_.size(); }
    /// Requires can_undo() (can_redo()).
    void undo();
    void redo();
    /// What undo (redo) would take back (bring back); empty if nothing.
    std::string undo_title() const { return can_undo() ? states_[now_]->name.title : ""; }
    std::string redo_title() const { return can_redo() ? states_[now_ + 1]->name.title : ""; }

    // States count from the oldest that is left.
    std::size_t count() const { return states_.size(); }
    std::size_t place() const { return now_; }
    /// What led to a state < count(); empty for the oldest.
    const std::string& title(std::size_t state) const { return states_[state]->name.title; }
    /// To a state < count(), as so many undos or redos do.
    void go_to(std::size_t state);
    /// What the states hold beyond the oldest, roughly.
    std::size_t bytes() const;

  private:
    struct State {
        Document document;
        EditName name;  ///< of the edit that led here
        bool looked = false;
        std::size_t bytes = 0;  ///< that the state before does not share
    };
    void append(State state);

    std::size_t most_bytes_;
    std::vector<std::shared_ptr<const State>> states_;  ///< never null; copies of the history share them
    std::size_t now_ = 0;
    bool open_ = false;
};

}  // namespace mobbscope::app
