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

/// The largest loss of structural similarity (ssim.h) of two pictures a quarter as wide and high: there edges of
/// another rasteriser lose little. `mask`: of the whole pictures, null: none; what it leaves out counts as equal, so
/// that what it leaves in is held however small it is.
double similarity_loss(const Image& actual, const Image& golden, const Image* mask);

/// The most that a picture may lose elsewhere and still be its golden's: without a draw list, and with one, which holds
/// what is small (measured by bench/guard: docs/ci.md).
inline constexpr double kMostLoss = 0.01;
inline constexpr double kMostLossWithDrawList = 0.25;

/// What a person is to know of a case that did not pass, on lines of their own, first its outcome: what differs, where
/// `keep_pictures` puts its pictures, and how they are taken. Empty if it passed.
std::string words_on(const CaseResult& result, const std::filesystem::path& folder);

/// Writes the pictures of a case into a folder that is made if need be: NAME.actual.png, NAME.golden.png and
/// NAME.heat.png (of the golden without text NAME.actual.plain.png, ...), those that there are, its other fresh
/// goldens as NAME.actual.draw.json, ..., and NAME.txt with words_on it; none of a case that passed. What an earlier
/// run left of the others goes. Returns what it wrote but for the words, pictures first. Throws MachineError.
std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder);

}  // namespace mobbscope::picture_tests
