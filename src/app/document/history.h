/// The document and its past: undo and redo of every edit.
#pragma once

#include <app/document/document.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// Groups what belongs together: one drag, one number that keys change.
struct EditName {
    std::string title;  ///< "moving A: x 1.20 m", for the menu ("Undo moving A: ...") and the list; of a group the last
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
    /// Only how it is seen has changed. Looking around of one group (moving the view, stepping ...) is one state, and
    /// it does not clear what can be redone.
    void change_view(Document document, const EditName& name);
    /// The present state is this instead; no edit of its own.
    void amend(Document document);
    /// How the scene is seen is changed in all states, also how the whole of an excerpt was.
    void amend_views(const std::function<void(ViewState&)>& change);
    /// The next edit starts a group of its own, even under the same name.
    void close_group() {
        if (group_ == Group::open) group_ = Group::closed;
    }
    /// ... but for one that goes on with the last: not where something else was done, or undone, since.
    void reopen_group() {
        if (group_ == Group::closed) group_ = Group::open;
    }

    bool has_open_group() const { return group_ == Group::open; }

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
    void amend(Document document, const EditName& name);

    std::size_t most_bytes_;
    std::vector<std::shared_ptr<const State>> states_;  ///< never null; copies of the history share them
    std::size_t now_ = 0;
    enum class Group { open, closed, ended } group_ = Group::ended;  ///< of the present state
};

}  // namespace mobbscope::app
