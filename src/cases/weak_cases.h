/// Cases that see little of what changes, and case files that a report brings.
#pragma once

#include <cases/case_file.h>
#include <cases/case_result.h>

#include <string>
#include <vector>

namespace mobbscope::picture_tests {

/// The ways in which a case sees nothing, or hardly anything, of what changes, a phrase each: "\"allowed\" lets 100 %
/// of its pixels differ". It is skipped, over a tenth of its pixels or a quarter of a channel may differ, or its mask
/// leaves under a hundredth of them. What is unreadable is left out: it is told where the case is drawn.
std::vector<std::string> weaknesses(const CaseFile& file, const CaseTerms& terms);

/// Whether taking what is fresh would write the file of the case itself, as it does where a test asked for another.
bool brings_case(const CaseResult& result);

/// What a result that brings its case changes in the tests, a line each, first that it is the case itself and which of
/// its keys differ, then how it is weaker than the one that is there. Throws InputError if what it brings is no case.
std::vector<std::string> words_on_brought_case(const CaseResult& result);

}  // namespace mobbscope::picture_tests
