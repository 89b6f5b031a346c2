#include <app/document/history.h>

#include <algorithm>
#include <numeric>
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

QueryKey query_key(const FittedScene& fitted, int query) {
    const Scene& scene = fitted.scene();
    const SceneQuery asked = fitted.queries()[static_cast<std::size_t>(query)];
    // Where all pairs are asked each is asked once.
    const auto end = scene.queries.begin() + (scene.queries.empty() ? 0 : query);
    const auto same = std::count_if(scene.queries.begin(), end, [&](const SceneQuery& other) {
        return other.a.name == asked.a.name && other.b.name == asked.b.name;
    });
    return {asked.a.name, asked.b.name, static_cast<int>(same)};
}

void History::reset(Document document) {
    states_.clear();
    states_.push_back(std::make_shared<const State>(State{std::move(document), {}, false, 0}));
    now_ = 0;
    open_ = false;
}

std::size_t History::bytes() const {
    return std::accumulate(states_.begin() + 1, states_.end(), std::size_t{0},
                           [](std::size_t sum, const auto& state) { return sum + state->bytes; });
}

void History::amend(Document document) {
    State state = *states_[now_];
    // A view that moves changes nothing of what is held.
    if (document.fitted != state.document.fitted || state.bytes == 0) {
        state.bytes = now_ > 0 ? document.fitted->bytes_beyond(*states_[now_ - 1]->document.fitted) : 0;
    }
    state.document = std::move(document);
    states_[now_] = std::make_shared<const State>(std::move(state));
}

void History::amend_views(const std::function<void(ViewState&)>& change) {
    for (auto& state : states_) {
        State changed = *state;
        change(changed.document.view);
        for (SceneView& other : changed.document.beside) change(other.view);
        state = std::make_shared<const State>(std::move(changed));
    }
}

/// Behind the present state, which it becomes; what follows stays.
void History::append(State state) {
    Document document = state.document;
    states_.insert(states_.begin() + static_cast<std::ptrdiff_t>(++now_),
                   std::make_shared<const State>(std::move(state)));
    amend(std::move(document));
    while (now_ > 0 && (states_.size() > kMostStates || bytes() > most_bytes_)) {
        states_.erase(states_.begin());
        --now_;
    }
    // Nothing leads to the oldest, so nothing that is done joins it.
    if (!states_.front()->looked && states_.front()->name.title.empty()) return;
    State oldest = *states_.front();
    oldest.name = {};
    oldest.looked = false;
    states_.front() = std::make_shared<const State>(std::move(oldest));
}

void History::change(Document document, const EditName& name) {
    const bool joins = open_ && now_ > 0 && !name.group.empty() && states_[now_]->name.group == name.group;
    states_.resize(now_ + 1);
    if (joins) {
        amend(std::move(document));
    } else {
        append({std::move(document), name, false, 0});
    }
    open_ = true;
}

void History::change_view(Document document) {
    const std::string title = what_changes(now().view, document.view);
    if (states_[now_]->looked && states_[now_]->name.title == title) return amend(std::move(document));
    append({std::move(document), {title, ""}, true, 0});
    open_ = false;
}

void History::undo() { go_to(now_ - 1); }

void History::redo() { go_to(now_ + 1); }

void History::go_to(std::size_t state) {
    now_ = state;
    open_ = false;
}

}  // namespace mobbscope::app
