/// What a run of cases found: for people, scripts, CI servers and browsers.
#pragma once

#include <picture_tests/run_cases.h>

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::picture_tests {

/// Of a whole run.
struct RunFacts {
    std::string folder;                  ///< of the cases, as given
    std::string backend;                 ///< "osmesa", "egl"; empty without OpenGL
    std::string renderer;                ///< what OpenGL calls itself
    std::string page{};                  ///< the page of the run, whose goldens can be taken; empty: there is none
    std::vector<std::string> orphans{};  ///< goldens that no case has
    std::vector<std::string> weak{};     ///< with `strict`: cases that see hardly anything, and why (weak_cases.h)
    bool strict = false;                 ///< whether orphans and weak cases make the run fail
    std::string shard{};  ///< "2/3": only every third case, from the second; empty: all that were asked for
    std::string ended{};  ///< "ended after 12 of 40 cases", of which alone the report tells; empty: all were run
};

/// Of each case that did not pass, and of each that did although something differs, a line with the most important fact
/// and further lines below it; what is to be known of the run, and the sum.
void write_text(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);
/// {"folder", "backend", "renderer", "shard": "2/3" of a shard, "ended" of a run that was, "summary": {...}, "orphans":
/// [...], "weak": [...] with --strict, "cases": [{"name", "outcome", "message", "remarks": [...], "seconds",
/// "tolerance", "diff": {...} or null}]}; `diff` as in `mobbscope diff
/// --json`; `tolerance` is null where draws_nothing, and `backend` is "none" if that is so of all.
void write_json(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);
/// JUnit's XML: a failed picture is a failure, one that could not be drawn an error; with `strict` orphans and weak
/// cases are a test case each.
void write_junit(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);
/// One page that needs nothing else: actual picture, golden, difference, and the two in turn.
void write_html(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);

/// "osmesa, llvmpipe", or that nothing was drawn; empty where there is no picture.
std::string drawn_by(const RunFacts& facts, std::span<const CaseResult> results);

/// "12 of those that passed differ from their goldens in some pixels, by up to 2 of 255"; empty if none does.
std::string differing_passes(std::span<const CaseResult> results);

/// Whether a run is as it should be.
bool is_ok(const RunFacts& facts, std::span<const CaseResult> results);

/// Before the command line that takes the goldens of a case.
std::string_view if_right(const CaseResult& result);

/// The command line that takes the pictures of these cases as their goldens, ready for a shell.
std::string update_command(const RunFacts& facts, std::span<const std::string_view> names);

/// What stands before and behind the names in the command line that takes pictures from the page of the run
/// (RunFacts::page), or, without a page, in update_command.
std::pair<std::string, std::string> command_around_names(const RunFacts& facts);

/// The command line that takes the pictures of these cases from the page; of all cases, without names.
std::string accept_command(const RunFacts& facts, std::span<const std::string_view> names);

}  // namespace mobbscope::picture_tests
