#include <guard/markup.h>
#include <guard/report_words.h>
#include <guard/reports.h>
#include <import/text.h>

#include <cmath>

namespace mobbscope::guard {

namespace {

std::string attribute(std::string_view name, std::string_view value) {
    return ' ' + std::string(name) + "=\"" + escaped(value) + '"';
}

/// Seconds to the millisecond: readers expect no exponents.
std::string decimal(double seconds) { return brief(std::round(1000 * seconds) / 1000); }

/// The counts that a suite has, and the whole run.
std::string counts(const Summary& sum, std::size_t cases, double seconds) {
    return attribute("tests", std::to_string(cases)) +
           attribute("failures", std::to_string(sum.different + sum.missing)) +
           attribute("errors", std::to_string(sum.failed)) + attribute("skipped", std::to_string(sum.skipped)) +
           attribute("time", decimal(seconds));
}

void write_problem(std::ostream& out, const char* element, const RunFacts& facts, const CaseResult& result) {
    out << "      <" << element << attribute("type", name(result.outcome)) << attribute("message", result.message)
        << '>';
    out << escaped(result.message) << '\n';
    if (can_be_taken(result)) {
        const std::string_view names[] = {result.file.name};
        out << "If the picture is right: " << escaped(update_command(facts, names)) << '\n';
    }
    out << "</" << element << ">\n";
}

}  // namespace

void write_junit(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    double seconds = 0;
    for (const CaseResult& result : results) seconds += result.seconds;
    const std::string sum = counts(summary(results), results.size(), seconds);
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    out << "<testsuites" << sum << ">\n  <testsuite" << attribute("name", facts.folder) << sum << ">\n";
    out << "    <properties>\n      <property name=\"backend\"" << attribute("value", facts.backend)
        << "/>\n      <property name=\"renderer\"" << attribute("value", facts.renderer) << "/>\n";
    for (const std::string& sentence : not_compared(results)) {
        out << "      <property name=\"not compared\"" << attribute("value", sentence) << "/>\n";
    }
    out << "    </properties>\n";
    for (const CaseResult& result : results) {
        out << "    <testcase" << attribute("classname", facts.folder) << attribute("name", result.file.name)
            << attribute("file", result.file.file.string()) << attribute("time", decimal(result.seconds)) << ">\n";
        switch (result.outcome) {
            case Outcome::passed:
                break;
            case Outcome::different:
            case Outcome::missing_golden:
                write_problem(out, "failure", facts, result);
                break;
            case Outcome::failed:
                write_problem(out, "error", facts, result);
                break;
            case Outcome::skipped:
                out << "      <skipped" << attribute("message", result.message) << "/>\n";
                break;
        }
        out << "    </testcase>\n";
    }
    out << "  </testsuite>\n</testsuites>\n";
}

}  // namespace mobbscope::guard
