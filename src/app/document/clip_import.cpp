// The part of the session that imports clips anew.
#include <app/document/session.h>
#include <base/error.h>
#include <base/text.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

namespace {

/// Why something failed, in one line; the file stands in the dialog's head already.
std::string without_file(const std::string& what, const std::filesystem::path& file) {
    const std::string head = file.string() + ": ";
    return what.starts_with(head) ? what.substr(head.size()) : what;
}

}  // namespace

void Session::open_import(int clip, const std::string& field) {
    const SceneClip& opened = scene().clips.at(static_cast<std::size_t>(clip));
    if (!opened.source) {
        throw std::invalid_argument(in_quotes(opened.name) +
                                    " has its samples in the scene: there is nothing to import");
    }
    open_dialog(Dialog::import_clip);
    // What they say stands at the fields now.
    std::erase_if(messages_,
                  [](const Message& message) { return message.offer && message.offer->command == "clip.import"; });
    importing = {.clip = clip, .field = field};
    // What is wrong with one track of a crowd is wrong with all.
    importing.whole_file = opened.options.id.has_value();
    ask_for_offer();
}

bool Session::imports() const {
    return std::ranges::any_of(jobs_, [](const Running& running) { return running.purpose == Purpose::imports; });
}

std::vector<std::pair<int, ImportOptions>> Session::options_wanted(const ImportChange& change) const {
    std::vector<std::pair<int, ImportOptions>> out;
    if (static_cast<std::size_t>(change.clip) >= scene().clips.size()) return out;
    const ImportOption& option = *import_option(change.option);
    const bool all = change.whole_file && option.of_file;
    for (const int index : all ? clips_of_same_source(scene(), change.clip) : std::vector<int>{change.clip}) {
        const SceneClip& clip = scene().clips[static_cast<std::size_t>(index)];
        if (!clip.source) continue;
        ImportOptions options = clip.options;
        set_option(options, option, change.text);
        if (options != clip.options) out.emplace_back(index, std::move(options));
    }
    return out;
}

void Session::set_import(int clip, bool whole_file, const std::string& option, const std::string& text) {
    if (!import_option(option)) throw std::invalid_argument("there is no import option " + in_quotes(option));
    const ImportChange change{clip, whole_file, option, text, history_.has_open_group()};
    importing.refused.erase(option);
    try {
        options_wanted(change);
    } catch (const std::invalid_argument& error) {
        if (dialog != Dialog::import_clip) throw;
        return refuse_import(change, error.what());
    }
    // Of one that is dragged only the last value counts.
    std::erase_if(import_changes_, [&](const ImportChange& other) {
        return other.option == option && other.clip == clip && other.whole_file == whole_file;
    });
    import_changes_.push_back(change);
    import_next();
}

void Session::set_motion(int clip, bool whole_file, mobb::Motion motion) {
    const std::string to(name(motion));
    const SceneClip& was = scene().clips.at(static_cast<std::size_t>(clip));
    if (was.source) return set_import(clip, whole_file, "motion", to);
    if (was.clip->motion() == motion) return;
    edit_with_fits(
        {.name = {"changing the motion of " + was.name + ": " + to, ""},
         .change = [made = with_motion(scene(), clip, motion)](Scene& next) { replace_clips(next, {made}); }});
}

void Session::import_next() {
    if (imports() || import_changes_.empty()) return;
    const ImportChange change = import_changes_.front();
    import_changes_.pop_front();
    start_import(change);
}

void Session::start_import(const ImportChange& change) {
    const auto wanted = options_wanted(change);
    if (wanted.empty()) return import_next();
    const SceneClip& clip = scene().clips[static_cast<std::size_t>(change.clip)];
    const std::string label = mobbscope::lower(import_option(change.option)->label);
    const EditName name{
        "changing the " + label + " of " + (wanted.size() > 1 ? counted(wanted.size(), "clip", "clips") : clip.name) +
            ": " + (change.text.empty() ? "as the file says" : change.text),
        "import." + change.option + " " + std::to_string(change.clip) + (change.whole_file ? " file" : "")};
    const auto work = [this, change, wanted, name, path = source_path(scene(), clip), known = import_file_,
                       in = document().fitted](JobControl&) -> Job::Finish {
        const auto refusal = [&](const std::string& why) -> Job::Finish {
            return [this, change, why] { refuse_import(change, why); };
        };
        try {
            const std::shared_ptr<const SourceFile> file = source_file(path, known);
            const auto made = std::make_shared<const std::vector<ReimportedClip>>(reimport(in->scene(), *file, wanted));
            return [this, file, made, name, change, wanted] {
                import_file_ = file;
                // Other options may have been changed or undone meanwhile.
                if (options_wanted(change) != wanted) return start_import(change);
                edit_with_fits({.name = name,
                                .change = [made](Scene& scene) { replace_clips(scene, *made); },
                                .purpose = Purpose::imports,
                                .then =
                                    [this, change] {
                                        // The camera stays, so what is ten times as large may be out of the picture.
                                        if (change.option != "unit") return;
                                        tell(MessageLevel::info, "The clip has another size now",
                                             MessageOffer{"view.frame_all", "", "Frame everything"});
                                    },
                                .goes_on = change.goes_on});
            };
        } catch (const InputError& error) {
            return refusal(without_file(error.what(), path));
        } catch (const std::invalid_argument& error) {
            return refusal(error.what());
        }
    };
    start("Importing " + source_path(scene(), clip).filename().string(), work, Purpose::imports);
}

void Session::refuse_import(const ImportChange& change, const std::string& why) {
    if (dialog == Dialog::import_clip) {
        importing.refused[change.option] = {change.text, why};
        return;
    }
    tell(MessageLevel::error,
         source_path(scene(), scene().clips.at(static_cast<std::size_t>(change.clip))).string() + ": " + why);
}

void Session::ask_for_offer() {
    if (dialog != Dialog::import_clip || importing.clip >= static_cast<int>(scene().clips.size())) return;
    const SceneClip& clip = scene().clips[static_cast<std::size_t>(importing.clip)];
    const ImportOptions asked = offer_depends_on(clip.options);
    if (!clip.source || (importing.asked && importing.offered_for == asked)) return;
    importing.asked = true;
    importing.offered_for = asked;
    const auto work = [this, asked, index = importing.clip, path = source_path(scene(), clip),
                       known = import_file_](JobControl&) -> Job::Finish {
        try {
            const std::shared_ptr<const SourceFile> file = source_file(path, known);
            const auto offer = std::make_shared<const ImportOffer>(file->parsed.offer(asked));
            return [this, file, offer, asked, index] {
                import_file_ = file;
                if (importing.clip != index || importing.offered_for != asked) return;
                importing.offer = offer;
                importing.unreadable.clear();
            };
        } catch (const std::exception& error) {
            return [this, index, why = std::string(error.what())] {
                if (importing.clip == index) importing.unreadable = why;
            };
        }
    };
    start("Reading " + source_path(scene(), clip).filename().string(), work);
}

void Session::tell_of_warnings(std::size_t from) {
    const SceneClip* of = nullptr;
    const ImportWarning* worst = nullptr;
    std::size_t clips = 0;
    for (std::size_t i = from; i < scene().clips.size(); ++i) {
        const SceneClip& clip = scene().clips[i];
        bool warned = false;
        for (const ImportWarning& warning : clip.facts.warnings) {
            if (warning.option.empty()) continue;
            warned = true;
            // A wrong unit makes all else look wrong.
            if (worst && (worst->option == "unit" || warning.option != "unit")) continue;
            of = &clip;
            worst = &warning;
        }
        clips += warned ? 1 : 0;
    }
    if (!worst) return;
    const std::string others = clips > 1 ? " (" + counted(clips - 1, "more clip", "more clips") + ")" : "";
    const MessageOffer offer =
        of->source
            ? MessageOffer{"clip.import", of->name + ' ' + worst->option, "Import options..."}
            : MessageOffer{"clip.motion", std::string(name(mobb::Motion::linear)) + ' ' + of->name, "Make it linear"};
    tell(MessageLevel::warning, of->name + ": " + said(*worst) + others, offer);
}

}  // namespace mobbscope::app
