/// What a run keeps of the cases that did not pass, with their goldens as they would be now: enough to look at them,
/// and to take them, on any system and without drawing anything.
///
///     {"mobbscope_report": 1,
///      "cases": [{...}, ...]}                             each as in result_line.h, and
///      "folder": "../goldens"                             of its goldens, relative to the report
///
/// It is `report.json` in the folder of `mobbscope test --output`, and in the page of `--html`.
#pragma once

#include <cases/case_file.h>
#include <cases/case_result.h>
#include <cases/golden_change.h>
#include <cases/result_line.h>

#include <filesystem>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

/// What stands before a report in a page, and behind it.
inline constexpr std::string_view kReportBegins = "<script type=\"application/json\" id=\"mobbscope-report\">";
inline constexpr std::string_view kReportEnds = "</script>";

/// Without the cases that passed or were skipped. No '<' is in it, so that a page can hold it. `where`: the folder that
/// the report goes to.
void write_case_report(std::ostream& out, std::span<const CaseResult> results, const std::filesystem::path& where);

struct CaseReport {
    std::filesystem::path file;  ///< that was read
    std::vector<CaseResult> results;
    std::vector<std::string> unknown;  ///< cases that are none of those given, and whose files it does not bring
};

/// `report`: the folder, its report.json, or the page. `cases`: those that there are in `folder`; one that a test asked
/// for may be new, and come with its file. What the report tells of other folders is left out. A report that was
/// copied to another machine is of a folder with the same own name. Throws InputError if there is no report, or it
/// tells only of other folders.
CaseReport read_case_report(const std::filesystem::path& report, const std::filesystem::path& folder,
                            const std::vector<CaseFile>& cases);

/// Whether results are of all cases of a folder: what a report tells of others there is gone.
enum class Cases { some, all };
/// Makes the report in the folder `output` tell of these results, whatever it told of their cases, and leaves what it
/// tells of others, also of cases in other folders; processes may do so at the same time. One that would tell of none
/// is removed. Returns a line for people if the old one could not be read, so that what it told is gone; else nothing.
/// Throws MachineError.
std::string add_to_case_report(const std::filesystem::path& output, const std::filesystem::path& folder,
                               std::span<const CaseResult> results, Cases cases);

/// Throws InputError if what a report would write is no picture, or no JSON: a damaged one must not become a golden.
void check_bytes(std::span<const GoldenChange> changes, const std::filesystem::path& report);

}  // namespace mobbscope::picture_tests
