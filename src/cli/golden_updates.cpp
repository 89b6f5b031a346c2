#include <base/error.h>
#include <base/text.h>
#include <cases/case_report.h>
#include <cases/weak_cases.h>
#include <cli/golden_updates.h>
#include <cli/program.h>
#include <picture_tests/run_cases.h>

#include <fnmatch.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <iterator>
#include <optional>
#include <string_view>

namespace mobbscope::cli {

using picture_tests::CaseFile;
using picture_tests::CaseResult;
using picture_tests::GoldenChange;

namespace {

enum class Reply { yes, no, all, quit };

Reply ask(const CaseResult& result, const std::filesystem::path& folder, std::ostream& say) {
    say << cleaned(result.file.name) << ": " << name(result.outcome) << ":\n";
    for (const std::string& line : lines_of(result)) say << "    " << cleaned(line) << '\n';
    for (const std::filesystem::path& picture : keep_pictures(result, folder)) {
        say << "  " << cleaned(picture.string()) << '\n';
    }
    say << "take it? [y/N/a/q] " << std::flush;
    std::string line;
    if (!std::getline(std::cin, line)) return Reply::quit;
    const std::string_view answer = trimmed(line);
    if (answer == "y") return Reply::yes;
    if (answer == "a") return Reply::all;
    return answer == "q" ? Reply::quit : Reply::no;
}

void take_one(CaseResult& result, std::ostream& say) {
    std::vector<std::string> on_case;
    if (brings_case(result)) on_case = words_on_brought_case(result);
    for (const std::filesystem::path& file : take(result)) say << "wrote " << cleaned(file.string()) << '\n';
    for (const std::string& line : on_case) say << cleaned(line) << '\n';
}

/// Throws InputError for a pattern that names no case, or none of the report.
void check_patterns(const picture_tests::CaseReport& read, const std::vector<CaseFile>& cases,
                    const std::vector<std::string>& patterns) {
    std::vector<std::string> names = read.unknown;
    for (const CaseFile& file : cases) names.push_back(file.name);
    for (const CaseResult& one : read.results) names.push_back(one.file.name);
    for (const std::string& pattern : patterns) {
        const auto is_named = [&](const std::string& name) { return matches_any({pattern}, name); };
        if (std::ranges::any_of(read.unknown, is_named) ||
            std::ranges::any_of(read.results, is_named, [](const CaseResult& one) { return one.file.name; }))
            continue;
        if (std::ranges::none_of(names, is_named))
            throw InputError("there is no case " + in_quotes(pattern) + did_you_mean(pattern, names));
        throw InputError(read.file,
                         in_quotes(pattern) + " passed there, or was not drawn; leave it out, or name another");
    }
}

}  // namespace

bool matches_any(const std::vector<std::string>& patterns, const std::string& name) {
    return std::ranges::any_of(patterns, [&](const std::string& pattern) {
        return pattern == name || ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    });
}

void take_named(std::span<CaseResult> results, const std::vector<std::string>& patterns, std::ostream& say) {
    for (CaseResult& result : results) {
        if (result.fresh.empty()) continue;
        if (patterns.empty() || matches_any(patterns, result.file.name)) take_one(result, say);
    }
}

void take_asked(std::span<CaseResult> results, const std::filesystem::path& folder, std::ostream& say) {
    bool all = false;
    for (CaseResult& result : results) {
        if (!can_be_taken(result)) continue;
        const Reply answer = all ? Reply::yes : ask(result, folder, say);
        if (answer == Reply::quit) return;
        all = all || answer == Reply::all;
        if (answer != Reply::no) take_one(result, say);
    }
}

picture_tests::RunOptions run_options(const std::string& name, const std::vector<std::string>& named, bool all) {
    using picture_tests::FreshGoldens;
    if (matches_any(named, name)) return {FreshGoldens::of_all};
    return {all ? FreshGoldens::missing : FreshGoldens::of_failed};
}

bool take_report(const std::filesystem::path& report, const std::filesystem::path& folder,
                 const std::vector<CaseFile>& cases, const std::vector<std::string>& patterns, std::ostream& say) {
    const picture_tests::CaseReport read = picture_tests::read_case_report(report, folder, cases);
    check_patterns(read, cases, patterns);
    const auto is_meant = [&](const std::string& name) { return patterns.empty() || matches_any(patterns, name); };
    std::vector<GoldenChange> changes;
    std::vector<std::string> on_cases;
    bool all = true;
    int taken = 0, known = 0;
    const auto leave_out = [&](const std::string& name, const std::string& why) {
        warn(name + ": not accepted: " + why);
        all = false;
    };
    for (const std::string& name : read.unknown) {
        if (!is_meant(name)) continue;
        leave_out(name, "there is no such case");
    }
    for (const CaseResult& one : read.results) {
        if (!is_meant(one.file.name)) continue;
        if (one.fresh.empty()) {
            leave_out(one.file.name, "it has no golden to take: " + one.message);
            continue;
        }
        if (brings_case(one)) {
            check_bytes(one.fresh, read.file);
            // Who has it in hand by its name has looked at it: a case decides what its goldens are worth.
            if (std::ranges::find(patterns, one.file.name) == patterns.end()) {
                leave_out(one.file.name, "the report brings " + one.file.file.string() +
                                             ", which is the case itself, no golden; name the case to take it");
                continue;
            }
            std::ranges::move(words_on_brought_case(one), std::back_inserter(on_cases));
        }
        const std::size_t before = changes.size();
        std::ranges::copy_if(one.fresh, std::back_inserter(changes), [](const GoldenChange& change) {
            return picture_tests::golden_bytes(change.file) != change.bytes;
        });
        ++(changes.size() > before ? taken : known);
    }
    check_bytes(changes, read.file);
    write_goldens(changes);
    for (const GoldenChange& change : changes) {
        say << (change.bytes ? "wrote " : "removed ") << cleaned(change.file.string()) << '\n';
    }
    for (const std::string& line : on_cases) say << cleaned(line) << '\n';
    const std::string of = cleaned(read.file.string());
    if (known > 0) say << counted(known, "case has", "cases have") << " the goldens of " << of << " already\n";
    if (taken > 0 || (known == 0 && changes.empty()))
        say << "accepted " << counted(taken, "case", "cases") << " of " << of << '\n';
    return all;
}

}  // namespace mobbscope::cli
