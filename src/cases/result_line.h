/// A result as JSON: how `mobbscope test --json-lines` tells programs what it finds as it finds it, a line each, how
/// the processes that draw tell it, and how a report keeps it (case_report.h).
///
///     {"name", "outcome", "message", "remarks": [...], "seconds", "tolerance", "backend", "renderer",
///      "diff": {...} | null,                             as `mobbscope diff --json`
///      "findings": [{"golden": ".state.json", "message", "words": [...]}],
///      "mask": FILE | null,                              relative to the case
///      "actual": PNG | null, "golden": PNG | null,       in base64; the golden of a case that did not pass
///      "fresh": [{"golden": ".png", "bytes": ... | null, "replaces": ... | null}]}   in base64; null: no such file
///
/// Goldens are told by what follows the case's name; "" of a finding: the scene expects another answer. `tolerance` is
/// null for a case that holds no picture, or lacks OpenGL for it; "not_drawn" says why it lacks it.
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <cases/case_file.h>
#include <cases/case_result.h>

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

/// Which pictures an object holds: where `fresh` has them, they need not be there twice.
enum class Pictures { all, not_in_fresh };
/// With `all` comes how long it took; a report is the same every time. `folder`: what a report says of the folder of
/// the goldens (case_report.h).
void write_result(JsonWriter& json, const CaseResult& result, Pictures pictures, std::string_view folder = {});
/// `cases`: those that it may be of. Throws InputError if it is no result.
CaseResult read_result(const JsonPlace& place, const std::vector<CaseFile>& cases);

/// On one line, with its end.
void write_result_line(std::ostream& out, const CaseResult& result);
CaseResult read_result_line(std::string_view line, const std::vector<CaseFile>& cases);

/// What a process that draws (drawing_child.h) is asked for, on a line too:
///
///     {"name", "fresh": "of failed" | "missing" | "of all",
///      "case": TEXT}                              of a case that is not, or not so, in its file; may be left out
struct CaseRequest {
    std::string name;  ///< of the case; UTF-8
    RunOptions options{};
};
std::string request_line(const CaseRequest& request);
/// Throws InputError if it is none.
CaseRequest read_request_line(std::string_view line);

}  // namespace mobbscope::picture_tests
