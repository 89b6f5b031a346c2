/// What a run of cases found: for people, scripts, CI servers and browsers.
#pragma once

#include <guard/run_cases.h>

#include <ostream>
#include <span>
#include <string>

namespace mobbscope::guard {

/// Of a whole run.
struct RunFacts {
    std::string folder;    ///< of the cases, as given
    std::string backend;   ///< "osmesa", "egl"; empty without OpenGL
    std::string renderer;  ///< what OpenGL calls itself
};

/// A line for each case that did not pass, and the sum.
void write_text(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);
/// {"folder", "backend", "renderer", "summary": {...}, "cases": [{"name", "outcome", "message", "seconds", "tolerance",
/// "diff": {...} or null}]}; `diff` as in `mobbscope diff --json`. Where goldens are from elsewhere (reference.h),
/// "not_compared": why pixels of text are not, a sentence for each folder.
void write_json(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);
/// JUnit's XML: a failed picture is a failure, one that could not be drawn an error.
void write_junit(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);
/// One page that needs nothing else: actual picture, golden, difference, and the two in turn.
void write_html(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);

}  // namespace mobbscope::guard
