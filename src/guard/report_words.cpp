#include <guard/reference.h>
#include <guard/report_words.h>
#include <import/shell_word.h>

#include <algorithm>

namespace mobbscope::guard {

std::string drawn_by(const RunFacts& facts) {
    if (facts.backend.empty()) return "nothing: there is no OpenGL";
    return facts.renderer.empty() ? facts.backend : facts.backend + ", " + facts.renderer;
}

std::string sum_of(const Summary& summary) {
    std::string out;
    const auto add = [&out](int count, const char* what) {
        if (count > 0) out += (out.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
    };
    add(summary.passed, "passed");
    add(summary.different, "different");
    add(summary.missing, "without a golden");
    add(summary.failed, "failed");
    add(summary.skipped, "skipped");
    return out.empty() ? "no cases" : out;
}

std::vector<std::string> not_compared(std::span<const CaseResult> results) {
    std::vector<std::string> out;
    for (const CaseResult& result : results) {
        if (result.other_here.empty()) continue;
        const std::string file = reference_file(result.file.file.parent_path()).string();
        const std::string sentence =
            "Pixels of text are not compared: drawn with " + result.other_here + " (" + file + ")";
        if (std::find(out.begin(), out.end(), sentence) == out.end()) out.push_back(sentence);
    }
    return out;
}

std::string update_command(const RunFacts& facts, std::span<const std::string_view> names) {
    std::string out = "mobbscope test " + shell_word(facts.folder) + " --update";
    for (const std::string_view name : names) out += ' ' + shell_word(std::string(name));
    return out;
}

}  // namespace mobbscope::guard
