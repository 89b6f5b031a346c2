#include <app/document/edit_names.h>
#include <app/document/session.h>
#include <base/error.h>
#include <base/text.h>
#include <explain/query_progress.h>
#include <render/drawlist/camera.h>
#include <scene/crowd_scene.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostMessages = 50;
/// How long a message lies over the picture; one with an offer stays longer, and none goes sooner than this after the
/// mouse has left it.
constexpr double kInfoSeconds = 4;
constexpr double kErrorSeconds = 10;
constexpr double kOfferSeconds = 20;
constexpr double kLeftSeconds = 2;
constexpr std::size_t kLongestMessage = 500;  // characters; names of files may be longer
/// Agents whose pairs are still listed one by one.
constexpr std::size_t kFewAgents = 12;

/// Of one group with moving in time.
const EditName kPlaying{"playing", "look time"};

}  // namespace

Session::Session(bool attended, Settings settings_)
    : settings(std::move(settings_)),
      attended_(attended),
      history_(document_of({}, nullptr)),
      pointed_into_(document().fitted),
      saved_(document().fitted) {}

// --- the document

void Session::edit(const EditName& name, const std::function<void(Scene&)>& change) {
    change_document(with_scene(document(), changed_scene(change)), name);
}

void Session::refit(const EditName& name, const std::function<void(mobb::FitOptions&)>& change) {
    edit_with_fits({name, [change](Scene& scene) { change(scene.fit); }});
}

Scene Session::changed_scene(const std::function<void(Scene&)>& change) const {
    Scene next = scene();
    next.view = view();
    next.fit = document().fitted->options();
    change(next);
    mobb::check(next.fit);
    if (next.fit != document().fitted->options()) drop_traces(next);
    return next;
}

void Session::edit_with_fits(const FitEdit& edit, const FittedScene* fitted_beside) {
    Scene next = changed_scene(edit.change);
    if (quick_to_fit(next, *document().fitted, fitted_beside)) {
        if (edit.goes_on) history_.reopen_group();
        change_document(with_scene(document(), std::move(next), fitted_beside), edit.name);
        if (edit.then) edit.then();
        return;
    }
    FitEdit later = edit;
    later.goes_on = edit.goes_on || history_.has_open_group();
    start(
        "Fitting trees",
        [this, edit = std::move(later), before = document(),
         next = std::move(next)](JobControl& control) -> Job::Finish {
            const Document fitted = with_scene(before, next, nullptr, progress_of(control));
            // The document may have changed meanwhile: the edit is made on what it is now, with the trees made here.
            return [this, edit, fitted] { edit_with_fits(edit, fitted.fitted.get()); };
        },
        edit.purpose);
}

void Session::rename_agent(int agent, const std::string& name) {
    std::string before;
    Document next = with_scene(document(), changed_scene([&](Scene& scene) {
                                   add_agents_for_clips(scene);
                                   before = scene.agents.at(static_cast<std::size_t>(agent)).name;
                                   mobbscope::rename_agent(scene, agent, name);
                               }));
    for (SceneView& other : next.beside) rename_in_view(other.view, before, name);
    if (alone) {
        std::ranges::replace(alone->hidden, before, name);
        std::ranges::replace(alone->before, before, name);
    }
    std::map<StepKey, QuerySteps> steps;
    for (const auto& [key, looked_at] : next.steps) {
        auto [a, b, same] = key.first;
        for (std::string* side : {&a, &b}) {
            if (*side == before) *side = name;
        }
        steps[{{a, b, same}, key.second}] = looked_at;
    }
    next.steps = std::move(steps);
    // Not change_document, which would remember a step under the name of before.
    history_.change(std::move(next), {"renaming " + before + " to " + name, ""});
    changed();
}

void Session::remember_step(Document& next) {
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
    const mobb::Trace& trace = recorded()->trace;
    const int was = step();
    const int is = event_of(next.view.step, trace);
    QuerySteps& looked_at = next.steps[from];
    const bool by_one = std::abs(is - was) == 1;
    const bool goes_on = std::exchange(stepping_, true) || (by_one && looked_at.by_one);
    // A run that comes back to where it began has turned round somewhere: that was seen before.
    if (!goes_on || !looked_at.before || event_of(*looked_at.before, trace) == is) looked_at.before = view().step;
    looked_at.by_one = by_one;
}

std::optional<Step> Session::step_before() const {
    if (!view().query) return std::nullopt;
    const auto looked_at = document().steps.find(step_key(*document().fitted, *view().query));
    return looked_at == document().steps.end() ? std::nullopt : looked_at->second.before;
}

void Session::show_query(int query, std::optional<Step> step) {
    const auto looked_at = document().steps.find(step_key(*document().fitted, query));
    if (!step && query == view().query) step = view().step;
    if (!step && looked_at != document().steps.end()) step = looked_at->second.left;
    change_view([&](ViewState& view) {
        view.query = query;
        view.step = step.value_or(Step{});
    });
}

void Session::change_document(Document next, const EditName& name) {
    // A node of a tree that was fitted anew is another one, or none.
    if (next.view.projection && !has_projection(*next.fitted, next.view)) next.view.projection.reset();
    next.view = fitting(next.view, *next.fitted);
    for (SceneView& other : next.beside) other.view = fitting(other.view, *other.fitted);
    remember_step(next);
    history_.change(std::move(next), name);
    changed();
}

void Session::amend(const std::function<void(Document&)>& change) {
    Document next = document();
    change(next);
    history_.amend(std::move(next));
    changed();
}

void Session::change_view(const std::function<void(ViewState&)>& change) { look(change, std::nullopt); }

void Session::look(const std::function<void(ViewState&)>& change, const std::optional<EditName>& name) {
    Document next = document();
    change(next.view);
    next.view = fitting(next.view, *next.fitted);
    if (next.view == view()) return;
    if (next.view.theme != view().theme) settings.theme = next.view.theme;
    remember_step(next);
    const EditName as = name ? *name : name_of_looking(document(), next.view);
    history_.change_view(std::move(next), as);
    changed();
}

// --- views

void Session::split_view(const std::string& name, const mobb::FitOptions& options) {
    Document next = document();
    const auto& fits = next.fitted->fits();
    const auto known = std::find_if(fits.begin(), fits.end(), [&](const auto& fit) { return fit->options == options; });
    const std::size_t index = static_cast<std::size_t>(known - fits.begin());
    FittedScene fitted = *next.fitted;
    if (known == fits.end()) {
        UnusedNames names;
        for (const auto& fit : fits) names.take(fit->name);
        fitted = fitted.with_fit(names.take(name), options);
        next.fitted = std::make_shared<const FittedScene>(fitted);
        for (SceneView& other : next.beside) {
            other.fitted = std::make_shared<const FittedScene>(fitted.using_fit(other.fitted->fit_in_use()));
        }
    }
    SceneView added{std::make_shared<const FittedScene>(fitted.using_fit(index)), next.view};
    // Other trees take other tests: as far on in theirs.
    if (const RecordedQuery* query = recorded(); query && query->trace.size() > 1) {
        added.view.step = {Step::Unit::percent, 100.0 * step() / (query->trace.size() - 1)};
    }
    next.beside.push_back(std::move(added));
    change_document(std::move(next), {"splitting the view: " + name, ""});
}

void Session::close_other_views() {
    if (document().beside.empty()) return;
    Document next = document();
    next.beside.clear();
    next.place = 0;
    next.fitted = std::make_shared<const FittedScene>(next.fitted->without_unused_fits());
    change_document(std::move(next), {"closing the other views", ""});
}

void Session::activate_view(std::size_t place) {
    if (place == document().place || place > document().beside.size()) return;
    amend([&](Document& next) {
        next.beside.insert(next.beside.begin() + static_cast<std::ptrdiff_t>(next.place), {next.fitted, next.view});
        const auto chosen = next.beside.begin() + static_cast<std::ptrdiff_t>(place);
        next.fitted = chosen->fitted;
        next.view = chosen->view;
        next.beside.erase(chosen);
        next.place = place;
    });
}

void Session::settle_camera(std::size_t place, const Camera& camera, double time_height) {
    if (place >= view_count()) return;
    amend([&](Document& next) {
        ViewState& view = place == next.place ? next.view : next.beside[place - (place > next.place ? 1 : 0)].view;
        view.camera = camera;
        if (time_height > 0) view.time_height = time_height;
    });
    if (time_height > 0) settled_height_ = time_height;
}

void Session::resize_pictures(PictureSize to) {
    const std::optional<PictureSize> from = std::exchange(picture_size_, to);
    if (!from || from->height == to.height) return;
    const auto resize = [&](Camera& camera) {
        if (camera.target) camera = resized(camera, *from, to);
    };
    history_.amend_views([&](ViewState& view) { resize(view.camera); });
    for (auto& aside : cameras_aside) resize(aside.second);
}

void Session::link_cameras(bool linked) {
    amend([&](Document& next) { next.linked_cameras = linked; });
}

SceneView Session::view_at(std::size_t place) const {
    const Document& now = document();
    if (place == now.place) return {shown(), now.view};
    const SceneView& other = now.beside[place < now.place ? place : place - 1];
    shown_beside_.resize(now.beside.size() + 1);
    return {shown_at(other, shown_beside_[place]), other.view};
}

/// All views show one time, and of linked cameras what the active view's shows.
void Session::share_time_and_camera() {
    Document next = document();
    for (SceneView& other : next.beside) {
        ViewState view = other.view;
        view.time = next.view.time;
        view.theme = next.view.theme;
        // Heights mean something else in the picture of a moment.
        if (next.linked_cameras && view.show == next.view.show) {
            view.camera = next.view.camera;
            view.time_height = next.view.time_height;
            view.follow = next.view.follow;
        }
        other.view = fitting(view, *other.fitted);
    }
    if (!next.beside.empty()) history_.amend(std::move(next));
}

void Session::undo() {
    if (history_.can_undo()) go_to_state(history_.place() - 1);
}

void Session::redo() {
    if (history_.can_redo()) go_to_state(history_.place() + 1);
}

void Session::go_to_state(std::size_t state) {
    const int before = opening();
    stop();
    history_.go_to(state);
    ++times_put_back_;
    // What is made for an excerpt is not put into the whole, nor the other way round.
    if (opening() != before) {
        while (!jobs_.empty()) cancel_job(0);
        cameras_aside.clear();
    }
    changed();
}

Session::BeforeDrag Session::before_drag() const {
    return {history_,      settings,      handed_over_,
            picture_size_, cameras_aside, reviewing_ ? std::optional(review_->look) : std::nullopt};
}

void Session::restore(BeforeDrag before) {
    if (before.look && reviewing_) review_->look = *before.look;
    if (before.handed_over != handed_over_) return;
    history_ = std::move(before.history);
    settings = std::move(before.settings);
    // A border between panels may be what was dragged: cameras stand for the pictures of before.
    picture_size_ = before.picture_size;
    cameras_aside = std::move(before.cameras_aside);
    ++times_put_back_;
    changed();
}

/// After every change of the document: nothing points at what is gone, and the step is one of the trace.
void Session::changed() {
    share_time_and_camera();
    selection = still(selection, *pointed_into_, fitted());
    hovered = still(hovered, *pointed_into_, fitted());
    pointed_into_ = shown();
    const RecordedQuery* query = recorded();
    if (query && view().step.unit == Step::Unit::event && view().step.value >= query->trace.size()) {
        Document next = document();
        next.view.step = {Step::Unit::end, 0};
        history_.amend(std::move(next));
    }
    ask_for_offer();
}

Session::Derived& Session::derived() const {
    if (derived_.of != document().fitted) derived_ = {document().fitted, {}, {}, {}, {}, {}};
    return derived_;
}

const RecordedQuery* Session::recorded() const {
    if (!view().query) return nullptr;
    Derived& d = derived();
    if (!d.recorded || d.recorded->first != *view().query) {
        d.findings.reset();
        d.recorded.emplace(*view().query,
                           record(fitted(), fitted().queries()[static_cast<std::size_t>(*view().query)]));
    }
    return &d.recorded->second;
}

std::shared_ptr<const QueryFindings> Session::findings() const {
    const RecordedQuery* query = recorded();
    if (!query) return nullptr;
    Derived& d = derived();
    if (!d.findings) d.findings = std::make_shared<const QueryFindings>(find_out(fitted(), view(), *query));
    return d.findings;
}

int Session::step() const { return event_of(view().step, recorded()->trace); }

const Answer& Session::answer_of(std::size_t query) const {
    auto [at, is_new] = derived().answers.try_emplace(query);
    if (is_new) at->second = answer(fitted(), fitted().queries()[query], {});
    return at->second;
}

const std::vector<mobb::LevelFigures>& Session::figures_of(int clip) const {
    auto [at, is_new] = derived().figures.try_emplace(clip);
    if (is_new) at->second = mobb::level_figures(fitted().tree(clip));
    return at->second;
}

const std::vector<ClipGroup>& Session::clip_groups() const {
    Derived& d = derived();
    if (!d.groups) d.groups = app::clip_groups(scene());
    return *d.groups;
}

// --- crowds

std::shared_ptr<const FittedScene> Session::shown() const { return shown_at({document().fitted, view()}, shown_); }

std::shared_ptr<const FittedScene> Session::shown_at(const SceneView& seen, Shown& kept) const {
    const std::shared_ptr<const FittedScene>& whole = seen.fitted;
    const ViewState& view = seen.view;
    if (!is_run(whole->scene())) return whole;
    const double time = run_time(whole->scene(), view);
    if (kept.of != whole || kept.time != time || kept.window != view.time_window || kept.show != view.show) {
        kept = {whole, time, view.time_window, view.show, std::make_shared<const FittedScene>(fitted_at(*whole, view))};
    }
    return kept.fitted;
}

bool Session::is_crowd() const {
    return crowd() ||
           (scene().queries.empty() && !scene().agents.empty() && fitted().placed_agents().size() > kFewAgents);
}

const FollowedChoice* Session::choice() const {
    if (!crowd() || view().follow.empty()) return nullptr;
    const auto run_agent = run_agent_by_name(*crowd(), view().follow);
    if (!run_agent) return nullptr;
    const double time = run_time(scene(), view());
    const std::pair made{*run_agent,
                         last_chosen(crowd()->agents[static_cast<std::size_t>(*run_agent)], time).value_or(-1)};
    if (choosing_.of != document().fitted) {
        choosing_ = {document().fitted, std::make_unique<MoveSet>(*document().fitted), {-1, -1}, {}};
    }
    if (choosing_.made != made) {
        choosing_.choice = last_choice(*choosing_.moves, *run_agent, time);
        choosing_.made = made;
    }
    return choosing_.choice ? &*choosing_.choice : nullptr;
}

int Session::candidate() const {
    const FollowedChoice* now = pointed_out_.candidate >= 0 ? choice() : nullptr;
    return now && now->agent == pointed_out_.agent && now->play == pointed_out_.play ? pointed_out_.candidate : -1;
}

void Session::point_out(int candidate) {
    const FollowedChoice* now = choice();
    pointed_out_ = now && candidate >= 0 ? PointedOut{now->agent, now->play, candidate} : PointedOut{};
}

const std::vector<SceneConflict>* Session::conflicts() const {
    return found_ && &found_->in->scene() == &scene() ? &found_->conflicts : nullptr;
}

void Session::find_conflicts() {
    start("Looking for conflicts", [this, in = document().fitted](JobControl& control) -> Job::Finish {
        std::vector<SceneConflict> found = conflicts_in(*in, progress_of(control));
        return [this, in, found = std::move(found)]() mutable {
            if (&in->scene() != &scene()) {
                return tell(MessageLevel::info, "The scene has changed: look for conflicts again");
            }
            found_ = Found{in, std::move(found)};
            conflict = -1;
        };
    });
}

void Session::point_at_nothing() {
    stop();
    selection = {};
    hovered = {};
}

// --- dialogs, messages, queue and jobs

void Session::open_dialog(Dialog which, DialogInput with) {
    behind_help_ = {};  // to close the help would lead back there, with what waits for an answer
    close_dialog();
    dialog = which;
    ask_anew(std::move(with));
}

void Session::open_help() {
    if (dialog == Dialog::help) return;
    behind_help_ = {dialog, std::move(input)};
    dialog = Dialog::help;
    input = {.text = "", .opening = behind_help_.second.opening};
    ask_anew({});
}

void Session::close_dialog() {
    if (dialog == Dialog::help && behind_help_.first != Dialog::none) {
        dialog = std::exchange(behind_help_.first, Dialog::none);
        const int opening = input.opening;
        input = std::move(behind_help_.second);
        input.fresh = true;
        input.opening = opening + 1;
        return;
    }
    if (dialog == Dialog::export_file) {
        // It lies over the dialog that asked for the file.
        dialog = Dialog::export_picture;
        return ask_anew({.text = exporting.file});
    }
    dialog = Dialog::none;
    ask_anew({});
    pending_ = nullptr;
}

void Session::ask_anew(DialogInput with) {
    with.opening = input.opening + 1;
    input = std::move(with);
}

void Session::tell(MessageLevel level, const std::string& text, std::optional<MessageOffer> offer) {
    const std::string said = shortened(text, kLongestMessage);
    // Twice the same says nothing new.
    std::erase_if(messages_, [&](const Message& message) { return message.text == said; });
    messages_.push_back({level, said, std::move(offer), {}, 0, true, level == MessageLevel::info});
    if (messages_.size() > kMostMessages) messages_.erase(messages_.begin());
}

void Session::tell_of_window(MessageLevel level, const std::string& text) {
    tell(level, text);
    messages_.back().of_window = true;
}

void Session::take_down(const std::string& text) {
    for (Message& message : messages_) {
        if (message.text == shortened(text, kLongestMessage)) message.up = false;
    }
}

void Session::retire_messages() {
    for (Message& message : messages_) {
        if (message.level == MessageLevel::info || message.of_window) continue;
        message.up = false;
        message.read = true;
    }
}

std::size_t Session::unread() const {
    return static_cast<std::size_t>(std::ranges::count(messages_, false, &Message::read));
}

void Session::open_messages() {
    open_dialog(Dialog::messages);
    put_messages_away();
    for (Message& message : messages_) message.read = true;
}

void Session::put_messages_away() {
    for (Message& message : messages_) message.up = false;
}

double Session::age_messages(double now, bool held) {
    double next = std::numeric_limits<double>::infinity();
    for (Message& message : messages_) {
        if (!message.up) continue;
        if (!message.shown_at) {
            message.shown_at = now;
            message.goes_at = now + (message.offer                         ? kOfferSeconds
                                     : message.level == MessageLevel::info ? kInfoSeconds
                                                                           : kErrorSeconds);
        }
        if (held) message.goes_at = std::max(message.goes_at, now + kLeftSeconds);
        message.up = now < message.goes_at;
        if (message.up) next = std::min(next, message.goes_at - now);
    }
    return next;
}

bool Session::has_message_up() const {
    return std::ranges::any_of(
        messages_, [](const Message& message) { return message.up && message.level != MessageLevel::info; });
}

void Session::dismiss(std::size_t message) {
    if (message < messages_.size()) messages_.erase(messages_.begin() + static_cast<std::ptrdiff_t>(message));
}

bool Session::run_queue() {
    const bool had_any = !queue_.empty();
    while (!queue_.empty()) {
        const std::function<void()> next = std::move(queue_.front());
        queue_.pop_front();
        try {
            next();
        } catch (const std::exception& error) {
            tell(MessageLevel::error, error.what());
        }
    }
    return had_any;
}

void Session::require_no_job() const {
    if (!jobs_.empty()) throw std::invalid_argument("wait for \"" + job()->title() + "\", or cancel it");
}

void Session::start(std::string title, Job::Work work, Purpose purpose) {
    jobs_.push_back({std::make_unique<Job>(std::move(title), std::move(work), hooks.wake), purpose});
    if (attended_ && patience.count() == 0) return;
    jobs_.back().job->wait(attended_ ? patience : std::chrono::hours(24));
    poll();
}

void Session::cancel_job(std::size_t index) {
    if (index >= jobs_.size()) return;
    if (jobs_[index].purpose == Purpose::imports) import_changes_.clear();
    jobs_.erase(jobs_.begin() + static_cast<std::ptrdiff_t>(index));
    tell(MessageLevel::info, "Cancelled");
}

void Session::cancel_review_run() {
    if (!review_ || !review_->drawing()) return;
    review_->cancel();
    tell(MessageLevel::info, "Cancelled");
}

void Session::end_work() {
    jobs_.clear();
    if (aside_) aside_->jobs.clear();
    import_changes_.clear();
    preview.end();
    if (review_) review_->cancel();
}

void Session::poll() {
    if (review_) {
        for (const ReviewNews& news : review_->poll()) tell(news.level, news.text);
    }
    for (;;) {
        const auto done = std::find_if(jobs_.begin(), jobs_.end(), [](const Running& r) { return r.job->done(); });
        if (done == jobs_.end()) return;
        // What it hands over may start the next one.
        const std::unique_ptr<Job> job = std::move(done->job);
        ++handed_over_;
        jobs_.erase(done);
        finish(*job);
        import_next();
    }
}

void Session::finish(Job& job) {
    try {
        job.finish();
    } catch (const Cancelled&) {
        tell(MessageLevel::info, "Cancelled");
    } catch (const std::bad_alloc&) {
        tell(MessageLevel::error, "there is not enough memory for this");
    } catch (const std::exception& error) {
        tell(MessageLevel::error, error.what());
    }
}

// --- time

mobb::Interval Session::time_span() const {
    if (crowd()) return {0, crowd()->seconds};
    mobb::Interval span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for_each_agent_in_view(fitted(), view(), [&](const PlacedAgent& who) {
        const mobb::PlacedTree tree = fitted().placed(who);
        const mobb::PlacedClip& clip = tree.placed_clip();
        span.t0 = std::min(span.t0, clip.time(0));
        span.t1 = std::max(span.t1, clip.time(clip.count()));
    });
    return span.t0 <= span.t1 ? span : mobb::Interval{0, 0};
}

void Session::play() {
    playing_ = true;
    has_played_ = false;
    if (view().time || empty()) return;
    look([&](ViewState& v) { v.time = time_span().t0; }, kPlaying);
}

void Session::advance(double seconds) {
    if (!playing_ || empty()) return;
    const mobb::Interval span = time_span();
    double time = view().time.value_or(span.t0) + seconds * speed;
    if (time >= span.t1 || time < span.t0) time = span.t0;
    if (time == view().time) return;
    if (!std::exchange(has_played_, true)) return look([&](ViewState& v) { v.time = time; }, kPlaying);
    // A drag meanwhile stays one state, and so does the play.
    amend([&](Document& next) { next.view.time = time; });
}

}  // namespace mobbscope::app
