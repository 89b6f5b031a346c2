/// A picture test: a shot, and what its picture must look like (cases/case_file.h).
#pragma once

#include <cases/case_file.h>
#include <picture_tests/shot.h>

#include <filesystem>
#include <optional>
#include <string>

namespace mobbscope::picture_tests {

struct Case {
    Shot shot;  ///< of a case that is skipped nothing is read
    CaseTerms terms;
};

/// `text`: what the file is to hold; none: what it does. Throws InputError.
Case read_case(const std::filesystem::path& file, const std::optional<std::string>& text = {});

}  // namespace mobbscope::picture_tests
