/// `test --update`: present pictures become goldens.
#pragma once

#include <picture_tests/run_cases.h>

#include <filesystem>
#include <functional>
#include <ostream>
#include <span>

namespace mobbscope::cli {

/// Whether the picture of a case is taken without asking.
using IsNamed = std::function<bool(const picture_tests::CaseResult& result)>;

/// Takes what is named and is no golden yet; says what it wrote. Throws MachineError.
void take_named(std::span<picture_tests::CaseResult> results, const IsNamed& named, std::ostream& say);

/// Asks for each that is no golden yet, with pictures to look at in `folder`, and takes what the answer says. Throws
/// MachineError.
void take_asked(std::span<picture_tests::CaseResult> results, const std::filesystem::path& folder,
                std::istream& answers, std::ostream& say);

}  // namespace mobbscope::cli
