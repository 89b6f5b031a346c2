#include <app/session/imports.h>
#include <base/error.h>
#include <base/text.h>

#include <algorithm>
#include <map>
#include <new>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mobbscope::app {

namespace {

/// Why something failed, in one line; the file stands in the dialog's head already.
std::string without_file(const std::string& what, const std::filesystem::path& file) {
    const std::string head = file.string() + ": ";
    return what.starts_with(head) ? what.substr(head.size()) : what;
}

}  // namespace

void Imports::open(int clip, const std::string& field) {
    const SceneClip& opened = workspace_.scene().clips.at(static_cast<std::size_t>(clip));
    if (!opened.source) {
        throw std::invalid_argument(in_quotes(opened.name) +
                                    " has its samples in the scene: there is nothing to import");
    }
    dialogs_.open(Dialog::import_clip);
    // What they say stands at the fields now.
    notifications_.dismiss_offers("clip.import");
    edited = {.clip = clip, .field = field};
    // What is wrong with one track of a crowd is wrong with all.
    edited.whole_file = opened.options.id.has_value();
    ask_for_offer();
}

std::vector<std::pair<int, ImportOptions>> Imports::options_wanted(const ImportChange& change) const {
    std::vector<std::pair<int, ImportOptions>> out;
    if (static_cast<std::size_t>(change.clip) >= workspace_.scene().clips.size()) return out;
    const ImportOption& option = *import_option(change.option);
    const bool all = change.whole_file && option.of_file;
    for (const int index :
         all ? clips_of_same_source(workspace_.scene(), change.clip) : std::vector<int>{change.clip}) {
        const SceneClip& clip = workspace_.scene().clips[static_cast<std::size_t>(index)];
        if (!clip.source) continue;
        ImportOptions options = clip.options;
        set_option(options, option, change.text);
        if (options != clip.options) out.emplace_back(index, std::move(options));
    }
    return out;
}

void Imports::set(int clip, bool whole_file, const std::string& option, const std::string& text) {
    if (!import_option(option)) throw std::invalid_argument("there is no import option " + in_quotes(option));
    const ImportChange change{clip, whole_file, option, text, workspace_.history.has_open_group()};
    edited.refused.erase(option);
    try {
        options_wanted(change);
    } catch (const std::invalid_argument& error) {
        if (dialogs_.now != Dialog::import_clip) throw;
        return refuse(change, error.what());
    }
    // Of one that is dragged only the last value counts.
    std::erase_if(workspace_.import_changes, [&](const ImportChange& other) {
        return other.option == option && other.clip == clip && other.whole_file == whole_file;
    });
    workspace_.import_changes.push_back(change);
    next();
}

void Imports::set_motion(int clip, bool whole_file, mobb::Motion motion) {
    const std::string to(name(motion));
    const SceneClip& was = workspace_.scene().clips.at(static_cast<std::size_t>(clip));
    if (was.source) return set(clip, whole_file, "motion", to);
    if (was.clip->motion() == motion) return;
    edits_.edit({.name = {"changing the motion of " + was.name + ": " + to, ""},
                 .change = [made = with_motion(workspace_.scene(), clip, motion)](Scene& next) {
                     replace_clips(next, {made});
                 }});
}

void Imports::next() {
    if (jobs_.any(JobPurpose::imports) || workspace_.import_changes.empty()) return;
    const ImportChange change = workspace_.import_changes.front();
    workspace_.import_changes.pop_front();
    start(change);
}

void Imports::start(const ImportChange& change) {
    const auto wanted = options_wanted(change);
    if (wanted.empty()) return next();
    const SceneClip& clip = workspace_.scene().clips[static_cast<std::size_t>(change.clip)];
    const std::string label = mobbscope::lower(import_option(change.option)->label);
    const EditName name{
        "changing the " + label + " of " + (wanted.size() > 1 ? counted(wanted.size(), "clip", "clips") : clip.name) +
            ": " + (change.text.empty() ? "as the file says" : change.text),
        "import." + change.option + " " + std::to_string(change.clip) + (change.whole_file ? " file" : "")};
    const auto work = [this, change, wanted, name, path = source_path(workspace_.scene(), clip),
                       known = workspace_.import_file, in = workspace_.document().fitted](JobControl&) -> Job::Finish {
        const auto refusal = [&](const std::string& why) -> Job::Finish {
            return [this, change, why] { refuse(change, why); };
        };
        try {
            const std::shared_ptr<const SourceFile> file = source_file(path, known);
            const auto made = std::make_shared<const std::vector<ReimportedClip>>(reimport(in->scene(), *file, wanted));
            return [this, file, made, name, change, wanted] {
                workspace_.import_file = file;
                // Other options may have been changed or undone meanwhile.
                if (options_wanted(change) != wanted) return start(change);
                edits_.edit({.name = name,
                             .change = [made](Scene& scene) { replace_clips(scene, *made); },
                             .purpose = JobPurpose::imports,
                             .then =
                                 [this, change] {
                                     // The camera stays, so what is ten times as large may be out of the picture.
                                     if (change.option != "unit") return;
                                     notifications_.tell(MessageLevel::info, "The clip has another size now",
                                                         {{"view.frame_all", "", "Frame everything"}});
                                 },
                             .goes_on = change.goes_on});
            };
        } catch (const InputError& error) {
            return refusal(without_file(error.what(), path));
        } catch (const std::invalid_argument& error) {
            return refusal(error.what());
        }
    };
    jobs_.start("Importing " + source_path(workspace_.scene(), clip).filename().string(), work, JobPurpose::imports);
}

void Imports::refuse(const ImportChange& change, const std::string& why) {
    if (dialogs_.now == Dialog::import_clip) {
        edited.refused[change.option] = {change.text, why};
        return;
    }
    notifications_.tell(
        MessageLevel::error,
        source_path(workspace_.scene(), workspace_.scene().clips.at(static_cast<std::size_t>(change.clip))).string() +
            ": " + why);
}

void Imports::ask_for_offer() {
    if (dialogs_.now != Dialog::import_clip || edited.clip >= static_cast<int>(workspace_.scene().clips.size())) return;
    const SceneClip& clip = workspace_.scene().clips[static_cast<std::size_t>(edited.clip)];
    const ImportOptions asked = offer_depends_on(clip.options);
    if (!clip.source || (edited.asked && edited.offered_for == asked)) return;
    edited.asked = true;
    edited.offered_for = asked;
    const auto work = [this, asked, index = edited.clip, path = source_path(workspace_.scene(), clip),
                       known = workspace_.import_file](JobControl&) -> Job::Finish {
        try {
            const std::shared_ptr<const SourceFile> file = source_file(path, known);
            const auto offer = std::make_shared<const ImportOffer>(file->parsed.offer(asked));
            return [this, file, offer, asked, index] {
                workspace_.import_file = file;
                if (edited.clip != index || edited.offered_for != asked) return;
                edited.offer = offer;
                edited.unreadable.clear();
            };
        } catch (const std::exception& error) {
            return [this, index, why = std::string(error.what())] {
                if (edited.clip == index) edited.unreadable = why;
            };
        }
    };
    jobs_.start("Reading " + source_path(workspace_.scene(), clip).filename().string(), work);
}

void Imports::tell_of_warnings(std::size_t from) {
    struct Told {
        const SceneClip* of;  ///< the first clip that it is about
        const ImportWarning* warning;
        std::size_t clips = 1;
    };
    std::map<std::string_view, Told> by_option;
    for (std::size_t i = from; i < workspace_.scene().clips.size(); ++i) {
        const SceneClip& clip = workspace_.scene().clips[i];
        std::set<std::string_view> options;
        for (const ImportWarning& warning : clip.facts.warnings) {
            if (warning.option.empty() || !options.insert(warning.option).second) continue;
            const auto [at, is_new] = by_option.try_emplace(warning.option, Told{&clip, &warning});
            if (!is_new) ++at->second.clips;
        }
    }
    const auto tell = [&](const Told& told) {
        const std::string others =
            told.clips > 1 ? " (" + counted(told.clips - 1, "more clip", "more clips") + ")" : "";
        std::vector<MessageOffer> offers;
        if (told.of->source) {
            offers.push_back({"clip.import", told.of->name + ' ' + told.warning->option, "Import options..."});
        } else if (told.warning->option != kDigest) {
            offers.push_back(
                {"clip.motion", std::string(name(mobb::Motion::linear)) + ' ' + told.of->name, "Make it linear"});
        }
        notifications_.tell(MessageLevel::warning, told.of->name + ": " + said(*told.warning) + others,
                            std::move(offers));
    };
    // The latest stands out most: a wrong unit makes all else look wrong.
    for (const auto& [option, told] : by_option) {
        if (option != "unit") tell(told);
    }
    if (const auto unit = by_option.find("unit"); unit != by_option.end()) tell(unit->second);
}

}  // namespace mobbscope::app
