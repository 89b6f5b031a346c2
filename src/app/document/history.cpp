#include <app/document/history.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

namespace mobbscope::app {

namespace {

/// A person goes back a few; every state of a large scene costs memory.
constexpr std::size_t kMostStates = 500;

}  // namespace

void History::reset(Document document) {
    states_.clear();
    states_.push_back(std::make_shared<const State>(State{std::move(document), {}, false, 0}));
    now_ = 0;
    group_ = Group::ended;
}

std::size_t History::bytes() const {
    return std::accumulate(states_.begin() + 1, states_.end(), std::size_t{0},
                           [](std::size_t sum, const auto& state) { return sum + state->bytes; });
}

void History::amend(Document document) { amend(std::move(document), states_[now_]->name); }

void History::amend(Document document, const EditName& name) {
    State state = *states_[now_];
    // A view that moves changes nothing of what is held.
    if (document.fitted != state.document.fitted || state.bytes == 0) {
        state.bytes = now_ > 0 ? document.fitted->bytes_beyond(*states_[now_ - 1]->document.fitted) : 0;
    }
    state.document = std::move(document);
    state.name = name;
    states_[now_] = std::make_shared<const State>(std::move(state));
}

void History::amend_views(const std::function<void(ViewState&)>& change) {
    // States of one excerpt share what it was taken from.
    std::map<std::shared_ptr<const ExcerptSource>, std::shared_ptr<const ExcerptSource>> sources;
    for (auto& state : states_) {
        State changed = *state;
        change(changed.document.view);
        for (SceneView& other : changed.document.beside) change(other.view);
        if (std::shared_ptr<const ExcerptSource>& source = changed.document.excerpt_of) {
            std::shared_ptr<const ExcerptSource>& amended = sources[source];
            if (!amended) {
                ExcerptSource next = *source;
                change(next.view);
                amended = std::make_shared<const ExcerptSource>(std::move(next));
            }
            source = amended;
        }
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
    const bool joins =
        group_ == Group::open && now_ > 0 && !name.group.empty() && states_[now_]->name.group == name.group;
    states_.resize(now_ + 1);
    if (joins) {
        amend(std::move(document), name);
    } else {
        append({std::move(document), name, false, 0});
    }
    group_ = Group::open;
}

void History::change_view(Document document, const EditName& name) {
    if (states_[now_]->looked && states_[now_]->name.group == name.group) return amend(std::move(document), name);
    append({std::move(document), name, true, 0});
    group_ = Group::ended;
}

void History::undo() { go_to(now_ - 1); }

void History::redo() { go_to(now_ + 1); }

void History::go_to(std::size_t state) {
    now_ = state;
    group_ = Group::ended;
}

}  // namespace mobbscope::app
