#include <app/document/unsaved_work.h>
#include <app/session/files.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <explain/trace_comparison.h>
#include <scene/arrangement.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mobbscope::app {

namespace {

/// The jobs of that purpose go on in another workspace.
void carry_over(Workspace& from, JobPurpose purpose, Workspace& to) {
    for (RunningJob& running : from.jobs) {
        if (running.purpose == purpose) to.jobs.push_back(std::move(running));
    }
    std::erase_if(from.jobs, [](const RunningJob& running) { return !running.job; });
}

/// Throws InputError if a file is the source of a clip.
void check_is_no_source(const Scene& scene, const std::filesystem::path& file) {
    for (const SceneClip& clip : scene.clips) {
        if (!clip.source || !is_same_file(file, source_path(scene, clip))) continue;
        throw InputError(file.string(), "",
                         "clip " + in_quotes(clip.name) + " comes from this file; give another name");
    }
}

/// "crossing.json", or "3 files".
std::string title_of_files(const std::vector<std::filesystem::path>& files) {
    if (files.size() != 1) return counted(files.size(), "file", "files");
    return own_name(files.front());
}

constexpr std::size_t kMostLookedAt = 1000;  // sources of clips

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

}  // namespace

void Files::turn_away() {
    parts_.dialogs.close_those_about_scene();
    parts_.screen = nullptr;
    parts_.playback.stop();
    ++parts_.counts.arrivals;
    // What was offered for the last scene is over with it; before the first one files were named.
    if (parts_.counts.openings > 0) parts_.notifications.withdraw_offers();
    parts_.notifications.retire();
}

void Files::replace(Document document, const std::vector<std::filesystem::path>& opened) {
    turn_away();
    document.view = clamped(document.view, *document.fitted);
    document.excerpt_of = nullptr;
    document.opening = ++parts_.counts.openings;
    Workspace next(parts_.settings);
    next.saved = document.fitted;
    next.file = scene_file_of(opened);
    next.file_time = time_of(next.file);
    next.opened = opened;
    remember(opened);
    // One that says no theme is seen in the person's.
    const std::optional<Theme>& theme = parts_.settings.theme;
    if (parts_.options.attended && theme && document.view.theme == Theme{}) document.view.theme = *theme;
    next.history.reset(std::move(document));
    next.changed();
    // Nothing is visited any more; who visits something says so afterwards.
    suspended_.reset();
    visited_.clear();
    carry_over(parts_.workspace, JobPurpose::film, next);
    parts_.workspace = std::move(next);
    look_at_files();
    parts_.imports.tell_of_warnings(0);
    check_stored();
}

void Files::check_stored() {
    const std::vector<SceneQuery>& queries = parts_.workspace.scene().queries;
    if (std::ranges::none_of(queries, [](const SceneQuery& query) { return query.expect || query.trace; })) return;
    parts_.jobs.start(
        "Checking stored answers", [this, in = parts_.workspace.document().fitted](JobControl& control) -> Job::Finish {
            Workspace::StoredDifferences found{in, {}};
            const std::vector<SceneQuery>& asked = in->scene().queries;
            for (std::size_t i = 0; i < asked.size(); ++i) {
                control.step(i, asked.size());
                if (!asked[i].expect && !asked[i].trace) continue;
                if (auto words = check_query(*in, asked[i]).complaint())
                    found.queries.emplace(static_cast<int>(i), std::move(*words));
            }
            return [this, found = std::move(found)]() mutable {
                if (found.queries.empty() || &found.in->scene() != &parts_.workspace.scene()) return;
                const auto& [query, words] = *found.queries.begin();
                const std::size_t others = found.queries.size() - 1;
                const std::string more =
                    others > 0 ? " (and " + counted(others, "more query", "more queries") + ")" : "";
                parts_.notifications.tell(MessageLevel::warning, "query " + std::to_string(query) + ": " + words + more,
                                          {{"query.select", std::to_string(query), "Show it"}});
                parts_.workspace.stored_differences = std::move(found);
            };
        });
}

std::vector<std::filesystem::path> Files::look_at_files() {
    std::vector<std::filesystem::path> changed;
    const auto look_at = [&](const std::filesystem::path& file) {
        const auto [known, is_new] = parts_.workspace.seen_files.try_emplace(file, std::nullopt);
        const auto now = time_of(file);
        if (std::exchange(known->second, now) != now && !is_new) changed.push_back(file);
    };
    if (parts_.workspace.file) look_at(*parts_.workspace.file);
    std::set<std::filesystem::path> sources;
    for (const SceneClip& clip : parts_.workspace.scene().clips) {
        if (!clip.source || sources.size() == kMostLookedAt) continue;
        const std::filesystem::path source = source_path(parts_.workspace.scene(), clip);
        if (sources.insert(source).second) look_at(source);
    }
    return changed;
}

void Files::tell_of_changed_files() { tell_of(look_at_files()); }

void Files::tell_of(const std::vector<std::filesystem::path>& changed) {
    if (changed.empty()) return;
    const auto gone = std::ranges::find_if(changed, [](const auto& file) { return !time_of(file); });
    const std::string others =
        changed.size() > 1 ? " (and " + counted(changed.size() - 1, "more file", "more files") + ")" : "";
    if (gone == changed.end()) {
        parts_.notifications.tell(MessageLevel::warning,
                                  changed.front().string() + " was changed by another program" + others,
                                  {{"file.reload", "", "Reload"}});
    } else {
        parts_.notifications.tell(MessageLevel::warning,
                                  gone->string() + " was removed by another program" + others +
                                      (*gone == parts_.workspace.file ? "; Save writes it again" : ""));
    }
}

void Files::load(const std::string& title, const Opening& opening, Replaces replaces) {
    const auto begin = [this, title, opening] {
        // What is opened last is meant.
        parts_.jobs.drop(JobPurpose::opens);
        const auto work = [this, opening,
                           present = parts_.workspace.document().fitted](JobControl& control) -> Job::Finish {
            return [this, put_in = opening(control), present] {
                // It replaces the suspended workspace.
                if (suspended_) return come_back([this, put_in] { after_asking(put_in); });
                // Who edited meanwhile is asked again.
                &parts_.workspace.scene() == &present->scene() ? put_in() : after_asking(put_in);
            };
        };
        parts_.jobs.start(title, work, JobPurpose::opens);
    };
    // The scene of a case stays until the file is known to load: what is open before and after is asked for then.
    suspended_ || replaces == Replaces::what_it_holds ? begin() : after_asking(begin);
}

void Files::load_scene(const std::string& title, const LoadAll& load_all,
                       const std::vector<std::filesystem::path>& files, const std::optional<ViewState>& view) {
    load(title, [this, load_all, files, view](JobControl& control) -> std::function<void()> {
        Document document = document_of(load_all(control), nullptr, progress_of(control));
        if (view) document.view = *view;
        return [this, document = std::move(document), files] { replace(document, files); };
    });
}

void Files::open_made(const std::string& title, const std::function<MadeScene(JobControl&)>& make, Replaces replaces) {
    load(
        title,
        [this, make](JobControl& control) -> std::function<void()> {
            MadeScene made = make(control);
            return
                [this, document = document_of(std::move(made.scene), nullptr, progress_of(control)), then = made.then] {
                    replace(document, {});
                    parts_.workspace.saved = document_of({}, nullptr).fitted;
                    then();
                };
        },
        replaces);
}

void Files::open_unsaved(const std::filesystem::path& copy, const std::string& title,
                         const std::function<void()>& then) {
    load("Restoring " + title, [this, copy, then](JobControl& control) -> std::function<void()> {
        const auto read = [&] {
            try {
                return read_unsaved(copy, progress_of(control));
            } catch (const InputError& error) {
                throw InputError(std::string(error.what()) + "; the copy is kept");
            }
        };
        return [this, work = read(), then] {
            replace(work.document, work.opened);
            put_in(parts_.workspace, work);
            then();
        };
    });
}

bool Files::complain_of_missing(const std::vector<std::filesystem::path>& files) {
    const std::filesystem::path* missing = missing_of(files);
    if (missing) parts_.notifications.tell(MessageLevel::error, missing->string() + ": no such file; check the path");
    return missing;
}

void Files::open(const std::vector<std::filesystem::path>& files) {
    // Nobody is asked about unsaved changes for nothing.
    if (complain_of_missing(files)) return;
    load_scene(
        "Opening " + title_of_files(files),
        [files](JobControl& control) { return load_files(files, {}, progress_of(control)); }, files);
}

void Files::remember(const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return;
    if (parts_.options.attended) {
        // The first of them comes first.
        for (auto file = files.rbegin(); file != files.rend(); ++file) parts_.settings.remember(*file);
    }
    std::error_code error;
    const std::filesystem::path& first = files.front();
    std::filesystem::path folder = std::filesystem::is_directory(first, error) ? first : first.parent_path();
    if (folder.empty()) folder = ".";
    // Scripts and pictures find the same wherever they run.
    parts_.settings.folder =
        parts_.options.attended ? std::filesystem::absolute(folder, error).lexically_normal() : folder;
    // However the window ends, and for other windows.
    parts_.settings_file.save(parts_.settings);
}

bool Files::opened_by_person() const {
    if (parts_.workspace.empty()) return false;
    if (parts_.workspace.file || parts_.workspace.modified() || parts_.workspace.in_excerpt()) return true;
    try {
        return parts_.workspace.scene().file != demo_scene_file();
    } catch (const MachineError&) {
        return true;
    }
}

void Files::drop(const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return;
    if (complain_of_missing(files)) return;
    if (!opened_by_person() && !parts_.screen) return open(files);
    parts_.dialogs.open(Dialog::dropped, {.text = "", .files = files});
}

void Files::note_session() {
    if (parts_.workspace.opened.empty()) return;
    parts_.settings.last = {
        {}, parts_.workspace.in_excerpt() ? parts_.workspace.document().excerpt_of->view : parts_.workspace.view()};
    for (const std::filesystem::path& file : parts_.workspace.opened) {
        std::error_code error;
        parts_.settings.last.files.push_back(std::filesystem::absolute(file, error).lexically_normal());
    }
}

bool Files::has_last() const { return !parts_.settings.last.files.empty() && !missing_of(parts_.settings.last.files); }

std::string Files::last_title() const { return title_of_files(parts_.settings.last.files); }

void Files::reopen_last() {
    const LastSession last = parts_.settings.last;
    if (complain_of_missing(last.files)) return;
    load_scene(
        "Opening " + last_title(),
        [last](JobControl& control) { return load_files(last.files, {}, progress_of(control)); }, last.files,
        last.view);
}

void Files::open_scene(const Scene& scene, const std::vector<std::filesystem::path>& files) {
    load_scene(
        "Opening " + scene.file.filename().string(), [scene](JobControl&) { return scene; }, files);
}

void Files::open_demo() {
    load_scene("Opening the demo", [](JobControl&) { return demo_scene(); }, {});
}

void Files::add(const std::vector<std::filesystem::path>& files) {
    if (parts_.workspace.empty()) return open(files);
    if (complain_of_missing(files)) return;
    if (!may_add()) {
        throw InputError(parts_.workspace.crowd() ? "a run cannot be combined with other files: open them by themselves"
                                                  : std::string(parts_.screen->words().shown) + ", or open the files");
    }
    parts_.jobs.start("Adding files", [this, files](JobControl& control) -> Job::Finish {
        const auto read = std::make_shared<const Scene>(load_files(files, {}, progress_of(control)));
        return [this, read, files] {
            remember(files);
            parts_.edits.edit({.name = {"adding " + title_of_files(files), ""},
                               .change =
                                   [read](Scene& scene) {
                                       const bool was_one = scene.clips.size() == 1;
                                       merge(scene, *read);
                                       if (was_one) lay_out_clips(scene);
                                   },
                               .then =
                                   [this, read] {
                                       parts_.imports.tell_of_warnings(parts_.workspace.scene().clips.size() -
                                                                       read->clips.size());
                                   }});
        };
    });
}

void Files::save() {
    if (!parts_.workspace.file || parts_.workspace.in_excerpt()) {
        parts_.dialogs.ask_where_to_save();
        return;
    }
    save_as(*parts_.workspace.file);
}

void Files::check_may_write(const std::filesystem::path& file) const {
    if (parts_.options.may_write) return;
    throw InputError(file.string(), "",
                     "nothing is written here: a picture test only looks; remove this from its script");
}

void Files::check_may_export(const std::filesystem::path& file) const {
    check_may_write(file);
    if (parts_.workspace.file && is_same_file(file, *parts_.workspace.file))
        throw InputError(file.string(), "", "is what is open; give another output");
    check_is_no_source(parts_.workspace.scene(), file);
}

void Files::save_as(const std::filesystem::path& file) {
    check_may_write(file);
    if (parts_.workspace.empty()) throw InputError("there is nothing to save: open a scene or a clip first");
    check_file_name(file);
    if (lower_extension(file) != ".json") {
        throw InputError(file.string(), "", "scenes are written as .json; rename the output");
    }
    if (parts_.workspace.in_excerpt() && parts_.workspace.file && is_same_file(file, *parts_.workspace.file)) {
        throw InputError(file.string(), "", "the excerpt was taken from this file; save it under another name");
    }
    if (parts_.workspace.file && is_same_file(file, *parts_.workspace.file) && time_of(file) &&
        std::exchange(parts_.workspace.file_time, time_of(file)) != time_of(file)) {
        throw InputError(file.string(), "",
                         "another program has written it since it was opened: save under another name, or save again "
                         "to overwrite it");
    }
    const bool was_removed =
        parts_.workspace.file && parts_.workspace.file_time && file == *parts_.workspace.file && !time_of(file);
    check_is_no_source(parts_.workspace.scene(), file);
    std::vector<std::filesystem::path> changed = look_at_files();
    // What is gone is said below.
    std::erase_if(changed, [&](const auto& each) { return each == file || !time_of(each); });
    tell_of(changed);
    Scene saved = parts_.workspace.scene();
    saved.view = parts_.workspace.view();
    saved.fit = parts_.workspace.document().fitted->options();
    move_to_file(saved, file);
    write_to_disk(file, to_json(saved));
    if (parts_.workspace.in_excerpt()) {
        // The whole stays what is open; the excerpt has a file of its own.
        Document now = parts_.workspace.document();
        ExcerptSource source = *now.excerpt_of;
        source.saved = now.fitted;
        now.excerpt_of = std::make_shared<const ExcerptSource>(std::move(source));
        parts_.workspace.history.amend(std::move(now));
    } else {
        // The document is the file's now: messages and further sources refer to it.
        parts_.workspace.history.amend(with_scene(parts_.workspace.document(), std::move(saved)));
        parts_.workspace.saved = parts_.workspace.document().fitted;
        parts_.workspace.file = file;
        parts_.workspace.file_time = time_of(file);
        parts_.workspace.opened = {file};
    }
    look_at_files();
    remember({file});
    parts_.notifications.tell(MessageLevel::info,
                              "Saved " + file.string() + (was_removed ? ", which another program had removed" : ""));
    tell_of_lost_sources();
    if (parts_.dialogs.now == Dialog::save_as || parts_.dialogs.now == Dialog::unsaved)
        parts_.dialogs.now = Dialog::none;
    if (const auto then = parts_.dialogs.take_waiting()) then();
}

void Files::tell_of_lost_sources() {
    for (const SceneClip& clip : parts_.workspace.scene().clips) {
        std::error_code ignored;
        if (!clip.source || std::filesystem::exists(source_path(parts_.workspace.scene(), clip), ignored)) continue;
        parts_.notifications.tell(MessageLevel::warning,
                                  "The scene refers to " + source_path(parts_.workspace.scene(), clip).string() +
                                      ", which is not there any more: put it back before the scene is opened again");
        return;
    }
}

void Files::request_close() {
    if (suspended_) return come_back([this] { request_close(); });
    const bool asked = std::exchange(asked_about_films_, parts_.jobs.any(JobPurpose::film));
    if (asked_about_films_ && !asked) {
        return parts_.notifications.tell_of_window(
            MessageLevel::warning, "A film is being made, and quitting ends it: quit once more, or wait for the film",
            {{"file.quit", "", "Quit now"}});
    }
    after_asking([this] { closed_ = true; });
}

void Files::after_asking(const std::function<void()>& then) {
    if (!parts_.workspace.modified()) return then();
    parts_.dialogs.ask_about_unsaved(then);
}

void Files::answer_unsaved(Unsaved choice) {
    if (choice == Unsaved::save) return save();
    const auto then = parts_.dialogs.take_waiting();
    parts_.dialogs.close();
    if (choice == Unsaved::discard && then) then();
}

void Files::visit(Document document, const std::string& name) {
    // Another one may be in its place.
    come_back([this, document = std::move(document), name] {
        Workspace before = std::move(parts_.workspace);
        replace(document, {});
        carry_over(before, JobPurpose::film, parts_.workspace);
        suspended_ = std::move(before);
        visited_ = name;
    });
}

void Files::come_back(const std::function<void()>& then) {
    if (!suspended_) return then();
    after_asking([this, then] {
        turn_away();
        Workspace before = std::move(*suspended_);
        suspended_.reset();
        visited_.clear();
        // What is being opened goes on: it is about no scene that is open.
        carry_over(parts_.workspace, JobPurpose::opens, before);
        carry_over(parts_.workspace, JobPurpose::film, before);
        parts_.workspace = std::move(before);
        parts_.workspace.hovered = {};
        ++parts_.counts.restores;
        parts_.workspace.changed();
        then();
    });
}

void Files::end_work() {
    constexpr std::chrono::seconds kLongest(2);
    for (const RunningJob& running : parts_.workspace.jobs) {
        if (running.purpose != JobPurpose::film) continue;
        // So that nothing is left of it.
        running.job->cancel();
        running.job->wait(kLongest);
    }
    parts_.workspace.jobs.clear();
    parts_.workspace.import_changes.clear();
    if (suspended_) suspended_->jobs.clear();
}

}  // namespace mobbscope::app
