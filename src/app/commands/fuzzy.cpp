#include <app/commands/fuzzy.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr double kLetter = 1;
constexpr double kWordStart = 6;
constexpr double kRun = 7;
constexpr double kLeastPerLetter = 4;  // below, the letters are strewn about
constexpr double kPerLength = 0.02;    // shorter texts say more of what was meant
constexpr double kNone = -std::numeric_limits<double>::infinity();

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) >= 0x80; }

}  // namespace

std::optional<double> fuzzy_score(std::string_view word, std::string_view text) {
    if (word.empty()) return 0;
    // best[j]: of the letters so far with the last of them at text[j].
    std::vector<double> best(text.size(), kNone);
    for (std::size_t i = 0; i < word.size(); ++i) {
        std::vector<double> next(text.size(), kNone);
        double before = kNone;  // the best of those that end before j
        for (std::size_t j = 0; j < text.size(); ++j) {
            if (j > 0) before = std::max(before, best[j - 1]);
            if (lower(text[j]) != lower(word[i])) continue;
            const bool starts = in_word(text[j]) && (j == 0 || !in_word(text[j - 1]));
            const double here = kLetter + (starts ? kWordStart : 0);
            if (i == 0) {
                next[j] = here;
            } else {
                next[j] = std::max(before + here,
                                   j > 0 ? best[j - 1] + kLetter + std::max(starts ? kWordStart : 0, kRun) : kNone);
            }
        }
        best = std::move(next);
    }
    const double score = text.empty() ? kNone : *std::max_element(best.begin(), best.end());
    if (score < kLeastPerLetter * static_cast<double>(word.size())) return std::nullopt;
    return score - kPerLength * static_cast<double>(text.size());
}

std::optional<double> word_score(std::string_view word, std::string_view text) {
    for (std::size_t at = 0; at + word.size() <= text.size(); ++at) {
        if (at > 0 && in_word(text[at - 1])) continue;
        const std::string_view here = text.substr(at, word.size());
        if (std::equal(word.begin(), word.end(), here.begin(), [](char a, char b) { return lower(a) == lower(b); })) {
            return fuzzy_score(word, here);
        }
    }
    return std::nullopt;
}

}  // namespace mobbscope::app
