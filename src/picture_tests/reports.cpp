#include <base/markup.h>
#include <base/text.h>
#include <cases/case_result.h>
#include <picture_tests/reports.h>
#include <render/image/image_diff.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

std::string attribute(std::string_view name, std::string_view value) {
    return ' ' + std::string(name) + "=\"" + escaped(value) + '"';
}

/// Seconds to the millisecond: readers expect no exponents.
std::string decimal(double seconds) { return brief(std::round(1000 * seconds) / 1000); }

/// The counts that a suite has, and the whole run.
std::string counts(const Summary& sum, std::size_t cases, double seconds) {
    return attribute("tests", std::to_string(cases)) + attribute("failures", std::to_string(sum.not_golden())) +
           attribute("errors", std::to_string(sum[CaseOutcome::failed])) +
           attribute("skipped", std::to_string(sum[CaseOutcome::skipped])) + attribute("time", decimal(seconds));
}

void write_problem(std::ostream& out, const char* element, const RunFacts& facts, const CaseResult& result) {
    const std::vector<std::string> lines = lines_of(result);
    out << "      <" << element << attribute("type", name(result.outcome)) << attribute("message", lines.front())
        << '>';
    for (const std::string& line : lines) out << escaped(line) << '\n';
    if (can_be_taken(result)) {
        const std::string_view names[] = {result.file.name};
        out << if_right(result) << ' ' << escaped(update_command(facts, names)) << '\n';
        if (!facts.page.empty()) out << "or, from the report: " << escaped(accept_command(facts, names)) << '\n';
    }
    out << "</" << element << ">\n";
}

constexpr std::string_view kOrphan = "orphaned golden";
constexpr std::string_view kOrphanAdvice = ": no case has it; bring its case back, or remove it if it is a golden";

void write_remarks(std::ostream& out, const CaseResult& result) {
    if (result.remarks.empty()) return;
    out << "      <system-out>";
    for (const std::string& remark : result.remarks) out << escaped(remark) << '\n';
    out << "</system-out>\n";
}

constexpr std::string_view kWeak = "weak case";

/// What --strict complains of: one kind of it, as a test case of its own.
struct StrictFailure {
    std::string_view kind;
    std::string name, message;
    const std::vector<std::string>* lines;
    std::string_view advice;
};

std::vector<StrictFailure> strict_failures(const RunFacts& facts) {
    std::vector<StrictFailure> out;
    if (!facts.strict) return out;
    if (!facts.orphans.empty()) {
        out.push_back({kOrphan, "orphaned goldens",
                       counted(facts.orphans.size(), "golden has", "goldens have") + " no case", &facts.orphans,
                       kOrphanAdvice});
    }
    if (!facts.weak.empty()) {
        out.push_back(
            {kWeak, "weak cases", counted(facts.weak.size(), "weakness", "weaknesses") + " of cases", &facts.weak, ""});
    }
    return out;
}

void write_failure(std::ostream& out, const RunFacts& facts, const StrictFailure& failure) {
    out << "    <testcase" << attribute("classname", facts.folder) << attribute("name", failure.name)
        << attribute("time", "0") << ">\n      <failure" << attribute("type", failure.kind)
        << attribute("message", failure.message) << '>';
    for (const std::string& line : *failure.lines) out << escaped(line) << failure.advice << '\n';
    out << "</failure>\n    </testcase>\n";
}

}  // namespace

std::string drawn_by(const RunFacts& facts, std::span<const CaseResult> results) {
    if (facts.backend.empty()) {
        if (std::ranges::any_of(results, lacks_opengl)) return "nothing: there is no OpenGL";
        return std::ranges::all_of(results, draws_nothing) ? "" : "nothing";
    }
    return facts.renderer.empty() ? facts.backend : facts.backend + ", " + facts.renderer;
}

std::string differing_passes(std::span<const CaseResult> results) {
    int differing = 0, largest = 0;
    for (const CaseResult& result : results) {
        if (result.outcome != CaseOutcome::passed || !result.image || result.image->same) continue;
        ++differing;
        largest = std::max(largest, result.image->largest);
    }
    if (differing == 0) return "";
    return std::to_string(differing) + " of those that passed " + (differing == 1 ? "differs" : "differ") +
           " from the golden in some pixels, by up to " + std::to_string(largest) + " of 255";
}

bool is_ok(const RunFacts& facts, std::span<const CaseResult> results) {
    return summary(results).ok() && strict_failures(facts).empty();
}

std::string_view if_right(const CaseResult& result) {
    return draws_nothing(result) ? "If what is there now is right:" : "If the picture is right:";
}

std::string update_command(const RunFacts& facts, std::span<const std::string_view> names) {
    std::string out = "mobbscope test " + shell_word(facts.folder) + " --update";
    // A name that begins with a dash would be taken as an option.
    for (const std::string_view name : names)
        out.append(name.starts_with('-') ? " --update=" : " ").append(shell_word(std::string(name)));
    return out;
}

std::pair<std::string, std::string> command_around_names(const RunFacts& facts) {
    const std::string test = "mobbscope test " + shell_word(facts.folder);
    return facts.page.empty() ? std::pair(test + " --update", std::string())
                              : std::pair(test, " --accept " + shell_word(facts.page));
}

std::string accept_command(const RunFacts& facts, std::span<const std::string_view> names) {
    auto [out, after] = command_around_names(facts);
    const bool dash = std::ranges::any_of(names, [](std::string_view name) { return name.starts_with('-'); });
    if (dash) out += std::exchange(after, "") + " --";
    for (const std::string_view name : names) out += ' ' + shell_word(std::string(name));
    return out + after;
}

void write_text(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    std::vector<std::string_view> updatable;
    bool pictures = false;
    for (const CaseResult& result : results) {
        if (can_be_taken(result)) {
            updatable.push_back(result.file.name);
            pictures = pictures || !draws_nothing(result);
        }
        if (result.outcome == CaseOutcome::passed && result.remarks.empty()) continue;
        std::vector<std::string> lines;
        if (result.outcome != CaseOutcome::passed) lines = lines_of(result);
        lines.insert(lines.end(), result.remarks.begin(), result.remarks.end());
        out << name(result.outcome) << ": " << cleaned(result.file.name) << ": " << cleaned(lines.front()) << '\n';
        for (std::size_t i = 1; i < lines.size(); ++i) out << "  " << cleaned(lines[i]) << '\n';
    }
    for (const std::string& orphan : facts.orphans) out << kOrphan << ": " << cleaned(orphan) << kOrphanAdvice << '\n';
    for (const std::string& weak : facts.weak) out << kWeak << ": " << cleaned(weak) << '\n';
    out << cleaned(facts.folder) << (facts.shard.empty() ? "" : ", shard " + facts.shard) << ": "
        << sum_of(summary(results));
    if (const std::string by = drawn_by(facts, results); !by.empty()) out << "; drawn by " << cleaned(by);
    if (!facts.ended.empty()) out << "; " << facts.ended;
    out << '\n';
    if (const std::string differing = differing_passes(results); !differing.empty()) out << differing << '\n';
    if (!updatable.empty()) {
        out << (pictures ? "Look at the pictures. Those that are right become goldens with\n  "
                         : "What is right becomes a golden with\n  ")
            << cleaned(update_command(facts, updatable)) << '\n';
    }
}

void write_json(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    JsonWriter json(out);
    json.begin_object();
    json.member("folder", facts.folder);
    json.member("backend", drawn_by(facts, results).empty() ? kDrawsNothing : facts.backend);
    json.member("renderer", facts.renderer);
    if (!facts.shard.empty()) json.member("shard", facts.shard);
    if (!facts.ended.empty()) json.member("ended", facts.ended);
    const Summary sum = summary(results);
    json.begin_object("summary", JsonWriter::Layout::row);
    for (std::size_t i = 0; i < sum.counts.size(); ++i) json.member(kOutcomeWords[i].key, sum.counts[i]);
    json.end_object();
    json.list("orphans", facts.orphans, [&](const std::string& orphan) { json.value(orphan); });
    if (facts.strict) json.values("weak", facts.weak);
    json.list("cases", results, [&](const CaseResult& result) {
        json.begin_object();
        json.member("name", result.file.name);
        json.member("outcome", name(result.outcome));
        json.member("message", result.message);
        json.values("remarks", result.remarks);
        json.member("seconds", result.seconds);
        const bool draws = !draws_nothing(result);
        json.member("tolerance", draws ? std::optional(std::string(name(result.tolerance))) : std::nullopt);
        json.key("diff");
        result.image ? write_diff(json, *result.image) : json.null();
        json.end_object();
    });
    json.end_object();
}

void write_junit(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    double seconds = 0;
    for (const CaseResult& result : results) seconds += result.seconds;
    Summary found = summary(results);
    const std::vector<StrictFailure> strict = strict_failures(facts);
    // Each is reported as a case of its own.
    found[CaseOutcome::different] += static_cast<int>(strict.size());
    const std::string sum = counts(found, results.size() + strict.size(), seconds);
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    out << "<testsuites" << sum << ">\n  <testsuite" << attribute("name", facts.folder) << sum << ">\n";
    out << "    <properties>\n      <property name=\"backend\"" << attribute("value", facts.backend)
        << "/>\n      <property name=\"renderer\"" << attribute("value", facts.renderer) << "/>\n";
    if (!facts.shard.empty()) out << "      <property name=\"shard\"" << attribute("value", facts.shard) << "/>\n";
    if (!facts.ended.empty()) out << "      <property name=\"ended\"" << attribute("value", facts.ended) << "/>\n";
    for (const std::string& orphan : facts.orphans) {
        out << "      <property name=\"" << kOrphan << '"' << attribute("value", orphan) << "/>\n";
    }
    out << "    </properties>\n";
    for (const CaseResult& result : results) {
        out << "    <testcase" << attribute("classname", facts.folder) << attribute("name", result.file.name)
            << attribute("file", result.file.file.string()) << attribute("time", decimal(result.seconds)) << ">\n";
        if (result.outcome == CaseOutcome::skipped) {
            out << "      <skipped" << attribute("message", result.message) << "/>\n";
        } else if (result.outcome != CaseOutcome::passed) {
            write_problem(out, result.outcome == CaseOutcome::failed ? "error" : "failure", facts, result);
        }
        write_remarks(out, result);
        out << "    </testcase>\n";
    }
    for (const StrictFailure& failure : strict) write_failure(out, facts, failure);
    out << "  </testsuite>\n</testsuites>\n";
}

}  // namespace mobbscope::picture_tests
