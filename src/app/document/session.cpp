#include <app/document/session.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <explain/query_progress.h>
#include <render/layout/follow.h>
#include <scene/crowd_scene.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <stdexcept>
#include <unordered_set>
#include <utility>

namespace mobbscope::app {

namespace {

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

/// Tells a job how much is done; it ends there if it was cancelled.
Progress progress_of(JobControl& control) {
    return [&control](std::size_t done, std::size_t all) { control.step(done, all); };
}

/// Shorter work is waited for: a window that flickers is worse than one that is late by this.
constexpr std::chrono::milliseconds kPatience(80);
/// Fits of fewer samples than this are no work for a job.
constexpr std::size_t kQuickSamples = 50'000;
/// How much longer than the paper's axes those found by searching take.
constexpr std::size_t kSearchFactor = 100;
constexpr std::size_t kMostMessages = 5;
constexpr std::size_t kLongestMessage = 500;  // characters; names of files may be longer
/// Agents whose pairs are still listed one by one.
constexpr std::size_t kFewAgents = 12;

Document document_of(Scene scene, const FittedScene* previous, const Progress& progress = {}) {
    const mobb::FitOptions options = scene.fit;
    const ViewState view = scene.view;
    return {std::make_shared<const FittedScene>(std::move(scene), options, previous, progress), view};
}

/// Whether trees over these clips are made in an instant.
bool quick_to_fit(const Scene& scene, const FittedScene& present) {
    std::unordered_set<const mobb::Clip*> kept;
    if (scene.fit == present.options()) {
        for (const SceneClip& clip : present.scene().clips) kept.insert(clip.clip.get());
    }
    std::size_t samples = 0;
    for (const SceneClip& clip : scene.clips) {
        if (!kept.contains(clip.clip.get())) samples += static_cast<std::size_t>(clip.clip->count());
    }
    return samples * (scene.fit.axes == mobb::Axes::minarea ? kSearchFactor : 1) < kQuickSamples;
}

/// A view of another scene, or of this one before an edit, made to fit what there is.
ViewState fitting(ViewState view, const FittedScene& fitted) {
    if (view.query && static_cast<std::size_t>(*view.query) >= fitted.queries().size()) view.query.reset();
    if (!view.follow.empty() && !can_follow(fitted.scene(), view.follow)) view.follow.clear();
    // A run is always seen at some time.
    if (fitted.scene().crowd && !view.time) view.time = run_time(fitted.scene(), view);
    return view;
}

}  // namespace

Session::Session(bool attended, Settings settings_)
    : settings(std::move(settings_)),
      attended_(attended),
      history_(document_of({}, nullptr)),
      pointed_into_(document().fitted),
      saved_(document().fitted) {}

// --- the document

void Session::edit(const EditName& name, const std::function<void(Scene&)>& change) {
    require_no_job();
    Scene next = scene();
    next.view = view();
    change(next);
    mobb::check(next.fit);
    if (next.fit != document().fitted->options()) drop_traces(next);
    const std::shared_ptr<const FittedScene> before = document().fitted;
    if (quick_to_fit(next, *before)) {
        change_document(document_of(std::move(next), before.get()), name);
        return;
    }
    start("Fitting trees", [this, name, before, next = std::move(next)](JobControl& control) -> Job::Finish {
        Document document =
            document_of(next, before.get(), [&](std::size_t done, std::size_t all) { control.step(done, all); });
        return [this, name, document = std::move(document)] { change_document(document, name); };
    });
}

/// The present excerpt stays one.
void Session::change_document(Document next, const EditName& name) {
    next.excerpt_of = document().excerpt_of;
    // A node of a tree that was fitted anew is another one, or none.
    if (next.view.projection && !has_projection(*next.fitted, next.view)) next.view.projection.reset();
    history_.change(std::move(next), name);
    changed();
}

void Session::change_view(const std::function<void(ViewState&)>& change) {
    ViewState next = view();
    change(next);
    next = fitting(next, *document().fitted);
    if (next == view()) return;
    history_.change_view(next);
    changed();
}

void Session::undo() {
    if (job_ || !history_.can_undo()) return;
    stop();
    history_.undo();
    changed();
}

void Session::redo() {
    if (job_ || !history_.can_redo()) return;
    stop();
    history_.redo();
    changed();
}

/// After every change of the document: nothing points at what is gone, and the step is one of the trace.
void Session::changed() {
    selection = still(selection, *pointed_into_, fitted());
    hovered = still(hovered, *pointed_into_, fitted());
    pointed_into_ = shown();
    const RecordedQuery* query = recorded();
    if (query && view().step.unit == Step::Unit::event && view().step.value >= query->trace.size()) {
        Document next = document();
        next.view.step = {Step::Unit::end, 0};
        history_.amend(std::move(next));
    }
}

Session::Derived& Session::derived() const {
    if (derived_.of != document().fitted) derived_ = {document().fitted, {}, {}, {}, {}};
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

// --- crowds

std::shared_ptr<const FittedScene> Session::shown() const {
    const std::shared_ptr<const FittedScene>& whole = document().fitted;
    if (!is_run(whole->scene())) return whole;
    const ViewState& seen = view();
    const double time = run_time(whole->scene(), seen);
    if (shown_.of != whole || shown_.time != time || shown_.window != seen.time_window || shown_.show != seen.show) {
        shown_ = {whole, time, seen.time_window, seen.show,
                  std::make_shared<const FittedScene>(fitted_at(*whole, seen))};
    }
    return shown_.fitted;
}

bool Session::is_crowd() const {
    return crowd() || (scene().queries.empty() && fitted().placed_agents().size() > kFewAgents);
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

const std::vector<SceneConflict>* Session::conflicts() const {
    return found_ && found_->in == document().fitted ? &found_->conflicts : nullptr;
}

void Session::find_conflicts() {
    start("Looking for conflicts", [this, in = document().fitted](JobControl& control) -> Job::Finish {
        std::vector<SceneConflict> found = conflicts_in(*in, progress_of(control));
        return [this, in, found = std::move(found)]() mutable {
            found_ = Found{in, std::move(found)};
            conflict = -1;
        };
    });
}

void Session::open_excerpt(const PlacedAgent& a, const PlacedAgent& b) {
    require_no_job();
    Scene excerpt;
    excerpt.file = scene().file;
    excerpt.fit = scene().fit;
    for (const PlacedAgent* side : {&a, &b}) {
        int clip = 0;
        if (side == &b && b.clip == a.clip) {
            clip = 0;
        } else {
            clip = static_cast<int>(excerpt.clips.size());
            excerpt.clips.push_back(scene().clips[static_cast<std::size_t>(side->clip)]);
        }
        Agent agent{side->name, clip, side->placement, std::nullopt};
        if (side == &b && b.name == a.name) agent.name += " (2)";
        excerpt.agents.push_back(std::move(agent));
    }
    excerpt.view.theme = view().theme;
    excerpt.view.query = 0;
    Document next = document_of(std::move(excerpt), document().fitted.get());
    const std::shared_ptr<const ExcerptSource> before = document().excerpt_of;
    next.excerpt_of = std::make_shared<const ExcerptSource>(
        ExcerptSource{before ? before->fitted : document().fitted, before ? before->view : view(), next.fitted});
    stop();
    selection = {};
    hovered = {};
    ++excerpts_opened_;
    history_.change(std::move(next), {"opening " + a.name + " against " + b.name, ""});
    changed();
}

void Session::leave_excerpt() {
    require_no_job();
    const std::shared_ptr<const ExcerptSource> origin = document().excerpt_of;
    stop();
    selection = {};
    hovered = {};
    history_.change({origin->fitted, origin->view, nullptr}, {"going back to the whole", ""});
    changed();
}

// --- files

bool Session::modified() const {
    const std::shared_ptr<const ExcerptSource>& origin = document().excerpt_of;
    if (!origin) return document().fitted != saved_;
    return origin->fitted != saved_ || document().fitted != origin->saved;
}

std::string Session::title() const {
    if (in_excerpt()) {
        std::string title = scene().agents.empty() ? "excerpt" : scene().agents.front().name;
        if (scene().agents.size() > 1) title += " and " + scene().agents[1].name;
        return title + " of " + (file_ ? file_->filename().string() : "a crowd");
    }
    if (file_) return file_->filename().string();
    return scene().file.empty() ? "untitled" : scene().file.stem().string();
}

void Session::replace(Document document, const std::vector<std::filesystem::path>& opened) {
    document.view = fitting(document.view, *document.fitted);
    document.excerpt_of = nullptr;
    saved_ = document.fitted;
    file_ = scene_file_of(opened);
    opened_ = opened;
    ++files_opened_;
    if (attended_ && !opened.empty()) settings.remember(opened.front());
    selection = {};
    hovered = {};
    stop();
    candidate = -1;
    conflict = -1;
    // What went wrong with the last document is over.
    std::erase_if(messages_, [](const Message& message) { return message.level != Message::Level::info; });
    history_.reset(std::move(document));
    changed();
}

void Session::load(std::string title, const LoadAll& load_all, const std::vector<std::filesystem::path>& files) {
    start(std::move(title), [this, load_all, files](JobControl& control) -> Job::Finish {
        Document document = document_of(load_all(control), nullptr,
                                        [&](std::size_t done, std::size_t all) { control.step(done, all); });
        return [this, document = std::move(document), files] { replace(document, files); };
    });
}

void Session::open(const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) {
        // Nobody is asked about unsaved changes for nothing.
        std::error_code ignored;
        if (std::filesystem::exists(file, ignored)) continue;
        return tell(Message::Level::error, file.string() + ": no such file; check the path");
    }
    after_asking([this, files] {
        load(
            "Opening " + (files.size() == 1 ? files.front().filename().string() : "files"),
            [files](JobControl& control) { return load_files(files, {}, progress_of(control)); }, files);
    });
}

void Session::open_scene(const Scene& scene, const std::vector<std::filesystem::path>& files) {
    after_asking([this, scene, files] {
        load(
            "Opening " + scene.file.filename().string(), [scene](JobControl&) { return scene; }, files);
    });
}

void Session::open_demo() {
    after_asking([this] { load("Opening the demo", [](JobControl&) { return demo_scene(); }, {}); });
}

void Session::add(const std::vector<std::filesystem::path>& files) {
    if (empty()) return open(files);
    if (crowd()) throw InputError("a run stands alone: open the files by themselves");
    const std::shared_ptr<const FittedScene> before = document().fitted;
    Scene present = scene();
    present.view = view();
    start("Adding files", [this, files, before, present = std::move(present)](JobControl& control) -> Job::Finish {
        Scene next = present;
        merge(next, load_files(files, {}, progress_of(control)));
        Document document = document_of(std::move(next), before.get());
        return [this, document = std::move(document)] { change_document(document, {"adding files", ""}); };
    });
}

void Session::save() {
    if (!file_ || in_excerpt()) {
        dialog = Dialog::save_as;  // what waits for the changes to be saved goes on waiting
        ask_anew({});
        return;
    }
    save_as(*file_);
}

void Session::check_may_write(const std::filesystem::path& file) const {
    if (may_write) return;
    throw InputError(file.string(), "",
                     "nothing is written here: a picture test only looks; remove this from its script");
}

void Session::save_as(const std::filesystem::path& file) {
    check_may_write(file);
    if (empty()) throw InputError("there is nothing to save: open a scene or a clip first");
    check_file_name(file);
    if (lower_extension(file) != ".json") {
        throw InputError(file.string(), "", "scenes are written as .json; rename the output");
    }
    if (in_excerpt() && file_ && same_file(file, *file_)) {
        throw InputError(file.string(), "", "this is what the two were taken from; save them under another name");
    }
    Scene saved = scene();
    saved.view = view();
    move_to_file(saved, file);
    write_file(file, to_json(saved));
    if (in_excerpt()) {
        // The whole stays what is open; the excerpt has a file of its own.
        Document now = document();
        now.excerpt_of = std::make_shared<const ExcerptSource>(
            ExcerptSource{now.excerpt_of->fitted, now.excerpt_of->view, now.fitted});
        history_.amend(std::move(now));
    } else {
        // The document is the file's now: messages and further sources refer to it.
        const mobb::FitOptions options = saved.fit;
        const FittedScene* before = document().fitted.get();
        Document now{std::make_shared<const FittedScene>(std::move(saved), options, before), view()};
        history_.amend(std::move(now));
        saved_ = document().fitted;
        file_ = file;
        opened_ = {file};
    }
    if (attended_) settings.remember(file);
    tell(Message::Level::info, "Saved " + file.string());
    if (dialog == Dialog::save_as || dialog == Dialog::unsaved) dialog = Dialog::none;
    if (const auto then = std::exchange(pending_, nullptr)) then();
}

void Session::request_close() {
    after_asking([this] { closed_ = true; });
}

void Session::after_asking(const std::function<void()>& then) {
    if (!modified()) return then();
    open_dialog(Dialog::unsaved);
    pending_ = then;
}

void Session::answer_unsaved(Unsaved choice) {
    if (choice == Unsaved::save) return save();
    const auto then = std::exchange(pending_, nullptr);
    close_dialog();
    if (choice == Unsaved::discard && then) then();
}

void Session::open_dialog(Dialog which, DialogInput with) {
    close_dialog();
    dialog = which;
    ask_anew(std::move(with));
}

void Session::close_dialog() {
    dialog = Dialog::none;
    ask_anew({});
    pending_ = nullptr;
}

void Session::ask_anew(DialogInput with) {
    with.opening = input.opening + 1;
    input = std::move(with);
}

// --- messages, queue and jobs

void Session::tell(Message::Level level, const std::string& text) {
    const std::string said = shortened(text, kLongestMessage);
    // Twice the same says nothing new.
    std::erase_if(messages_, [&](const Message& message) { return message.text == said; });
    messages_.push_back({level, said, {}});
    if (messages_.size() > kMostMessages) messages_.erase(messages_.begin());
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
            tell(Message::Level::error, error.what());
        }
    }
    return had_any;
}

void Session::require_no_job() const {
    if (job_) throw std::invalid_argument("wait for \"" + job_->title() + "\", or cancel it");
}

void Session::start(std::string title, Job::Work work) {
    require_no_job();
    job_ = std::make_unique<Job>(std::move(title), std::move(work), hooks.wake);
    job_->wait(attended_ ? kPatience : std::chrono::hours(24));
    poll();
}

void Session::cancel_job() {
    if (!job_) return;
    job_.reset();
    tell(Message::Level::info, "Cancelled");
}

void Session::poll() {
    if (!job_ || !job_->done()) return;
    // What it hands over may start the next one.
    const std::unique_ptr<Job> done = std::move(job_);
    try {
        done->finish();
    } catch (const Cancelled&) {
        tell(Message::Level::info, "Cancelled");
    } catch (const std::bad_alloc&) {
        tell(Message::Level::error, "there is not enough memory for this");
    } catch (const std::exception& error) {
        tell(Message::Level::error, error.what());
    }
}

// --- time

mobb::Interval Session::time_span() const {
    if (crowd()) return {0, crowd()->seconds};
    mobb::Interval span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    const auto add = [&](const PlacedAgent& participant) {
        const mobb::PlacedTree tree = fitted().placed(participant);
        const mobb::PlacedClip& clip = tree.placed_clip();
        span.t0 = std::min(span.t0, clip.time(0));
        span.t1 = std::max(span.t1, clip.time(clip.count()));
    };
    if (view().query) {
        const SceneQuery query = fitted().queries()[static_cast<std::size_t>(*view().query)];
        add(query.a);
        add(query.b);
    } else {
        for (const PlacedAgent& participant : fitted().placed_agents()) add(participant);
    }
    return span.t0 <= span.t1 ? span : mobb::Interval{0, 0};
}

void Session::play() {
    playing_ = true;
    has_played_ = false;
}

void Session::advance(double seconds) {
    // What a job hands over is seen as it was when it began.
    if (!playing_ || empty() || job_) return;
    const mobb::Interval span = time_span();
    double time = view().time.value_or(span.t0) + seconds * speed;
    if (time >= span.t1 || time < span.t0) time = span.t0;
    if (time == view().time) return;
    if (!std::exchange(has_played_, true)) return change_view([&](ViewState& v) { v.time = time; });
    // A drag meanwhile stays one state, and so does the play.
    Document next = document();
    next.view.time = time;
    history_.amend(std::move(next));
    changed();
}

}  // namespace mobbscope::app
