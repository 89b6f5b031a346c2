#include <base/error.h>
#include <base/text.h>
#include <cases/case_report.h>
#include <cli/golden_updates.h>
#include <cli/program.h>
#include <picture_tests/run_cases.h>

#include <fnmatch.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <iterator>
#include <map>
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
    for (const std::filesystem::path& file : take(result)) say << "wrote " << cleaned(file.string()) << '\n';
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

/// By folder, what its goldens are drawn with.
using References = std::map<std::filesystem::path, picture_tests::Reference>;

/// What the goldens of all these cases are drawn with, if those of a report are taken, by folder. Throws InputError if
/// the report does not say, or its job did not draw all of them.
References references_of(const picture_tests::CaseReport& read, const std::vector<CaseFile>& cases) {
    const auto refuse = [&](const std::string& name, const std::string& why) {
        throw InputError(read.file.string(), cleaned(name), "--new-reference: " + why);
    };
    for (const CaseResult& one : read.results) {
        if (lacks_opengl(one)) refuse(one.file.name, "its picture was not drawn; take the report of a job with OpenGL");
        if (!one.other_here.empty()) {
            const std::string file = picture_tests::reference_file(one.file.file.parent_path()).string();
            refuse(one.file.name, "the job compared it with goldens of another system (" + one.other_here +
                                      "), so the report may lack some that differ; remove " + file +
                                      ", run the job again and take its report");
        }
    }
    if (!read.run) {
        refuse("",
               "the report does not say what drew the pictures; run the job again with this Mobbscope, and take the "
               "page of its --html");
    }
    std::vector<CaseFile> drawn;
    std::ranges::copy_if(cases, std::back_inserter(drawn), [](const CaseFile& file) {
        return picture_tests::read_terms(file).holds(picture_tests::Held::picture);
    });
    // A test may have asked for others, which are no files yet.
    for (const CaseResult& one : read.results) {
        if (!draws_nothing(one)) drawn.push_back(one.file);
    }
    References out;
    for (const CaseFile& file : drawn) {
        if (std::ranges::find(read.run->names, file.name) == read.run->names.end()) {
            refuse(file.name,
                   "the job did not draw it, or not as it drew the others; take the report of a job that draws all "
                   "cases, without NAME and --shard, and without a reference.json of another system");
        }
        out.emplace(file.file.parent_path(), read.run->reference);
    }
    return out;
}

}  // namespace

bool matches_any(const std::vector<std::string>& patterns, const std::string& name) {
    return std::ranges::any_of(patterns, [&](const std::string& pattern) {
        return pattern == name || ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    });
}

void take_named(std::span<CaseResult> results, const std::vector<std::string>& patterns, std::ostream& say) {
    for (CaseResult& result : results) {
        if (result.fresh.empty() || !result.other_here.empty()) continue;
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

void check_is_from_here(const std::filesystem::path& folder, const CaseResult& result) {
    if (result.other_here.empty()) return;
    throw InputError("--update: " + picture_tests::reference_file(result.file.file.parent_path()).string() +
                     " says where the goldens are from, and here are " + result.other_here +
                     "; take them there, or from the report of a job there with mobbscope test " +
                     shell_word(folder.string()) + " --accept REPORT, or all anew with --update all --new-reference");
}

void take_as_reference(std::vector<CaseResult>& results, std::ostream& say) {
    const picture_tests::Summary sum = picture_tests::summary(results);
    if (sum[picture_tests::CaseOutcome::failed] > 0 || sum[picture_tests::CaseOutcome::skipped] > 0 ||
        std::ranges::any_of(results, picture_tests::lacks_opengl)) {
        warn(
            "nothing is taken, as some of the cases cannot be drawn or are skipped: all goldens of a reference are "
            "from one place");
        return;
    }
    take_named(results, {}, say);
    References references;
    for (const CaseResult& result : results) {
        if (!draws_nothing(result)) references[result.file.file.parent_path()] = result.drawn_by.reference;
    }
    for (const auto& [folder, reference] : references) {
        picture_tests::write_reference(folder, reference);
        say << "wrote " << cleaned(picture_tests::reference_file(folder).string()) << '\n';
    }
}

picture_tests::RunOptions run_options(const std::string& name, const std::vector<std::string>& named, bool all) {
    using picture_tests::FreshGoldens, picture_tests::GoldenSource;
    if (matches_any(named, name)) return {GoldenSource::reference, FreshGoldens::of_all};
    return {GoldenSource::reference, all ? FreshGoldens::missing : FreshGoldens::of_failed};
}

bool take_report(const std::filesystem::path& report, const std::filesystem::path& folder,
                 const std::vector<CaseFile>& cases, const std::vector<std::string>& patterns, bool new_reference,
                 std::ostream& say) {
    const picture_tests::CaseReport read = picture_tests::read_case_report(report, folder, cases);
    check_patterns(read, cases, patterns);
    const auto is_meant = [&](const std::string& name) { return patterns.empty() || matches_any(patterns, name); };
    std::vector<GoldenChange> changes;
    bool all = true;
    int taken = 0, known = 0;
    const auto leave_out = [&](const std::string& name, const std::string& why) {
        if (new_reference) {
            throw InputError(read.file.string(), cleaned(name),
                             why +
                                 "; --new-reference takes all or nothing: mend the case, run the job again and take "
                                 "its report");
        }
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
        if (!new_reference && !one.other_here.empty()) {
            warn(one.file.name + ": the report is not from where its goldens are: it was drawn with " + one.other_here);
        }
        const std::size_t before = changes.size();
        std::ranges::copy_if(one.fresh, std::back_inserter(changes), [](const GoldenChange& change) {
            return picture_tests::golden_bytes(change.file) != change.bytes;
        });
        ++(changes.size() > before ? taken : known);
    }
    for (const auto& [of, reference] : new_reference ? references_of(read, cases) : References()) {
        const std::filesystem::path file = picture_tests::reference_file(of);
        const std::optional<std::string> now = picture_tests::golden_bytes(file);
        const std::string text = picture_tests::reference_text(reference);
        if (now != text) changes.push_back({file, text, now});
    }
    check_bytes(changes, read.file);
    write_goldens(changes);
    for (const GoldenChange& change : changes) {
        say << (change.bytes ? "wrote " : "removed ") << cleaned(change.file.string()) << '\n';
    }
    const std::string of = cleaned(read.file.string());
    if (known > 0) say << counted(known, "case has", "cases have") << " the goldens of " << of << " already\n";
    if (taken > 0 || (known == 0 && changes.empty()))
        say << "accepted " << counted(taken, "case", "cases") << " of " << of << '\n';
    return all;
}

}  // namespace mobbscope::cli
