#include <guard/report_words.h>
#include <guard/reports.h>
#include <import/text.h>

namespace mobbscope::guard {

void write_text(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    std::vector<std::string_view> updatable;
    for (const CaseResult& result : results) {
        if (can_be_taken(result)) updatable.push_back(result.file.name);
        if (result.outcome == Outcome::passed) continue;
        out << name(result.outcome) << ": " << cleaned(result.file.name) << ": " << cleaned(result.message) << '\n';
    }
    out << cleaned(facts.folder) << ": " << sum_of(summary(results)) << "; drawn by " << cleaned(drawn_by(facts))
        << '\n';
    for (const std::string& sentence : not_compared(results)) out << cleaned(sentence) << '\n';
    if (!updatable.empty()) {
        out << "Look at the pictures. Those that are right become goldens with\n  "
            << cleaned(update_command(facts, updatable)) << '\n';
    }
}

}  // namespace mobbscope::guard
