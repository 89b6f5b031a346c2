/// What came of a case: its outcome, its pictures, and the goldens that it would have.
#pragma once

#include <cases/case_file.h>
#include <cases/golden_change.h>
#include <render/image/image.h>
#include <render/image/image_diff.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

enum class CaseOutcome {
    passed,
    different,       ///< what is held is not the golden's, or an answer not the expected one
    missing_golden,  ///< there is nothing to hold it against
    failed,          ///< the case cannot be read or drawn
    skipped,         ///< by the case, or its picture alone, as there is no OpenGL or no process that draws
};

/// What reports and the window call an outcome.
struct OutcomeWords {
    std::string_view name;
    std::string_view key;          ///< of the summary in JSON, and what the page calls it
    std::string_view in_sum;       ///< "3 without a golden"
    std::string_view mark, badge;  ///< on the page: a sign that needs no colour, and words
};
inline constexpr std::array<OutcomeWords, 5> kOutcomeWords{
    {{"passed", "passed", "passed", "✓", "passed"},
     {"different", "different", "different", "≠", "different"},
     {"missing golden", "missing", "without a golden", "∅", "no golden"},
     {"failed", "failed", "failed", "✕", "failed"},
     {"skipped", "skipped", "skipped", "–", "skipped"}}};
static_assert(kOutcomeWords.size() == static_cast<std::size_t>(CaseOutcome::skipped) + 1);
inline const OutcomeWords& words_of(CaseOutcome outcome) { return kOutcomeWords[static_cast<std::size_t>(outcome)]; }
inline std::string_view name(CaseOutcome outcome) { return words_of(outcome).name; }

/// What is wrong with one golden, or with what the case's scene expects.
struct Finding {
    std::filesystem::path golden;    ///< empty: none is, but an answer is not the one that the scene expects
    std::string message;             ///< one line
    std::vector<std::string> words;  ///< of numbers what differs, one line each; else empty
};

/// In the place of a backend: the case holds no picture.
inline constexpr std::string_view kDrawsNothing = "none";

/// What drew the pictures.
struct DrawnBy {
    std::string backend;   ///< "osmesa", "egl", kDrawsNothing; empty without OpenGL
    std::string renderer;  ///< what OpenGL calls itself
};

/// Pictures are packed, as the bytes of PNG files: a run may have hundreds.
struct CaseResult {
    CaseFile file;
    CaseOutcome outcome = CaseOutcome::passed;
    std::string message;               ///< one line: why it did not pass; empty for one that did
    std::vector<std::string> remarks;  ///< one line each: what else is to be known, also of one that passed
    std::vector<Finding> findings;     ///< of a case that is different or lacks a golden
    double seconds = 0;                ///< drawing and comparing
    Tolerance tolerance = Tolerance::tight;
    std::optional<std::filesystem::path> mask;
    std::string actual;              ///< empty where there is none
    std::string golden;              ///< likewise, and of a case that passed
    std::optional<ImageDiff> image;  ///< where both exist, without its heat map
    /// All goldens of the case as they would be now: of one that is different or lacks a golden; of others if that was
    /// asked for.
    std::vector<GoldenChange> fresh;
    DrawnBy drawn_by;
    std::string not_drawn;                    ///< why its picture was not drawn: no OpenGL, no process; else empty
    std::vector<std::filesystem::path> read;  ///< by the process that drew it and not told before; from the root
};

/// Whether there is no OpenGL for its picture.
inline bool lacks_opengl(const CaseResult& result) { return !result.not_drawn.empty(); }
/// Whether the case was run, and holds no picture or lacks OpenGL for it.
bool draws_nothing(const CaseResult& result);

/// The pictures of a result, compared anew with its mask, for the heat map. Throws InputError if the mask cannot be
/// read.
ImageDiff compared_again(const CaseResult& result, const Image& actual, const Image& golden);
/// Of a result that has both pictures; nothing if they cannot be compared again.
std::optional<Image> heat_map(const CaseResult& result);

/// Whether what there is now is not the golden's, and may become it.
bool can_be_taken(const CaseResult& result);
/// What goldens cannot mend: the answers that are not those that the scene expects.
std::vector<Finding> unmended(const CaseResult& result);
/// Whether the case would still be different if all its goldens were taken.
inline bool stays_different(const CaseResult& result) { return !unmended(result).empty(); }

/// Of which cases all goldens are made as they would be now (CaseResult::fresh), besides those that did not pass.
enum class FreshGoldens {
    of_failed,  ///< of no others
    missing,    ///< of those that passed the goldens that are not there yet
    of_all,
};
inline constexpr std::array<std::string_view, 3> kFreshGoldens{"of failed", "missing", "of all"};

struct RunOptions {
    FreshGoldens fresh = FreshGoldens::of_failed;
    std::optional<std::string> asked{};  ///< the text of the case, which its file is to have; none: what that has
};

/// How many cases had each outcome.
struct Summary {
    std::array<int, kOutcomeWords.size()> counts{};  ///< in the order of the outcomes

    int& operator[](CaseOutcome outcome) { return counts[static_cast<std::size_t>(outcome)]; }
    int operator[](CaseOutcome outcome) const { return counts[static_cast<std::size_t>(outcome)]; }
    /// Those with a picture that is not the golden's, or nothing to hold it against.
    int not_golden() const { return (*this)[CaseOutcome::different] + (*this)[CaseOutcome::missing_golden]; }
    int bad() const { return not_golden() + (*this)[CaseOutcome::failed]; }
    bool ok() const { return bad() == 0; }
};
Summary summary(std::span<const CaseResult> results);

/// "1 passed, 2 different, 3 without a golden, 4 failed, 5 skipped"; what there is none of is left out.
std::string sum_of(const Summary& summary);

/// "a.png: ...; a.state.json: ..."
std::string message_of(std::span<const Finding> findings);

/// All that is wrong, the most important fact first, one line each; of one that was skipped why.
std::vector<std::string> lines_of(const CaseResult& result);

/// Makes the goldens of a case what is drawn now (write_goldens). Then the case has passed, or is skipped if its
/// picture was not drawn, unless its scene expects other answers. Returns what it wrote, not what it removed. Throws as
/// write_goldens does.
std::vector<std::filesystem::path> take(CaseResult& result);

}  // namespace mobbscope::picture_tests
