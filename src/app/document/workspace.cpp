#include <app/document/edit_names.h>
#include <app/document/workspace.h>
#include <explain/query_progress.h>
#include <render/drawlist/camera.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

namespace mobbscope::app {

namespace {

/// Agents whose pairs are still listed one by one.
constexpr std::size_t kFewAgents = 12;
constexpr std::size_t kKeptCosts = 64;  // of trees: more than charts and views show at once

/// What was found out about the queries of a scene holds of all that ask the same.
template <class Found>
auto found_of_scene(const Found& found, const FittedScene& of) {
    const auto at = std::ranges::find_if(
        found, [&](const auto& each) { return each.first.get() == &of || ask_the_same(*each.first, of); });
    return at == found.end() ? nullptr : at->second;
}

/// Of as many scenes as there may be views; the latest first.
template <class Found, class What>
void keep_of_scene(Found& found, const std::shared_ptr<const FittedScene>& of, What what) {
    std::erase_if(found, [&](const auto& known) { return ask_the_same(*known.first, *of); });
    found.insert(found.begin(), {of, std::move(what)});
    if (found.size() > kMostViews) found.pop_back();
}

}  // namespace

std::shared_ptr<const FittedScene> ShownRun::at(const std::shared_ptr<const FittedScene>& whole,
                                                const ViewState& view) {
    if (!is_run(whole->scene())) return whole;
    const double now = run_time(whole->scene(), view);
    if (of != whole || time != now || window != view.time_window || show != view.show) {
        *this = {whole, now, view.time_window, view.show, std::make_shared<const FittedScene>(fitted_at(*whole, view))};
    }
    return fitted;
}

Workspace::Workspace(Settings& settings)
    : history(document_of({}, nullptr)),
      saved(document().fitted),
      settings_(&settings),
      pointed_into_(document().fitted) {}

bool Workspace::modified() const {
    // Views of one scene share it, whichever fit they use.
    const auto differ = [](const auto& a, const auto& b) { return &a->scene() != &b->scene(); };
    const std::shared_ptr<const ExcerptSource>& origin = document().excerpt_of;
    // Of views side by side one may be left that has another fit, which would be saved.
    const bool is_left = document().beside.empty() && document().fitted->options() != saved->options();
    if (!origin) return is_left || differ(document().fitted, saved);
    return differ(origin->fitted, saved) || differ(document().fitted, origin->saved);
}

std::string Workspace::title() const {
    std::string whole = scene().file.stem().empty() ? "untitled" : scene().file.stem().string();
    if (file) whole = file->filename().string();
    if (!in_excerpt()) return whole;
    std::string title = scene().agents.empty() ? "excerpt" : scene().agents.front().name;
    if (scene().agents.size() > 1) title += " and " + scene().agents[1].name;
    return title.append(" of ").append(whole);
}

const RecordedQuery* Workspace::recorded() const {
    if (!view().query) return nullptr;
    Derived& d = derived();
    if (!d.recorded || d.recorded->first != *view().query) {
        d.forget_findings();
        d.recorded.emplace(*view().query, fitted().recorded(static_cast<std::size_t>(*view().query)));
    }
    return d.recorded->second.get();
}

int Workspace::step() const { return event_of(view().step, recorded()->trace, fitted(), *view().query); }

Scene Workspace::changed_scene(const std::function<void(Scene&)>& change) const {
    Scene next = scene();
    next.view = view();
    next.fit = document().fitted->options();
    change(next);
    mobb::check(next.fit);
    if (next.fit != document().fitted->options()) drop_traces(next);
    return next;
}

void Workspace::edit(const EditName& name, const std::function<void(Scene&)>& change) {
    change_document(with_scene(document(), changed_scene(change)), name);
}

void Workspace::edit_debug(const std::string& title, const std::function<void(DebugState&)>& change) {
    DebugState next = scene().debug;
    change(next);
    if (next == scene().debug) return;
    edit({title, ""}, [&](Scene& scene) { scene.debug = std::move(next); });
}

void Workspace::change_view(const std::function<void(ViewState&)>& change, const std::optional<EditName>& name) {
    Document next = document();
    change(next.view);
    next.view = clamped(next.view, *next.fitted);
    if (next.view == view()) return;
    if (next.view.theme != view().theme) settings_->theme = next.view.theme;
    const std::optional<VisitedStep> left = present_step();
    const bool goes_on = stepping_;
    remember_step(next);
    const EditName as = name ? *name : name_of_looking(document(), next.view);
    history.look(std::move(next), as);
    changed();
    visited.moved(left, present_step(), goes_on);
}

void Workspace::go_to_event(int event) {
    change_view([&](ViewState& view) { view.step = {Step::Unit::event, static_cast<double>(event)}; });
}

void Workspace::change_document(Document next, const EditName& name) {
    clamp_views(next);
    remember_step(next);
    history.change(std::move(next), name);
    changed();
}

void Workspace::amend(const std::function<void(Document&)>& change) {
    amend_quietly(change);
    changed();
}

void Workspace::amend_quietly(const std::function<void(Document&)>& change) {
    Document next = document();
    change(next);
    history.amend(std::move(next));
}

void Workspace::activate(std::size_t place) {
    amend_quietly([&](Document& next) { set_views(next, views_of(next), place); });
    followed_ = step_to_follow();
    changed();
}

bool Workspace::is_framed(const Camera& camera) const {
    return std::ranges::any_of(framings, [&](const Camera& one) { return standing_as(camera, one) == camera; });
}

/// Cameras that hold the whole go on to do so when pictures become narrower or wider. The direction stays.
void Workspace::frame_again() {
    const std::size_t views = document().beside.size() + 1;
    if (std::exchange(views_framed_, views) == views) return;
    const auto frame = [this](ViewState& view) {
        if (view.follow.empty() && is_framed(view.camera)) view.camera = without_target(view.camera);
    };
    amend_quietly([&](Document& next) {
        frame(next.view);
        for (SceneView& other : next.beside) frame(other.view);
    });
}

Workspace::FollowedStep Workspace::step_to_follow() const {
    FollowedStep out{document().fitted, view().query, view().step, {}, document().links.query};
    for (const SceneView& other : document().beside) out.others.push_back(other.fitted);
    return out;
}

const Workspace::LinkedTraversals& Workspace::linked_traversals(const SceneView& other) {
    const std::shared_ptr<const FittedScene>& active = document().fitted;
    const int query = *view().query;
    const auto known = std::ranges::find_if(linked_, [&](const LinkedTraversals& each) {
        return each.active == active && each.other == other.fitted && each.query == query;
    });
    if (known != linked_.end()) return *known;
    if (linked_.size() >= kMostViews) linked_.pop_back();
    LinkedTraversals made{active, other.fitted, query, other.fitted->recorded(static_cast<std::size_t>(query)), {}};
    const SceneQuery asked = active->queries()[static_cast<std::size_t>(query)];
    const auto decisions = [&](const FittedScene& fitted, const RecordedQuery& recorded) {
        return decisions_of(fitted.placed(asked.a), fitted.placed(asked.b), recorded);
    };
    made.traversals = compared(decisions(*active, *recorded()), decisions(*other.fitted, *made.recorded));
    return *linked_.insert(linked_.begin(), std::move(made));
}

/// Where another view stands when it goes along with the active one.
Step Workspace::step_in(const SceneView& other) {
    const Step& now = view().step;
    if (now.unit == Step::Unit::end || recorded()->trace.empty()) return now;
    const LinkedTraversals& both = linked_traversals(other);
    const SceneQuery asked = fitted().queries()[static_cast<std::size_t>(*view().query)];
    const RecordedTraversal here{fitted().placed(asked.a), fitted().placed(asked.b), recorded()};
    const RecordedTraversal there{other.fitted->placed(asked.a), other.fitted->placed(asked.b), both.recorded.get()};
    return {Step::Unit::event, static_cast<double>(matching_step(both.traversals, here, there, step(), view().time))};
}

/// The node of its trees that is over the same samples as a node of the active view.
std::optional<DrawnNode> Workspace::node_in(const SceneView& other, const std::optional<DrawnNode>& node) const {
    if (!node || crowd()) return node;
    const Selection here{Selection::Kind::node, agent_in_view(fitted(), view(), node->agent), node->node};
    return DrawnNode{node->agent, counterpart(here, fitted(), *other.fitted).index};
}

/// What views have in common they show as the active one does.
void Workspace::share_linked() {
    const FollowedStep now = step_to_follow();
    const bool moved = std::exchange(followed_, now) != now;
    if (document().beside.empty()) return;
    const ViewState active = view();
    const ViewLinks links = document().links;
    std::vector<SceneView> beside = document().beside;
    for (SceneView& other : beside) {
        ViewState view = other.view;
        view.theme = active.theme;
        // Together: heights mean something else in the picture of a moment.
        if (links.camera) {
            view.show = active.show;
            view.camera = active.camera;
            view.time_height = active.time_height;
            view.follow = active.follow;
        }
        if (links.time) {
            view.time = active.time;
            view.time_window = active.time_window;
            view.slab = active.slab;
            view.cut_boxes = active.cut_boxes;
            view.slice = active.slice;
        }
        if (links.level) {
            view.levels = active.levels;
            view.color_by = active.color_by;
            view.color_range = active.color_range;
            view.heat = active.heat;
            view.disks = active.disks;
            view.boxes = active.boxes;
            view.ancestors = active.ancestors;
            view.hidden = active.hidden;
            view.pinned = active.pinned;
            view.foreground = active.foreground;
            view.arrange = active.arrange;
        }
        if (links.query && !crowd()) {
            const bool follows = moved || view.query != active.query;
            view.query = active.query;
            view.past = active.past;
            if (follows && view.query) view.step = step_in(other);
        }
        if (links.selection && view.query == active.query) view.subtree = node_in(other, active.subtree);
        other.view = clamped(view, *other.fitted);
    }
    amend_quietly([&](Document& next) { next.beside = std::move(beside); });
}

void Workspace::changed() {
    frame_again();
    settle_step();
    share_linked();
    selection = remapped(selection, *pointed_into_, fitted());
    hovered = remapped(hovered, *pointed_into_, fitted());
    pointed_into_ = shown();
    settle_look();
}

/// A step that the trace does not have is its end; one that was found ("leaf:3") is an event from then on.
void Workspace::settle_step() {
    if (!recorded() || view().step.unit == Step::Unit::end || view().step.unit == Step::Unit::percent) return;
    Step settled{Step::Unit::end, 0};
    try {
        settled = {Step::Unit::event, static_cast<double>(step())};
    } catch (const ViewMismatch&) {
    }
    if (settled == view().step) return;
    amend_quietly([&](Document& next) { next.view.step = settled; });
}

/// Branches and ranges are of one trace; who is asked about moves with the time cursor.
void Workspace::settle_look() {
    const bool same_traces = looked_at_.fitted && ask_the_same(*looked_at_.fitted, *document().fitted);
    if (looked_at_.query != view().query) look = {};
    if (!same_traces) {
        look.focus.branch.reset();
        look.zoom.reset();
    }
    if (looked_at_.time != view().time) {
        look.sample.reset();
        look.point.reset();
    }
    if (!same_traces || looked_at_.query != view().query) hovered_event = -1;
    looked_at_ = {document().fitted, view().query, view().time};
}

void Workspace::remember_step(Document& next) {
    if (!view().query) return;
    const StepKey from = step_key(*document().fitted, *view().query);
    std::optional<StepKey> to;
    if (next.view.query) to = step_key(*next.fitted, *next.view.query);
    if (from != to) {
        next.steps[from].left = view().step;
        if (!to || from.first != to->first) return;
        const auto left = next.steps.find(*to);
        if (left != next.steps.end()) {
            next.view.step = left->second.left;
        } else if (view().step.unit == Step::Unit::event && recorded()->trace.size() > 1) {
            // Other trees take other tests: as far on in theirs.
            next.view.step = {Step::Unit::percent, 100.0 * step() / (recorded()->trace.size() - 1)};
        }
        return;
    }
    if (next.view.step == view().step) return;
    // One that was quoted may lie behind the end.
    if (next.view.step.unit == Step::Unit::event && next.view.step.value >= recorded()->trace.size())
        next.view.step = {Step::Unit::end, 0};
    const auto event_at = [&](const Step& at) { return event_of(at, recorded()->trace, fitted(), *view().query); };
    const int was = step();
    const int is = event_at(next.view.step);
    QuerySteps& looked_at = next.steps[from];
    const bool by_one = std::abs(is - was) == 1;
    const bool goes_on = std::exchange(stepping_, true) || (by_one && looked_at.by_one);
    // A run that comes back to where it began has turned round somewhere: that was seen before.
    if (!goes_on || !looked_at.before || event_at(*looked_at.before) == is) looked_at.before = view().step;
    looked_at.by_one = by_one;
}

QueryWorkload::Kind Workspace::workload() const {
    const bool asks = !crowd() && !document().fitted->queries().empty();
    return asks ? settings_->cost_of : QueryWorkload::Kind::placements;
}

std::shared_ptr<const TreeCost> Workspace::cost_of(const FittedScene& of, int clip) const {
    const std::shared_ptr<const mobb::Tree>& tree = of.shared_tree(clip);
    if (tree->blocks()) return nullptr;
    if (workload() == QueryWorkload::Kind::placements) {
        const auto known = std::ranges::find(standard_costs_, tree, [](const auto& cost) { return cost->tree; });
        return known == standard_costs_.end() ? nullptr : *known;
    }
    const std::shared_ptr<const SceneCosts> costs = counted(of);
    if (!costs) return nullptr;
    const auto known = std::ranges::find_if(
        costs_in_scene_, [&](const CostInScene& each) { return each.of == costs && each.clip == clip; });
    if (known != costs_in_scene_.end()) return known->cost;
    auto cost = std::make_shared<const TreeCost>(cost_in_scene(*costs, clip, tree));
    costs_in_scene_.insert(costs_in_scene_.begin(), {costs, clip, cost});
    if (costs_in_scene_.size() > kKeptCosts) costs_in_scene_.pop_back();
    return cost;
}

void Workspace::keep_counted(const std::shared_ptr<const FittedScene>& of, std::shared_ptr<const SceneCosts> costs) {
    if (ask_the_same(*of, *document().fitted)) derived().costs = costs;
    keep_of_scene(counted_, of, std::move(costs));
}

std::shared_ptr<const SceneCosts> Workspace::counted(const FittedScene& of) const {
    return &of == document().fitted.get() ? derived().costs : found_of_scene(counted_, of);
}

void Workspace::keep_blame(const std::shared_ptr<const FittedScene>& of, std::shared_ptr<const BlameInScene> blame) {
    keep_of_scene(blamed_, of, std::move(blame));
}

std::shared_ptr<const BlameInScene> Workspace::blame(const FittedScene& of) const {
    return found_of_scene(blamed_, of);
}

void Workspace::keep_standard_cost(std::shared_ptr<const TreeCost> cost) {
    std::erase_if(standard_costs_, [&](const auto& known) { return known->tree == cost->tree; });
    standard_costs_.insert(standard_costs_.begin(), std::move(cost));
    if (standard_costs_.size() > kKeptCosts) standard_costs_.pop_back();
}

Workspace::Derived& Workspace::derived() const {
    if (derived_.of != document().fitted) {
        // Another breakpoint, say, changes nothing that was found out about the queries.
        if (!derived_.of || !ask_the_same(*derived_.of, *document().fitted)) {
            derived_ = {};
            derived_.costs = found_of_scene(counted_, *document().fitted);
        }
        // These refer to the scene that they were made of.
        derived_.moves.reset();
        derived_.choice.reset();
        derived_.chosen = {-1, -1};
        derived_.break_steps.reset();
        derived_.of = document().fitted;
    }
    return derived_;
}

void Workspace::close_group() {
    history.close_group();
    stepping_ = false;
}

void Workspace::select(const Selection& selected) { selection = exists(fitted(), selected) ? selected : Selection{}; }

std::optional<VisitedStep> Workspace::present_step() const {
    const RecordedQuery* query = recorded();
    if (!query || query->trace.empty()) return std::nullopt;
    return VisitedStep{step_key(*document().fitted, *view().query), step()};
}

bool Workspace::revisit(bool forward) {
    const std::optional<VisitedStep> present = present_step();
    VisitedSteps way = visited;
    std::vector<VisitedStep>& from = forward ? way.after : way.before;
    while (!from.empty()) {
        const VisitedStep next = from.back();
        from.pop_back();
        const std::optional<int> query = find_query(*document().fitted, next.of.first);
        // It is asked no more, its steps are of other trees, or one is there already.
        if (!query || step_key(*document().fitted, *query) != next.of || next == present) continue;
        if (present) (forward ? way.before : way.after).push_back(*present);
        change_view([&](ViewState& view) {
            view.query = query;
            view.step = {Step::Unit::event, static_cast<double>(next.step)};
        });
        visited = std::move(way);
        return true;
    }
    return false;
}

bool is_crowd(const Workspace& workspace) {
    const Scene& scene = workspace.scene();
    const bool has_agents = scene.queries.empty() && !scene.agents.empty();
    return workspace.crowd() || (has_agents && workspace.fitted().placed_agents().size() > kFewAgents);
}

const std::string* Workspace::stored_difference(int query) const {
    const auto at = stored_differences.queries.find(query);
    const bool holds = at != stored_differences.queries.end() && &stored_differences.in->scene() == &scene();
    return holds ? &at->second : nullptr;
}

mobb::Interval time_span(const Workspace& workspace) {
    if (const CrowdRun* run = workspace.crowd()) {
        const auto& found = workspace.found;
        const bool is_of_it = found && &found->in->scene() == &workspace.scene();
        return {0, is_of_it ? std::max(run->seconds, found->end) : run->seconds};
    }
    mobb::Interval span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for_each_agent_in_view(workspace.fitted(), workspace.view(), [&](const PlacedAgent& who) {
        const mobb::PlacedTree tree = workspace.fitted().placed(who);
        const mobb::PlacedClip& clip = tree.placed_clip();
        span.t0 = std::min(span.t0, clip.time(0));
        span.t1 = std::max(span.t1, clip.time(clip.count()));
    });
    return span.t0 <= span.t1 ? span : mobb::Interval{0, 0};
}

int clip_played(const Workspace& workspace, const PlacedAgent& who) {
    if (!workspace.crowd()) return who.clip;
    const Agent& agent = workspace.fitted().scene().agents[static_cast<std::size_t>(who.agent)];
    const CrowdAgent& person = workspace.crowd()->agents[static_cast<std::size_t>(agent.run_agent)];
    const int move = person.plays[static_cast<std::size_t>(agent.play)].move;
    return workspace.scene().graph->moves[static_cast<std::size_t>(move)].clip;
}

int clip_in_focus(const Workspace& workspace) {
    if (workspace.selection.kind == Selection::Kind::clip) return workspace.selection.index;
    if (workspace.selection.on_path()) {
        if (const auto who = placed_agent_of(workspace.fitted(), workspace.selection.path))
            return clip_played(workspace, *who);
    }
    return clip_played(workspace, workspace.fitted().placed_agents().front());
}

const std::vector<ClipGroup>& clip_groups(const Workspace& workspace) {
    Workspace::Derived& d = workspace.derived();
    if (!d.groups) d.groups = clip_groups(workspace.scene());
    return *d.groups;
}

}  // namespace mobbscope::app
