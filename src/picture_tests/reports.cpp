#include <base/text.h>
#include <cases/case_result.h>
#include <picture_tests/reference.h>
#include <picture_tests/reports.h>
#include <render/image/image_diff.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

std::string drawn_by(const RunFacts& facts) {
    if (facts.backend.empty()) return "nothing: there is no OpenGL";
    return facts.renderer.empty() ? facts.backend : facts.backend + ", " + facts.renderer;
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

void write_text(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    std::vector<std::string_view> updatable;
    for (const CaseResult& result : results) {
        if (can_be_taken(result)) updatable.push_back(result.file.name);
        if (result.outcome == CaseOutcome::passed) continue;
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

void write_json(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    JsonWriter json(out);
    json.begin_object();
    json.member("folder", facts.folder);
    json.member("backend", facts.backend);
    json.member("renderer", facts.renderer);
    const Summary sum = summary(results);
    json.begin_object("summary", JsonWriter::Layout::row);
    for (std::size_t i = 0; i < sum.counts.size(); ++i) json.member(kOutcomeWords[i].key, sum.counts[i]);
    json.end_object();
    if (const std::vector<std::string> sentences = not_compared(results); !sentences.empty()) {
        json.list("not_compared", sentences, [&](const std::string& sentence) { json.value(sentence); });
    }
    json.list("cases", results, [&](const CaseResult& result) {
        json.begin_object();
        json.member("name", result.file.name);
        json.member("outcome", name(result.outcome));
        json.member("message", result.message);
        json.member("seconds", result.seconds);
        json.member("tolerance", name(result.tolerance));
        json.key("diff");
        if (result.image) {
            write_diff(json, *result.image);
        } else {
            json.null();
        }
        json.end_object();
    });
    json.end_object();
}

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
        if (result.outcome == CaseOutcome::skipped) {
            out << "      <skipped" << attribute("message", result.message) << "/>\n";
        } else if (result.outcome != CaseOutcome::passed) {
            write_problem(out, result.outcome == CaseOutcome::failed ? "error" : "failure", facts, result);
        }
        out << "    </testcase>\n";
    }
    out << "  </testsuite>\n</testsuites>\n";
}

std::string escaped(std::string_view text) {
    constexpr std::string_view kSpecial = "&<>\"'";
    constexpr std::array kEntities{"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    const std::string clean = cleaned(text);
    std::string out;
    for (std::size_t i = 0; i < clean.size(); ++i) {
        // U+FFFE and U+FFFF are no characters of XML.
        const std::string_view three = std::string_view(clean).substr(i, 3);
        if (three == "\xef\xbf\xbe" || three == "\xef\xbf\xbf") {
            out += '?';
            i += 2;
            continue;
        }
        const std::size_t special = kSpecial.find(clean[i]);
        special == kSpecial.npos ? out += clean[i] : out += kEntities[special];
    }
    return out;
}

}  // namespace mobbscope::picture_tests
