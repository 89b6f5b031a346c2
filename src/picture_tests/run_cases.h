/// Draws cases, answers their queries and holds them against their goldens.
#pragma once

#include <cases/case_file.h>
#include <cases/case_result.h>
#include <picture_tests/picture_maker.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

/// Runs one case. `maker` null: there is no OpenGL, for the reason given; a case with a picture is skipped, if all else
/// that it holds is as its goldens say. Never throws for what is wrong with a case.
CaseResult run_case(const CaseFile& file, PictureMaker* maker, std::string_view no_opengl,
                    const RunOptions& options = {});

/// What a person is to know of a case that did not pass, on lines of their own, first its outcome: what differs, where
/// `keep_pictures` puts its pictures, and how they are taken. Empty if it passed.
std::string words_on(const CaseResult& result, const std::filesystem::path& folder);

/// Throws InputError if keep_pictures would write or remove a file that was read.
void check_kept(const CaseResult& result, const std::filesystem::path& folder);

/// Writes the pictures of a case into a folder that is made if need be: NAME.actual.png, NAME.golden.png and
/// NAME.heat.png, those that there are, its other fresh goldens as NAME.actual.state.json, ..., and NAME.txt with
/// words_on it; none of a case that passed. What an earlier run left of the others goes. Returns what it wrote but for
/// the words, pictures first. Throws as check_kept does, and MachineError.
std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder);

}  // namespace mobbscope::picture_tests
