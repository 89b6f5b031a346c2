#include <app/document/session.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cases/case_scene.h>
#include <explain/query_progress.h>
#include <render/drawlist/camera.h>
#include <render/layout/follow.h>
#include <scene/arrangement.h>
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

Document document_of(Scene scene, const FittedScene* previous, const Progress& progress = {}) {
    const mobb::FitOptions options = scene.fit;
    const ViewState view = scene.view;
    return {std::make_shared<const FittedScene>(std::move(scene), options, previous, progress), view};
}

/// The options of each fit of `present` when those of the fit in use become `options`.
std::vector<mobb::FitOptions> fits_with(const FittedScene& present, const mobb::FitOptions& options) {
    std::vector<mobb::FitOptions> out;
    for (const auto& fit : present.fits()) out.push_back(fit->options);
    out[present.fit_in_use()] = options;
    return out;
}

/// The document with another scene, whose `fit` are the options of the fit in use and whose `view` is the active one.
/// Its other fits and views are made anew for that scene; trees that `present` or `fitted_beside` (null: none) has are
/// shared.
Document with_scene(const Document& present, Scene scene, const FittedScene* fitted_beside = nullptr,
                    const Progress& progress = {}) {
    const FittedScene& before = *present.fitted;
    const std::vector<mobb::FitOptions> fits = fits_with(before, scene.fit);
    Document out = present;
    out.view = scene.view;
    scene.fit = fits.front();
    std::vector<const FittedScene*> known{&before};
    if (fitted_beside) known.push_back(fitted_beside);
    FittedScene fitted(std::move(scene), fits.front(), known, progress);
    for (std::size_t i = 1; i < fits.size(); ++i) {
        fitted = fitted.with_fit(before.fits()[i]->name, fits[i], known, progress);
    }
    out.fitted = std::make_shared<const FittedScene>(fitted.using_fit(before.fit_in_use()));
    for (SceneView& other : out.beside) {
        other.fitted = std::make_shared<const FittedScene>(fitted.using_fit(other.fitted->fit_in_use()));
    }
    return out;
}

/// Whether with_scene is done in an instant.
bool quick_to_fit(const Scene& scene, const FittedScene& present, const FittedScene* fitted_beside) {
    std::size_t work = 0;
    for (const mobb::FitOptions& options : fits_with(present, scene.fit)) {
        std::unordered_set<const mobb::Clip*> kept;
        for (const FittedScene* source : {&present, fitted_beside}) {
            if (!source) continue;
            for (const auto& fit : source->fits()) {
                if (fit->options != options) continue;
                for (const auto& tree : fit->trees) kept.insert(&tree->clip());
            }
        }
        for (const SceneClip& clip : scene.clips) {
            if (kept.contains(clip.clip.get())) continue;
            work += static_cast<std::size_t>(clip.clip->count()) *
                    (options.axes == mobb::Axes::minarea ? kSearchFactor : 1);
        }
    }
    return work < kQuickSamples;
}

/// A view of another scene, or of this one before an edit, made to fit what there is.
ViewState fitting(ViewState view, const FittedScene& fitted) {
    if (view.query && static_cast<std::size_t>(*view.query) >= fitted.queries().size()) view.query.reset();
    if (!view.follow.empty() && !can_follow(fitted.scene(), view.follow)) view.follow.clear();
    drop_unknown_names(fitted.scene(), view);
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
    change_document(with_scene(document(), changed_scene(change)), name);
}

void Session::refit(const EditName& name, const std::function<void(mobb::FitOptions&)>& change) {
    edit_with_fits(
        name, [change](Scene& scene) { change(scene.fit); }, nullptr);
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

void Session::edit_with_fits(const EditName& name, const std::function<void(Scene&)>& change,
                             const FittedScene* fitted_beside, Purpose purpose) {
    Scene next = changed_scene(change);
    if (quick_to_fit(next, *document().fitted, fitted_beside)) {
        return change_document(with_scene(document(), std::move(next), fitted_beside), name);
    }
    start(
        "Fitting trees",
        [this, name, change, purpose, before = document(), next = std::move(next)](JobControl& control) -> Job::Finish {
            const Document fitted = with_scene(before, next, nullptr, progress_of(control));
            // The document may have changed meanwhile: the edit is made on what it is now, with the trees made here.
            return
                [this, name, change, fitted, purpose] { edit_with_fits(name, change, fitted.fitted.get(), purpose); };
        },
        purpose);
}

/// Where a query was left is where it is opened again.
void Session::remember_step(Document& next) const {
    const std::optional<int>& left = view().query;
    if (left && next.view.query != left) next.steps[query_key(*document().fitted, *left)] = view().step;
}

void Session::show_query(int query, std::optional<Step> step) {
    const auto left = document().steps.find(query_key(*document().fitted, query));
    if (!step && query == view().query) step = view().step;
    if (!step && left != document().steps.end()) step = left->second;
    change_view([&](ViewState& view) {
        view.query = query;
        view.step = step.value_or(Step{});
    });
}

void Session::change_document(Document next, const EditName& name) {
    remember_step(next);
    // A node of a tree that was fitted anew is another one, or none.
    if (next.view.projection && !has_projection(*next.fitted, next.view)) next.view.projection.reset();
    next.view = fitting(next.view, *next.fitted);
    for (SceneView& other : next.beside) other.view = fitting(other.view, *other.fitted);
    history_.change(std::move(next), name);
    changed();
}

void Session::amend(const std::function<void(Document&)>& change) {
    Document next = document();
    change(next);
    history_.amend(std::move(next));
    changed();
}

void Session::change_view(const std::function<void(ViewState&)>& change) {
    Document next = document();
    change(next.view);
    next.view = fitting(next.view, *next.fitted);
    if (next.view == view()) return;
    if (next.view.theme != view().theme) settings.theme = next.view.theme;
    remember_step(next);
    history_.change_view(std::move(next));
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
    change_document(std::move(next), {"splitting the view", ""});
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

void Session::resize_pictures(PictureSize from, PictureSize to) {
    const auto resize = [&](Camera& camera) {
        if (camera.target) camera = resized(camera, from, to);
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
    const std::shared_ptr<const ExcerptSource> before = document().excerpt_of;
    stop();
    history_.go_to(state);
    // What is made for an excerpt is not put into the whole, nor the other way round.
    if (document().excerpt_of != before) {
        while (!jobs_.empty()) cancel_job(0);
        cameras_aside.clear();
    }
    changed();
}

Session::BeforeDrag Session::before_drag() const {
    return {history_, settings, handed_over_, hooks.viewport_size ? hooks.viewport_size() : PictureSize{}};
}

void Session::restore(BeforeDrag before) {
    if (before.handed_over != handed_over_) return;
    const PictureSize size = hooks.viewport_size ? hooks.viewport_size() : before.size;
    history_ = std::move(before.history);
    settings = std::move(before.settings);
    // A border between panels may be what was dragged: the picture is as high as it is until the next frame.
    if (size.height != before.size.height) {
        history_.amend_views([&](ViewState& view) {
            if (view.camera.target) view.camera = resized(view.camera, before.size, size);
        });
    }
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
                return tell(Message::Level::info, "The scene has changed: look for conflicts again");
            }
            found_ = Found{in, std::move(found)};
            conflict = -1;
        };
    });
}

void Session::open_excerpt(const PlacedAgent& a, const PlacedAgent& b) {
    require_no_job();
    Scene excerpt;
    excerpt.file = scene().file;
    excerpt.fit = document().fitted->options();
    excerpt.clips.push_back(scene().clips[static_cast<std::size_t>(a.clip)]);
    if (b.clip != a.clip) excerpt.clips.push_back(scene().clips[static_cast<std::size_t>(b.clip)]);
    excerpt.agents.push_back({a.name, 0, a.placement, std::nullopt});
    excerpt.agents.push_back(
        {b.name == a.name ? b.name + " (2)" : b.name, b.clip == a.clip ? 0 : 1, b.placement, std::nullopt});
    excerpt.view.theme = view().theme;
    excerpt.view.query = 0;
    Document next = document_of(std::move(excerpt), document().fitted.get());
    const std::shared_ptr<const ExcerptSource> before = document().excerpt_of;
    next.excerpt_of = std::make_shared<const ExcerptSource>(ExcerptSource{before ? before->fitted : document().fitted,
                                                                          before ? before->view : view(), next.fitted,
                                                                          before ? before->steps : document().steps});
    point_at_nothing();
    filter.clear();
    cameras_aside.clear();
    ++excerpts_opened_;
    history_.change(std::move(next), {"opening " + a.name + " against " + b.name, ""});
    changed();
}

void Session::point_at_nothing() {
    stop();
    selection = {};
    hovered = {};
}

void Session::leave_excerpt() {
    require_no_job();
    const std::shared_ptr<const ExcerptSource> origin = document().excerpt_of;
    point_at_nothing();
    filter.clear();
    cameras_aside.clear();
    Document whole{origin->fitted, origin->view};
    whole.steps = origin->steps;
    history_.change(std::move(whole), {"going back to the whole", ""});
    changed();
}

// --- files

bool Session::modified() const {
    // Views of one scene share it, whichever fit they use.
    const auto differ = [](const auto& a, const auto& b) { return &a->scene() != &b->scene(); };
    const std::shared_ptr<const ExcerptSource>& origin = document().excerpt_of;
    if (!origin) return differ(document().fitted, saved_);
    return differ(origin->fitted, saved_) || differ(document().fitted, origin->saved);
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
    jobs_.clear();
    import_changes_.clear();
    import_file_.reset();
    if (dialog == Dialog::import_clip) close_dialog();
    reviewing_ = false;
    document.view = fitting(document.view, *document.fitted);
    document.excerpt_of = nullptr;
    saved_ = document.fitted;
    file_ = scene_file_of(opened);
    opened_ = opened;
    ++files_opened_;
    remember(opened);
    // One that says no theme is seen in the person's.
    if (attended_ && settings.theme && document.view.theme == Theme{}) document.view.theme = *settings.theme;
    point_at_nothing();
    pointed_out_ = {};
    conflict = -1;
    cameras_aside.clear();
    alone.reset();
    filter.clear();
    ++handed_over_;
    // No case of picture tests is open any more; who opens one says so afterwards.
    aside_.reset();
    open_case_.clear();
    if (behind_help_.first == Dialog::import_clip) behind_help_ = {Dialog::none, {}};
    // What went wrong with the last document is over, and what was offered for it.
    for (Message& message : messages_) {
        if (files_opened_ > 1) message.offer.reset();
        if (message.level != Message::Level::info) message.up = false;
    }
    history_.reset(std::move(document));
    changed();
    tell_of_warnings(0);
}

void Session::load(const std::string& title, const LoadAll& load_all, const std::vector<std::filesystem::path>& files,
                   const std::optional<ViewState>& view) {
    // What is opened takes the place of what was open before the picture tests.
    if (aside_) return close_case([this, title, load_all, files, view] { load(title, load_all, files, view); });
    after_asking([this, title, load_all, files, view] {
        // What is opened last is meant.
        std::erase_if(jobs_, [](const Running& running) { return running.purpose == Purpose::opens; });
        const auto work = [this, load_all, files, view,
                           present = document().fitted](JobControl& control) -> Job::Finish {
            Document document = document_of(load_all(control), nullptr, progress_of(control));
            if (view) {
                document.view = *view;
                // The file may have changed since.
                if (view->projection && !has_projection(*document.fitted, *view)) document.view.projection.reset();
            }
            return [this, document = std::move(document), files, present] {
                // Who edited meanwhile is asked again.
                if (&scene() == &present->scene()) return replace(document, files);
                after_asking([this, document, files] { replace(document, files); });
            };
        };
        start(title, work, Purpose::opens);
    });
}

namespace {

/// "crossing.json", or "3 files".
std::string title_of_files(const std::vector<std::filesystem::path>& files) {
    if (files.size() != 1) return counted(files.size(), "file", "files");
    // A folder may end in a slash.
    const std::filesystem::path& only = files.front();
    return (only.has_filename() ? only : only.parent_path()).filename().string();
}

/// The first that is not there; null: all are.
const std::filesystem::path* missing_of(const std::vector<std::filesystem::path>& files) {
    const auto missing = std::ranges::find_if(files, [](const std::filesystem::path& file) {
        std::error_code ignored;
        return !std::filesystem::exists(file, ignored);
    });
    return missing == files.end() ? nullptr : &*missing;
}

}  // namespace

bool Session::complain_of_missing(const std::vector<std::filesystem::path>& files) {
    const std::filesystem::path* missing = missing_of(files);
    if (missing) tell(Message::Level::error, missing->string() + ": no such file; check the path");
    return missing;
}

void Session::open(const std::vector<std::filesystem::path>& files) {
    // Nobody is asked about unsaved changes for nothing.
    if (complain_of_missing(files)) return;
    load(
        "Opening " + title_of_files(files),
        [files](JobControl& control) { return load_files(files, {}, progress_of(control)); }, files);
}

void Session::remember(const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return;
    if (attended_) {
        // The first of them comes first.
        for (auto file = files.rbegin(); file != files.rend(); ++file) settings.remember(*file);
    }
    std::error_code error;
    const std::filesystem::path& first = files.front();
    std::filesystem::path folder = std::filesystem::is_directory(first, error) ? first : first.parent_path();
    if (folder.empty()) folder = ".";
    // Scripts and pictures find the same wherever they run.
    settings.folder = attended_ ? std::filesystem::absolute(folder, error).lexically_normal() : folder;
}

bool Session::opened_by_person() const {
    if (empty()) return false;
    if (file() || modified() || in_excerpt()) return true;
    try {
        return scene().file != demo_scene_file();
    } catch (const MachineError&) {
        return true;
    }
}

void Session::drop(const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return;
    if (complain_of_missing(files)) return;
    if (!opened_by_person()) return open(files);
    open_dialog(Dialog::dropped, {.text = "", .files = files});
}

void Session::note_session() {
    if (opened_.empty()) return;
    settings.last = {{}, in_excerpt() ? document().excerpt_of->view : view()};
    for (const std::filesystem::path& file : opened_) {
        std::error_code error;
        settings.last.files.push_back(std::filesystem::absolute(file, error).lexically_normal());
    }
}

bool Session::has_last() const { return !settings.last.files.empty() && !missing_of(settings.last.files); }

std::string Session::last_title() const { return title_of_files(settings.last.files); }

void Session::reopen_last() {
    const LastSession last = settings.last;
    if (complain_of_missing(last.files)) return;
    load(
        "Opening " + last_title(),
        [last](JobControl& control) { return load_files(last.files, {}, progress_of(control)); }, last.files,
        last.view);
}

void Session::open_scene(const Scene& scene, const std::vector<std::filesystem::path>& files) {
    load(
        "Opening " + scene.file.filename().string(), [scene](JobControl&) { return scene; }, files);
}

void Session::open_demo() {
    load("Opening the demo", [](JobControl&) { return demo_scene(); }, {});
}

void Session::add(const std::vector<std::filesystem::path>& files) {
    if (empty()) return open(files);
    if (complain_of_missing(files)) return;
    if (crowd()) throw InputError("a run stands alone: open the files by themselves");
    start("Adding files", [this, files](JobControl& control) -> Job::Finish {
        const auto read = std::make_shared<const Scene>(load_files(files, {}, progress_of(control)));
        return [this, read, files] {
            remember(files);
            const std::size_t before = scene().clips.size();
            edit_with_fits(
                {"adding files", ""},
                [read](Scene& scene) {
                    const bool was_one = scene.clips.size() == 1;
                    merge(scene, *read);
                    if (was_one) lay_out_clips(scene);
                },
                nullptr);
            tell_of_warnings(before);
        };
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
    saved.fit = document().fitted->options();
    move_to_file(saved, file);
    write_file(file, to_json(saved));
    if (in_excerpt()) {
        // The whole stays what is open; the excerpt has a file of its own.
        Document now = document();
        now.excerpt_of = std::make_shared<const ExcerptSource>(
            ExcerptSource{now.excerpt_of->fitted, now.excerpt_of->view, now.fitted, now.excerpt_of->steps});
        history_.amend(std::move(now));
    } else {
        // The document is the file's now: messages and further sources refer to it.
        history_.amend(with_scene(document(), std::move(saved)));
        saved_ = document().fitted;
        file_ = file;
        opened_ = {file};
    }
    remember({file});
    tell(Message::Level::info, "Saved " + file.string());
    if (dialog == Dialog::save_as || dialog == Dialog::unsaved) dialog = Dialog::none;
    if (const auto then = std::exchange(pending_, nullptr)) then();
}

void Session::request_close() {
    if (aside_) return close_case([this] { request_close(); });
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

// --- picture tests

void Session::review(const std::filesystem::path& folder, const std::filesystem::path& output) {
    const auto opened = std::make_shared<Review>(
        folder, output,
        Review::Surroundings{attended_, hooks.wake, [this](const auto& file) { check_may_write(file); }, case_drawer});
    close_case([this, opened] {
        stop();
        review_ = opened;
        reviewing_ = true;
        if (review_->output().empty()) review_->draw_all();
        poll();
    });
}

void Session::leave_review() {
    close_case([this] { reviewing_ = false; });
}

void Session::back_to_review() {
    stop();
    reviewing_ = true;
}

void Session::open_case(std::size_t index) {
    const picture_tests::CaseFile file = review_->cases()[index].file;
    // What is opened last is meant.
    std::erase_if(jobs_, [](const Running& running) { return running.purpose == Purpose::opens; });
    const auto work = [this, file](JobControl& control) -> Job::Finish {
        Document document = document_of(picture_tests::scene_of(file), nullptr, progress_of(control));
        return [this, document = std::move(document), file] {
            // The scene of another case may be in its place.
            close_case([this, document, file] {
                Aside before{history_, saved_, file_, opened_};
                replace(document, {});
                aside_ = std::move(before);
                open_case_ = file.name;
            });
        };
    };
    start("Opening " + file.name, work, Purpose::opens);
}

void Session::close_case(const std::function<void()>& then) {
    if (!aside_) return then();
    after_asking([this, then] {
        const Aside before = std::move(*aside_);
        aside_.reset();
        open_case_.clear();
        replace(before.history.now(), before.opened);
        history_ = before.history;
        saved_ = before.saved;
        file_ = before.file;
        changed();
        then();
    });
}

// --- messages, queue and jobs

void Session::tell(Message::Level level, const std::string& text, std::optional<MessageOffer> offer) {
    const std::string said = shortened(text, kLongestMessage);
    // Twice the same says nothing new.
    std::erase_if(messages_, [&](const Message& message) { return message.text == said; });
    messages_.push_back({level, said, std::move(offer), {}, 0, true, level == Message::Level::info});
    if (messages_.size() > kMostMessages) messages_.erase(messages_.begin());
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
            message.goes_at = now + (message.offer                           ? kOfferSeconds
                                     : message.level == Message::Level::info ? kInfoSeconds
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
        messages_, [](const Message& message) { return message.up && message.level != Message::Level::info; });
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
    if (!jobs_.empty()) throw std::invalid_argument("wait for \"" + job()->title() + "\", or cancel it");
}

void Session::start(std::string title, Job::Work work, Purpose purpose) {
    jobs_.push_back({std::make_unique<Job>(std::move(title), std::move(work), hooks.wake), purpose});
    jobs_.back().job->wait(attended_ ? kPatience : std::chrono::hours(24));
    poll();
}

void Session::cancel_job(std::size_t index) {
    if (index >= jobs_.size()) return;
    if (jobs_[index].purpose == Purpose::imports) import_changes_.clear();
    jobs_.erase(jobs_.begin() + static_cast<std::ptrdiff_t>(index));
    tell(Message::Level::info, "Cancelled");
}

void Session::poll() {
    if (review_) {
        for (const std::string& news : review_->poll()) tell(Message::Level::info, news);
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
}

void Session::advance(double seconds) {
    if (!playing_ || empty()) return;
    const mobb::Interval span = time_span();
    double time = view().time.value_or(span.t0) + seconds * speed;
    if (time >= span.t1 || time < span.t0) time = span.t0;
    if (time == view().time) return;
    if (!std::exchange(has_played_, true)) return change_view([&](ViewState& v) { v.time = time; });
    // A drag meanwhile stays one state, and so does the play.
    amend([&](Document& next) { next.view.time = time; });
}

}  // namespace mobbscope::app
