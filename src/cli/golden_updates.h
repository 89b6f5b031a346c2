/// How `mobbscope test` takes goldens: what is drawn now, or what a report holds.
#pragma once

#include <cases/case_file.h>
#include <cases/case_result.h>

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::cli {

/// A pattern as on the command line: the name itself, or with * and ?.
bool matches_any(const std::vector<std::string>& patterns, const std::string& name);

/// How a case is run where goldens are taken: of one that is `named`, whatever it is; with `all`, of one that is no
/// golden yet.
picture_tests::RunOptions run_options(const std::string& name, const std::vector<std::string>& named, bool all);

/// Takes the fresh goldens of those that `patterns` name, without patterns of all; says what it wrote. Throws
/// MachineError.
void take_named(std::span<picture_tests::CaseResult> results, const std::vector<std::string>& patterns,
                std::ostream& say);

/// Asks for each that is no golden yet, with pictures to look at in `folder`, and takes what the answer says. Throws
/// MachineError.
void take_asked(std::span<picture_tests::CaseResult> results, const std::filesystem::path& folder, std::ostream& say);

/// Makes the goldens of a report (case_report.h) those of its cases, byte by byte, all or none: of those that
/// `patterns` name, without patterns of all. Whether none that was meant is left out; those are said, as are those that
/// have these goldens already. Throws InputError if the report cannot be read, knows none of them, or was not held
/// against the goldens that are there now; MachineError if they cannot be written.
bool take_report(const std::filesystem::path& report, const std::filesystem::path& folder,
                 const std::vector<picture_tests::CaseFile>& cases, const std::vector<std::string>& patterns,
                 std::ostream& say);

}  // namespace mobbscope::cli
