// The part of the session that opens, saves and puts aside.
#include <app/document/session.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cases/case_scene.h>
#include <scene/arrangement.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mobbscope::app {

namespace {

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

/// "crossing.json", or "3 files".
std::string title_of_files(const std::vector<std::filesystem::path>& files) {
    if (files.size() != 1) return counted(files.size(), "file", "files");
    return own_name(files.front());
}

/// When a file was written last; none: there is none, or nobody can say.
std::optional<std::filesystem::file_time_type> time_of(const std::optional<std::filesystem::path>& file) {
    std::error_code error;
    if (!file) return std::nullopt;
    const auto time = std::filesystem::last_write_time(*file, error);
    return error ? std::nullopt : std::optional(time);
}

/// The first that is not there; null: all are.
const std::filesystem::path* missing_of(const std::vector<std::filesystem::path>& files) {
    const auto missing = std::ranges::find_if(files, [](const std::filesystem::path& file) {
        std::error_code ignored;
        return !std::filesystem::exists(file, ignored);
    });
    return missing == files.end() ? nullptr : &*missing;
}

/// What is played on the way to a clip.
SceneClip joint_to(const SceneClip& to, const mobb::ClipPtr& joint) {
    return {"joint to " + to.name, std::nullopt, {}, joint};
}

}  // namespace

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

void Session::turn_away() {
    // What these ask is about the scene that was open.
    const auto is_about_scene = [](Dialog which) {
        return which == Dialog::import_clip || which == Dialog::export_picture || which == Dialog::export_file;
    };
    if (is_about_scene(behind_help_.first)) behind_help_ = {Dialog::none, {}};
    if (dialog == Dialog::export_file) close_dialog();  // to the one that it lies over
    if (is_about_scene(dialog)) close_dialog();
    reviewing_ = false;
    point_at_nothing();
    ++handed_over_;
    // What was offered for the last scene is over with it; before the first one files were named.
    if (openings_ > 0) {
        for (Message& message : messages_) message.offer.reset();
    }
    retire_messages();
}

void Session::replace(Document document, const std::vector<std::filesystem::path>& opened) {
    turn_away();
    jobs_.clear();
    import_changes_.clear();
    import_file_.reset();
    document.view = fitting(document.view, *document.fitted);
    document.excerpt_of = nullptr;
    document.opening = ++openings_;
    saved_ = document.fitted;
    file_ = scene_file_of(opened);
    file_time_ = time_of(file_);
    opened_ = opened;
    remember(opened);
    // One that says no theme is seen in the person's.
    if (attended_ && settings.theme && document.view.theme == Theme{}) document.view.theme = *settings.theme;
    pointed_out_ = {};
    conflict = -1;
    picture_size_.reset();
    cameras_aside.clear();
    alone.reset();
    filter.clear();
    // No case of picture tests is open any more; who opens one says so afterwards.
    aside_.reset();
    open_case_.clear();
    history_.reset(std::move(document));
    changed();
    tell_of_warnings(0);
}

void Session::load(const std::string& title, const LoadAll& load_all, const std::vector<std::filesystem::path>& files,
                   const std::optional<ViewState>& view) {
    const auto begin = [this, title, load_all, files, view] {
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
                const auto put_in = [this, document, files] { replace(document, files); };
                // It takes the place of what was open before the picture tests.
                if (aside_) return close_case([this, put_in] { after_asking(put_in); });
                // Who edited meanwhile is asked again.
                &scene() == &present->scene() ? put_in() : after_asking(put_in);
            };
        };
        start(title, work, Purpose::opens);
    };
    // The scene of a case stays until the file is known to load: what is open before and after is asked for then.
    aside_ ? begin() : after_asking(begin);
}

bool Session::complain_of_missing(const std::vector<std::filesystem::path>& files) {
    const std::filesystem::path* missing = missing_of(files);
    if (missing) tell(MessageLevel::error, missing->string() + ": no such file; check the path");
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
    if (!opened_by_person() && !reviewing_) return open(files);
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
    if (!may_add()) {
        throw InputError(crowd() ? "a run stands alone: open the files by themselves"
                                 : "picture tests are shown: leave them first, or open the files");
    }
    start("Adding files", [this, files](JobControl& control) -> Job::Finish {
        const auto read = std::make_shared<const Scene>(load_files(files, {}, progress_of(control)));
        return [this, read, files] {
            remember(files);
            edit_with_fits({.name = {"adding " + title_of_files(files), ""},
                            .change =
                                [read](Scene& scene) {
                                    const bool was_one = scene.clips.size() == 1;
                                    merge(scene, *read);
                                    if (was_one) lay_out_clips(scene);
                                },
                            .then = [this, read] { tell_of_warnings(scene().clips.size() - read->clips.size()); }});
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
    if (file_ && same_file(file, *file_) && std::exchange(file_time_, time_of(file)) != time_of(file)) {
        throw InputError(file.string(), "",
                         "another program has written it since it was opened: save under another name, or once more "
                         "to overwrite it");
    }
    for (const SceneClip& clip : scene().clips) {
        if (!clip.source || !same_file(file, source_path(scene(), clip))) continue;
        throw InputError(file.string(), "",
                         "clip " + in_quotes(clip.name) + " comes from this file; save under another name");
    }
    Scene saved = scene();
    saved.view = view();
    saved.fit = document().fitted->options();
    move_to_file(saved, file);
    write_file(file, to_json(saved));
    if (in_excerpt()) {
        // The whole stays what is open; the excerpt has a file of its own.
        Document now = document();
        now.excerpt_of = std::make_shared<const ExcerptSource>(ExcerptSource{
            now.excerpt_of->fitted, now.excerpt_of->view, now.fitted, now.excerpt_of->steps, now.excerpt_of->opening});
        history_.amend(std::move(now));
    } else {
        // The document is the file's now: messages and further sources refer to it.
        history_.amend(with_scene(document(), std::move(saved)));
        saved_ = document().fitted;
        file_ = file;
        file_time_ = time_of(file);
        opened_ = {file};
    }
    remember({file});
    tell(MessageLevel::info, "Saved " + file.string());
    tell_of_lost_sources();
    if (dialog == Dialog::save_as || dialog == Dialog::unsaved) dialog = Dialog::none;
    if (const auto then = std::exchange(pending_, nullptr)) then();
}

void Session::tell_of_lost_sources() {
    for (const SceneClip& clip : scene().clips) {
        std::error_code ignored;
        if (!clip.source || std::filesystem::exists(source_path(scene(), clip), ignored)) continue;
        tell(MessageLevel::warning, "The scene refers to " + source_path(scene(), clip).string() +
                                        ", which is not there any more: put it back before the scene is opened again");
        return;
    }
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

// --- excerpts

void Session::open_excerpt(const PlacedAgent& a, const PlacedAgent& b) {
    const auto side = [&](const PlacedAgent& who) {
        return ExcerptSide{who.name, fitted().scene().clips[static_cast<std::size_t>(who.clip)], who.placement};
    };
    open_excerpt_of(side(a), side(b));
}

void Session::open_conflict(const SceneConflict& of) {
    const auto side = [&](const PlacedAgent& who, const mobb::ClipPtr& joint) {
        const SceneClip& clip = scene().clips[static_cast<std::size_t>(who.clip)];
        return ExcerptSide{who.name, joint ? joint_to(clip, joint) : clip, who.placement};
    };
    open_excerpt_of(side(of.a, of.a_joint), side(of.b, of.b_joint));
}

void Session::open_candidate(int candidate) {
    const FollowedChoice* followed = choice();
    const std::vector<Candidate> none;
    const std::vector<Candidate>& asked_for = followed ? followed->choice.candidates : none;
    if (candidate < 0 || candidate >= static_cast<int>(asked_for.size()) ||
        !asked_for[static_cast<std::size_t>(candidate)].blocker) {
        throw std::invalid_argument("nobody rules this candidate out: take one that meets somebody");
    }
    const Candidate& asked = asked_for[static_cast<std::size_t>(candidate)];
    const Blocker& blocker = *asked.blocker;
    // Moves that are turned but not played are none of the run's graph.
    const auto [scene, index] = choosing_.moves->extended(std::array{asked.played, blocker.move});
    const auto clip_of = [&, &run = scene, &at = index](int move) {
        const int clip = run.graph->moves[static_cast<std::size_t>(at[static_cast<std::size_t>(move)])].clip;
        return run.clips[static_cast<std::size_t>(clip)];
    };
    ExcerptSide a{view().follow, clip_of(asked.played), asked.placement};
    if (blocker.before_candidate) {
        a.clip = joint_to(a.clip, asked.joint->clip);
        a.placement = asked.joint->placement;
    }
    ExcerptSide b{crowd()->agents[static_cast<std::size_t>(blocker.agent)].name, clip_of(blocker.move),
                  blocker.placement};
    if (blocker.is_joint) b.clip = joint_to(b.clip, blocker.clip);
    open_excerpt_of(std::move(a), std::move(b));
}

void Session::open_excerpt_of(ExcerptSide a, ExcerptSide b) {
    require_no_job();
    const bool same_clip = a.clip.clip == b.clip.clip;
    if (b.name == a.name) b.name += " (2)";
    // Of a run two plays of one move may run on to different ones.
    if (b.clip.name == a.clip.name) b.clip.name += " (2)";
    Scene excerpt;
    excerpt.file = scene().file;
    excerpt.fit = document().fitted->options();
    excerpt.agents.push_back({a.name, 0, a.placement, std::nullopt});
    excerpt.agents.push_back({b.name, same_clip ? 0 : 1, b.placement, std::nullopt});
    excerpt.clips.push_back(std::move(a.clip));
    if (!same_clip) excerpt.clips.push_back(std::move(b.clip));
    excerpt.view.theme = view().theme;
    excerpt.view.query = 0;
    Document next = document_of(std::move(excerpt), document().fitted.get());
    const Document& now = document();
    // An excerpt of an excerpt is of the same whole.
    ExcerptSource source =
        now.excerpt_of ? *now.excerpt_of : ExcerptSource{now.fitted, now.view, {}, now.steps, now.opening};
    source.saved = next.fitted;
    next.excerpt_of = std::make_shared<const ExcerptSource>(std::move(source));
    next.opening = ++openings_;
    point_at_nothing();
    filter.clear();
    cameras_aside.clear();
    history_.change(std::move(next), {"opening " + a.name + " against " + b.name, ""});
    changed();
}

void Session::leave_excerpt() {
    require_no_job();
    const std::shared_ptr<const ExcerptSource> origin = document().excerpt_of;
    point_at_nothing();
    filter.clear();
    cameras_aside.clear();
    Document whole{origin->fitted, origin->view};
    whole.steps = origin->steps;
    whole.opening = origin->opening;
    history_.change(std::move(whole), {"going back to the whole", ""});
    ++times_put_back_;
    changed();
}

// --- picture tests

void Session::review(const ReviewFolder& found) {
    const auto opened = std::make_shared<Review>(
        found, Review::Surroundings{attended_, hooks.wake, [this](const auto& file) { check_may_write(file); },
                                    case_drawer, may_write});
    close_case([this, opened] {
        stop();
        if (review_) opened->begin_as(*review_);
        review_ = opened;
        reviewing_ = true;
        retire_messages();
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
                Aside before = put_aside();
                replace(document, {});
                aside_ = std::move(before);
                open_case_ = file.name;
            });
        };
    };
    start("Opening " + file.name, work, Purpose::opens);
}

Session::Aside Session::put_aside() {
    return {history_,
            saved_,
            file_,
            file_time_,
            opened_,
            std::exchange(jobs_, {}),
            std::exchange(import_changes_, {}),
            import_file_,
            picture_size_,
            cameras_aside,
            settled_height_,
            alone,
            filter,
            selection,
            pointed_out_,
            found_,
            conflict};
}

void Session::bring_back(Aside before) {
    turn_away();
    history_ = std::move(before.history);
    saved_ = std::move(before.saved);
    file_ = std::move(before.file);
    file_time_ = before.file_time;
    opened_ = std::move(before.opened);
    // What is being opened goes on: it is about no scene that is open.
    for (Running& running : jobs_) {
        if (running.purpose == Purpose::opens) before.jobs.push_back(std::move(running));
    }
    jobs_ = std::move(before.jobs);
    import_changes_ = std::move(before.import_changes);
    import_file_ = std::move(before.import_file);
    picture_size_ = before.picture_size;
    cameras_aside = std::move(before.cameras_aside);
    settled_height_ = before.settled_height;
    alone = std::move(before.alone);
    filter = std::move(before.filter);
    selection = before.selection;
    pointed_into_ = shown();
    pointed_out_ = before.pointed_out;
    found_ = std::move(before.found);
    conflict = before.conflict;
    ++times_put_back_;
    changed();
}

void Session::close_case(const std::function<void()>& then) {
    if (!aside_) return then();
    after_asking([this, then] {
        Aside before = std::move(*aside_);
        aside_.reset();
        open_case_.clear();
        bring_back(std::move(before));
        then();
    });
}

}  // namespace mobbscope::app
