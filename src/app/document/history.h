/// The document and its past: undo and redo of edits, and the way back through how it was seen.
#pragma once

#include <app/document/document.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// Groups what belongs together: one drag, one number that keys change.
struct EditName {
    std::string title;  ///< "moving A: x 1.20 m", for the menu ("Undo moving A: ...") and the list; of a group the last
    std::string group;  ///< an edit joins the last one if both have this group and it is still open; empty: never
};

/// Undo takes back edits alone: how the document is seen stays, but for what the edit itself changed of it. Looking
/// around has a past of its own. Goes back at most 499 edits, and no further than they hold kMostBytes: the oldest are
/// forgotten first. A state that is not the present one takes memory for what its edit changed, whatever the scene's
/// size.
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
    void undo() { go_to(now_ - 1); }
    void redo() { go_to(now_ + 1); }
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
    /// What the edits hold, roughly.
    std::size_t bytes() const;

    // How it is seen.
    /// Only how it is seen has changed. Looking of one group (moving the view, stepping ...) is one look.
    void look(Document document, const EditName& name);
    bool can_look_back() const { return !looks_before_.empty(); }
    bool can_look_forward() const { return !looks_after_.empty(); }
    /// The view before the last look (after the next), on the scene as it is now. Requires can_look_back()
    /// (can_look_forward()).
    void look_back() { turn_to_look(looks_before_, looks_after_); }
    void look_forward() { turn_to_look(looks_after_, looks_before_); }
    /// What looking back (forward) would take back (bring back); empty if nothing.
    std::string look_back_title() const { return can_look_back() ? looks_before_.back()->title : ""; }
    std::string look_forward_title() const { return can_look_forward() ? looks_after_.back()->title : ""; }

  private:
    /// How all views of a document are seen, from left to right.
    struct Layout {
        std::vector<ViewState> views;
        std::size_t place = 0;  ///< of the active one
        ViewLinks links{};
    };
    /// The scene and fits of a document whose `fitted` are null, by what its neighbour towards the present has not.
    struct Packed;
    struct State {
        Document document;                       ///< with its scene and fits if it is the present one
        std::shared_ptr<const Packed> packed{};  ///< else these; null of the present one
        EditName name{};                         ///< of the edit that led here
        Layout before{}, after{};                ///< how it was seen just before and after that edit
        std::size_t bytes = 0;                   ///< that the edit takes
        std::size_t left_at = 0;                 ///< `moves_` when it was left last
    };
    /// A view that was left.
    struct Look {
        ViewState view;
        std::optional<QueryKey> query{};  ///< of the view's query
        std::string title{};              ///< of the look that led away from it, or back to it
    };
    using Looks = std::vector<std::shared_ptr<const Look>>;

    static Layout layout_of(const Document& document);
    static State packed(const State& state, const Scene& base);
    static void unpack(State& state, const Scene& base);
    static Document carried(const Document& from, const Document& to, const Layout& base, const Layout& goal);

    void set_present(State state);
    void step_to(std::size_t neighbour);
    void forget_oldest();
    void forget_looks();
    void turn_to_look(Looks& from, Looks& to);
    Look left(const std::string& title) const;

    std::size_t most_bytes_;
    std::vector<std::shared_ptr<const State>> states_;  ///< never null; copies of the history share them
    std::size_t now_ = 0;
    enum class Group { open, closed, ended } group_ = Group::ended;  ///< of the present state

    Looks looks_before_, looks_after_;  ///< the nearest last
    std::string look_group_;            ///< of the last look, while others may join it
    std::size_t moves_ = 1;             ///< counts edits and looks: what was left since the last is found as it was
};

}  // namespace mobbscope::app
