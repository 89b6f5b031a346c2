#include <cli/take_goldens.h>

#include <base/text.h>
#include <picture_tests/run_cases.h>

#include <istream>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

enum class Answer { yes, no, all, quit };

Answer ask(const picture_tests::CaseResult& result, const std::filesystem::path& folder, std::istream& answers,
           std::ostream& say) {
    say << cleaned(result.file.name) << ": " << name(result.outcome) << ": " << cleaned(result.message) << '\n';
    for (const std::filesystem::path& picture : keep_pictures(result, folder)) {
        say << "  " << cleaned(picture.string()) << '\n';
    }
    say << "take it? [y/N/a/q] " << std::flush;
    std::string line;
    if (!std::getline(answers, line)) return Answer::quit;
    const std::string_view answer = trimmed(line);
    if (answer == "y") return Answer::yes;
    if (answer == "a") return Answer::all;
    return answer == "q" ? Answer::quit : Answer::no;
}

void take_one(picture_tests::CaseResult& result, std::ostream& say) {
    for (const std::filesystem::path& file : take(result)) say << "wrote " << cleaned(file.string()) << '\n';
}

}  // namespace

void take_named(std::span<picture_tests::CaseResult> results, const IsNamed& named, std::ostream& say) {
    for (picture_tests::CaseResult& result : results) {
        if (can_be_taken(result) && named(result)) take_one(result, say);
    }
}

void take_asked(std::span<picture_tests::CaseResult> results, const std::filesystem::path& folder,
                std::istream& answers, std::ostream& say) {
    bool all = false;
    for (picture_tests::CaseResult& result : results) {
        if (!can_be_taken(result)) continue;
        const Answer answer = all ? Answer::yes : ask(result, folder, answers, say);
        if (answer == Answer::quit) return;
        all = all || answer == Answer::all;
        if (answer != Answer::no) take_one(result, say);
    }
}

}  // namespace mobbscope::cli
