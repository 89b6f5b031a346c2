/// Draws cases and holds them against their goldens.
#pragma once

#include <picture_tests/case_file.h>
#include <picture_tests/picture_maker.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

enum class CaseOutcome {
    passed,
    different,       ///< the picture, or what is drawn, is not the golden's
    missing_golden,  ///< there is a picture, but nothing to hold it against
    failed,          ///< no picture: the case cannot be read or drawn
    skipped,         ///< by the case, or as there is no OpenGL
};

/// What reports call an outcome.
struct OutcomeWords {
    std::string_view name;
    std::string_view key;          ///< of the summary in JSON
    std::string_view in_sum;       ///< "3 without a golden"
    std::string_view mark, badge;  ///< on the page: a sign that needs no colour, and words
    std::string_view kind;         ///< which colour on the page: good, bad or quiet
};
inline constexpr std::array<OutcomeWords, 5> kOutcomeWords{
    {{"passed", "passed", "passed", "✓", "passed", "good"},
     {"different", "different", "different", "≠", "different", "bad"},
     {"missing golden", "missing", "without a golden", "∅", "no golden", "bad"},
     {"failed", "failed", "failed", "✕", "failed", "bad"},
     {"skipped", "skipped", "skipped", "–", "skipped", "quiet"}}};
static_assert(kOutcomeWords.size() == static_cast<std::size_t>(CaseOutcome::skipped) + 1);
inline const OutcomeWords& words_of(CaseOutcome outcome) { return kOutcomeWords[static_cast<std::size_t>(outcome)]; }
inline std::string_view name(CaseOutcome outcome) { return words_of(outcome).name; }

/// A golden as it would be if what is drawn now is right.
struct FreshGolden {
    std::filesystem::path file;
    std::string bytes;
};

struct CaseResult {
    CaseFile file;
    CaseOutcome outcome = CaseOutcome::passed;
    std::string message;  ///< one line: why it did not pass; empty for one that did
    double seconds = 0;   ///< drawing and comparing
    Tolerance tolerance = Tolerance::tight;
    Image actual;                    ///< empty where there is none; without text if only that picture is different
    Image golden;                    ///< likewise, and of a case that passed
    std::optional<ImageDiff> image;  ///< where both exist; of a case that passed without its heat map
    std::vector<FreshGolden>
        fresh;  ///< of a case that is different or lacks a golden: the files to write if it is accepted
    /// What is other here than where the goldens are from, which is why pixels of text are not held against them; empty
    /// if they are.
    std::string other_here;
};

/// What the goldens of a run are held to be from.
enum class GoldenSource {
    reference,  ///< what the reference.json of their folder says, or here if there is none
    here,       ///< here, whatever it says: this becomes the reference
};

/// Runs one case. `maker` null: there is no OpenGL, for the reason given; the case is skipped without being read. Never
/// throws for what is wrong with a case.
CaseResult run_case(const CaseFile& file, PictureMaker* maker, std::string_view no_opengl,
                    GoldenSource source = GoldenSource::reference);

/// Whether there is a picture that is not the golden's, and goldens are taken here.
bool can_be_taken(const CaseResult& result);

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

/// Makes the folder that a file goes to, if need be. Throws MachineError.
void make_folder_of(const std::filesystem::path& file);

/// Writes the pictures of a case into a folder that is made if need be: NAME.actual.png, NAME.golden.png and
/// NAME.heat.png, those that there are, none of a case that passed; what an earlier run left of the others goes.
/// Returns what it wrote. Throws MachineError.
std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder);

/// Makes the goldens of a case what is drawn now, each file whole; then the case has passed. Returns what it wrote.
/// Throws MachineError.
std::vector<std::filesystem::path> take(CaseResult& result);

}  // namespace mobbscope::picture_tests
