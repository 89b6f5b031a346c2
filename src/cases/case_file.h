/// A case as files: `NAME.case.json` says what to draw (picture_tests/shot.h), and besides
///
///      "mobbscope_case": 1,
///      "hold": ["picture", "answers", "trace", "fit"],   what is held; default: the picture alone
///      "tolerance": "tight",          or "loose"
///      "threshold": 3,                over the tolerance's, as `mobbscope diff --threshold`
///      "allowed": "12px",             over the tolerance's, as `mobbscope diff --allowed`
///      "mask": "NAME.mask.png",       only what is neither black nor transparent in it is compared
///      "state": false,                pixels alone are held
///      "time_limit": 300,             seconds that it may take, 0.1..86400, instead of 60
///      "skip": "why"                  the case is reported as skipped
///
/// Beside it stand its goldens: `NAME.png` and what that shows, `NAME.state.json` (picture_tests/picture_state.h).
/// Answers, traces and fits (picture_tests/held_answers.h) have `NAME.answers.json`, `NAME.trace.json` and
/// `NAME.fit.json`. A case that holds no picture draws nothing, and has no key that only concerns pictures.
#pragma once

#include <base/json.h>
#include <render/image/diff_options.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

/// What a case's file has behind its name.
inline constexpr std::string_view kCaseExtension = ".case.json";

/// How far a picture may be from its golden, unless its case says more.
enum class Tolerance {
    tight,  ///< one rasteriser on any processor: the defaults of DiffOptions
    loose,  ///< across rasterisers: edges may lie a pixel aside, 8/255 a channel, 0.5 % of the pixels beyond
};
inline constexpr std::array<std::string_view, 2> kTolerances{"tight", "loose"};
inline std::string_view name(Tolerance tolerance) { return kTolerances[static_cast<std::size_t>(tolerance)]; }
DiffOptions diff_options(Tolerance tolerance);

/// What a case may hold against a golden.
enum class Held {
    picture,
    answers,  ///< of its queries: contact and numbers of tests
    trace,    ///< every test of its queries
    fit,      ///< the nodes of its trees
};
inline constexpr std::array<std::string_view, 4> kHeld{"picture", "answers", "trace", "fit"};
inline std::string_view name(Held held) { return kHeld[static_cast<std::size_t>(held)]; }

/// What is known of a case before its scene is read.
struct CaseFile {
    std::string name;  ///< of the file relative to the folder of the cases, without ".case.json"
    std::filesystem::path file;
    /// The folder that the name is relative to.
    std::filesystem::path folder() const;
    std::filesystem::path golden() const { return beside(".png"); }
    std::filesystem::path state() const { return beside(".state.json"); }
    /// The first golden of what is held.
    std::filesystem::path golden_of(Held held) const;
    using Golden = std::filesystem::path (CaseFile::*)() const;
    /// NAME and this ending.
    std::filesystem::path beside(std::string_view ending) const;
    /// The ending of a file that stands beside it.
    std::string ending_of(const std::filesystem::path& other) const;
    /// All files that goldens of what is held may have.
    std::vector<std::filesystem::path> goldens(std::span<const Held> held) const;
};

/// The case of a name in a folder, whether it is there or not.
CaseFile case_named(const std::filesystem::path& folder, const std::string& name);

/// Whether accepting may write NAME and this ending for the case NAME: a golden, or the case that a test asks for.
bool is_golden_ending(std::string_view ending);

/// All cases in a folder and the folders in it, by name. Throws InputError if there is no such folder, or no case in
/// it.
std::vector<CaseFile> find_cases(const std::filesystem::path& folder);
/// Those that there are: none where there is no such folder.
std::vector<CaseFile> cases_there(const std::filesystem::path& folder);

/// Whether a test may give a case this name: it stays in its folder, a line can tell of it, and --update and
/// MOBBSCOPE_UPDATE take it for nothing else.
bool is_case_name(std::string_view name);

/// What a run leaves in the folder of its pictures (case_report.h).
inline constexpr std::string_view kReportFile = "report.json";

/// Where no case holds them: the goldens in a folder and the folders in it. A folder with a report.json is
/// what a run left (case_report.h), and left out; so is a NAME.state.json, NAME.answers.json, NAME.trace.json or
/// NAME.fit.json that does not begin as such a golden does. Of what cannot be searched there are none.
std::vector<std::filesystem::path> orphaned_goldens(const std::filesystem::path& folder,
                                                    const std::vector<CaseFile>& cases);

/// What a case says about how it is tested.
struct CaseTerms {
    Tolerance tolerance = Tolerance::tight;
    DiffOptions diff;                           ///< the tolerance's, and what the case says over them
    std::optional<std::filesystem::path> mask;  ///< of the golden's size
    bool state = true;                          ///< whether it is held beside the pixels
    std::vector<Held> hold{Held::picture};      ///< at least one, each once
    double time_limit = 60;                     ///< seconds that drawing and comparing may take
    std::optional<std::string> skip;            ///< why
    std::filesystem::path scene;                ///< empty: it stands in the case

    bool holds(Held held) const;
};

/// Of the text of a case; `folder`: what file names are relative to. Throws InputError if it is no case, or one of
/// another version.
CaseTerms read_terms(const JsonPlace& root, const std::filesystem::path& folder);
/// Of a case's file. `text`: what the file is to hold; none: what it does.
CaseTerms read_terms(const CaseFile& file, const std::optional<std::string>& text = {});

}  // namespace mobbscope::picture_tests
