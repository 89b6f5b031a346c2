#include <app/document/history.h>
#include <scene/scene_delta.h>
#include <scene/view_options.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

namespace mobbscope::app {

namespace {

/// A person goes back a few.
constexpr std::size_t kMostStates = 500;

/// A view as it is now, but for what differs between `base` and `goal`: an edit changed that, and it is taken back or
/// brought back. What was changed again since stays.
ViewState carried_view(const ViewState& now, const ViewState& base, const ViewState& goal) {
    ViewState out = now;
    for (const ViewOption& option : view_options()) {
        if (option.same(now, base)) option.copy(goal, out);
    }
    return out;
}

}  // namespace

struct History::Packed {
    SceneDelta scene;
    std::weak_ptr<const Scene> same;  ///< the scene itself, while others hold it: the saved one stays that one
    std::vector<std::shared_ptr<const NamedFit>> fits;
    std::size_t in_use = 0;
    std::vector<std::size_t> in_use_beside;

    std::shared_ptr<const Scene> unpacked(const Scene& base) const {
        std::shared_ptr<const Scene> known = same.lock();
        return known ? known : std::make_shared<const Scene>(scene.applied(base));
    }
};

History::Layout History::layout_of(const Document& document) {
    Layout out{{}, document.place, document.links};
    for (const SceneView& seen : views_of(document)) out.views.push_back(seen.view);
    return out;
}

/// `state`, which is the present one, beside the scene that will be.
History::State History::packed(const State& state, const Scene& base) {
    State out = state;
    const FittedScene& fitted = *out.document.fitted;
    Packed packed{SceneDelta(fitted.scene(), base), fitted.shared_scene(), fitted.fits(), fitted.fit_in_use(), {}};
    for (SceneView& other : out.document.beside) {
        packed.in_use_beside.push_back(other.fitted->fit_in_use());
        other.fitted.reset();
    }
    out.document.fitted.reset();
    out.packed = std::make_shared<const Packed>(std::move(packed));
    return out;
}

void History::unpack(State& state, const Scene& base) {
    const Packed& packed = *state.packed;
    const FittedScene fitted(packed.unpacked(base), packed.fits, packed.in_use);
    state.document.fitted = std::make_shared<const FittedScene>(fitted);
    for (std::size_t i = 0; i < packed.in_use_beside.size(); ++i) {
        state.document.beside[i].fitted =
            std::make_shared<const FittedScene>(fitted.using_fit(packed.in_use_beside[i]));
    }
    state.packed.reset();
}

/// The document `to`, seen as `from` is but for what an edit between them changed: from `base` to `goal` on the way
/// that is gone.
Document History::carried(const Document& from, const Document& to, const Layout& base, const Layout& goal) {
    // An excerpt and its whole are seen each in their way.
    if (from.opening != to.opening) return to;
    Document out = to;
    const std::vector<SceneView> now = views_of(from);
    std::vector<SceneView> views = views_of(to);
    const auto carry = [&](std::size_t place, std::size_t at_goal) {
        const ViewState& seen = now[place].view;
        const FittedScene& fitted = *views[at_goal].fitted;
        ViewState view = carried_view(seen, base.views[place], goal.views[at_goal]);
        if (view.subtree == seen.subtree) keep_part(view, fitted, *now[place].fitted);
        // A query that was opened since may have another index, or another name, there.
        if (seen.query && seen.query != base.views[place].query) {
            const std::optional<int> found = find_query(fitted, query_key(*now[place].fitted, *seen.query));
            const bool as_many = fitted.queries().size() == now[place].fitted->queries().size();
            if (found || !as_many) view.query = found;
        }
        return view;
    };
    const bool as_many_views = now.size() == goal.views.size();
    for (std::size_t place = 0; place < views.size(); ++place) {
        views[place].view = as_many_views ? carry(place, place) : goal.views[place];
    }
    if (!as_many_views) views[goal.place].view = carry(from.place, goal.place);
    set_views(out, std::move(views), as_many_views ? from.place : goal.place);
    out.links = from.links == base.links ? goal.links : from.links;
    out.steps = from.steps;
    out.steps.insert(to.steps.begin(), to.steps.end());
    clamp_views(out);
    return out;
}

void History::reset(Document document) {
    states_.clear();
    states_.push_back(std::make_shared<const State>(State{std::move(document)}));
    now_ = 0;
    group_ = Group::ended;
    forget_looks();
}

std::size_t History::bytes() const {
    return std::accumulate(states_.begin() + 1, states_.end(), std::size_t{0},
                           [](std::size_t sum, const auto& state) { return sum + state->bytes; });
}

/// The present state is another one; its neighbours' scenes are said by what differs from its own.
void History::set_present(State state) {
    const std::shared_ptr<const FittedScene> before = states_[now_]->document.fitted;
    const std::shared_ptr<const FittedScene> after = state.document.fitted;
    states_[now_] = std::make_shared<const State>(std::move(state));
    if (&before->scene() == &after->scene()) return;
    for (const std::size_t neighbour : {now_ - 1, now_ + 1}) {
        if (neighbour >= states_.size()) continue;
        State moved = *states_[neighbour];
        unpack(moved, before->scene());
        const std::size_t trees = after->bytes_beyond(moved.document.fitted->fits());
        states_[neighbour] = std::make_shared<const State>(packed(moved, after->scene()));
        if (neighbour > now_) continue;
        State now = *states_[now_];
        now.bytes = trees + states_[neighbour]->packed->scene.bytes();
        states_[now_] = std::make_shared<const State>(std::move(now));
    }
}

void History::amend(Document document) {
    State state = *states_[now_];
    state.document = std::move(document);
    set_present(std::move(state));
}

void History::amend_views(const std::function<void(ViewState&)>& change) {
    // States of one excerpt share what it was taken from.
    std::map<std::shared_ptr<const ExcerptSource>, std::shared_ptr<const ExcerptSource>> sources;
    for (auto& state : states_) {
        State changed = *state;
        change(changed.document.view);
        for (SceneView& other : changed.document.beside) change(other.view);
        for (Layout* layout : {&changed.before, &changed.after}) std::ranges::for_each(layout->views, change);
        if (std::shared_ptr<const ExcerptSource>& source = changed.document.excerpt_of) {
            std::shared_ptr<const ExcerptSource>& amended = sources[source];
            if (!amended) {
                ExcerptSource next = *source;
                change(next.view);
                for (SceneView& other : next.beside) change(other.view);
                amended = std::make_shared<const ExcerptSource>(std::move(next));
            }
            source = amended;
        }
        state = std::make_shared<const State>(std::move(changed));
    }
    for (Looks* looks : {&looks_before_, &looks_after_}) {
        for (auto& look : *looks) {
            Look changed = *look;
            change(changed.view);
            look = std::make_shared<const Look>(std::move(changed));
        }
    }
}

void History::forget_oldest() {
    while (now_ > 0 && (states_.size() > kMostStates || bytes() > most_bytes_)) {
        states_.erase(states_.begin());
        --now_;
    }
    // Nothing leads to the oldest, so nothing that is done joins it.
    if (states_.front()->name.title.empty()) return;
    State oldest = *states_.front();
    oldest.name = {};
    states_.front() = std::make_shared<const State>(std::move(oldest));
}

void History::change(Document document, const EditName& name) {
    const bool joins =
        group_ == Group::open && now_ > 0 && !name.group.empty() && states_[now_]->name.group == name.group;
    states_.resize(now_ + 1);
    ++moves_;
    if (document.opening != now().opening) forget_looks();
    look_group_.clear();
    State next{std::move(document)};
    next.name = name;
    next.after = layout_of(next.document);
    if (joins) {
        const State& present = *states_[now_];
        next.before = present.before;
        next.bytes = present.bytes;
        // What was looked at meanwhile, such as the time that plays, is none of the edit's changes.
        const Layout now = layout_of(present.document);
        if (now.views.size() == next.before.views.size()) {
            for (std::size_t i = 0; i < now.views.size(); ++i) {
                next.before.views[i] = carried_view(now.views[i], present.after.views[i], next.before.views[i]);
            }
        }
        set_present(std::move(next));
    } else {
        const State& present = *states_[now_];
        next.before = layout_of(present.document);
        State last = packed(present, next.document.fitted->scene());
        next.bytes = next.document.fitted->bytes_beyond(present.document.fitted->fits()) + last.packed->scene.bytes();
        states_[now_] = std::make_shared<const State>(std::move(last));
        states_.push_back(std::make_shared<const State>(std::move(next)));
        ++now_;
    }
    forget_oldest();
    group_ = Group::open;
}

void History::step_to(std::size_t neighbour) {
    const std::shared_ptr<const State> leaving = states_[now_];
    State arriving = *states_[neighbour];
    unpack(arriving, leaving->document.fitted->scene());
    if (arriving.left_at != moves_) {
        arriving.document = neighbour < now_
                                ? carried(leaving->document, arriving.document, leaving->after, leaving->before)
                                : carried(leaving->document, arriving.document, arriving.before, arriving.after);
    }
    if (arriving.document.opening != leaving->document.opening) forget_looks();
    State left = packed(*leaving, arriving.document.fitted->scene());
    left.left_at = moves_;
    states_[now_] = std::make_shared<const State>(std::move(left));
    states_[neighbour] = std::make_shared<const State>(std::move(arriving));
    now_ = neighbour;
}

void History::go_to(std::size_t state) {
    while (now_ != state) step_to(now_ < state ? now_ + 1 : now_ - 1);
    group_ = Group::ended;
    look_group_.clear();
}

void History::forget_looks() {
    looks_before_.clear();
    looks_after_.clear();
    look_group_.clear();
}

/// The present view, as it is found again.
History::Look History::left(const std::string& title) const {
    Look out{now().view, {}, title};
    if (now().view.query) out.query = query_key(*now().fitted, *now().view.query);
    return out;
}

void History::look(Document document, const EditName& name) {
    if (name.group.empty() || look_group_ != name.group) {
        looks_before_.push_back(std::make_shared<const Look>(left(name.title)));
        if (looks_before_.size() > kMostStates) looks_before_.erase(looks_before_.begin());
    } else {
        Look same = *looks_before_.back();
        same.title = name.title;
        looks_before_.back() = std::make_shared<const Look>(std::move(same));
    }
    looks_after_.clear();
    look_group_ = name.group;
    ++moves_;
    group_ = Group::ended;
    amend(std::move(document));
}

void History::turn_to_look(Looks& from, Looks& to) {
    const std::shared_ptr<const Look> next = std::move(from.back());
    from.pop_back();
    to.push_back(std::make_shared<const Look>(left(next->title)));
    Document document = now();
    document.view = next->view;
    if (next->query) document.view.query = find_query(*document.fitted, *next->query);
    clamp_views(document);
    group_ = Group::ended;
    look_group_.clear();
    ++moves_;
    amend(std::move(document));
}

}  // namespace mobbscope::app
