#include <app/history.h>

#include <utility>

namespace mobbscope::app {

namespace {

/// A person goes back a few; every state of a large scene costs memory.
constexpr std::size_t kMostStates = 500;

/// In words: looking around of one kind is taken back in one go, but not along with another.
std::string what_changes(const ViewState& from, const ViewState& to) {
    if (from.query != to.query) return "choosing what is asked";
    const auto only = [&](auto... members) {
        ViewState view = from;
        ((view.*members = to.*members), ...);
        return view == to;
    };
    if (only(&ViewState::camera, &ViewState::time_height)) return "moving the view";
    if (only(&ViewState::step)) return "stepping";
    if (only(&ViewState::time)) return "moving in time";
    if (only(&ViewState::follow, &ViewState::camera, &ViewState::time_height, &ViewState::time)) return "following";
    return "what is shown";
}

}  // namespace

void History::reset(Document document) {
    states_.clear();
    states_.push_back({std::move(document), {}, false});
    now_ = 0;
    open_ = false;
}

void History::change(Document document, const EditName& name) {
    const bool joins = open_ && now_ > 0 && !name.group.empty() && states_[now_].name.group == name.group;
    states_.resize(now_ + 1);
    if (joins) {
        states_[now_].document = std::move(document);
    } else {
        states_.push_back({std::move(document), name, false});
        if (states_.size() > kMostStates) states_.erase(states_.begin());
        now_ = states_.size() - 1;
    }
    open_ = true;
}

void History::look(const ViewState& view) {
    const std::string title = what_changes(now().view, view);
    if ((states_[now_].looked && states_[now_].name.title == title) || can_redo()) {
        states_[now_].document.view = view;
        return;
    }
    change({now().fitted, view, now().origin}, {title, ""});
    states_[now_].looked = true;
    open_ = false;
}

void History::undo() {
    --now_;
    open_ = false;
}

void History::redo() {
    ++now_;
    open_ = false;
}

}  // namespace mobbscope::app
