#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cases/case_file.h>
#include <cases/case_report.h>
#include <cli/asked_cases.h>
#include <cli/golden_updates.h>
#include <cli/program.h>
#include <picture_tests/run_cases.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

namespace mobbscope::cli {

using picture_tests::CaseFile;
using picture_tests::CaseOutcome;
using picture_tests::CaseResult;

namespace {

/// The text of an object without its braces; empty if it has no members.
std::string_view members_of(std::string_view object) {
    object = trimmed(object);
    return trimmed(object.substr(1, object.size() - 2));
}

/// Further keys of a case, as they stand in it.
std::string_view checked_keys(const std::string& keys, const std::string& name) {
    const std::string of = "the keys that the test gives for " + name;
    const JsonText text = parse_json(keys, of);
    const JsonPlace root(text, of);
    for (const char* given : {"mobbscope_case", "scene"}) {
        if (const auto found = root.find(given)) found->fail("is given by the test itself; remove it");
    }
    if (root.members() == 0) return {};
    return members_of(keys);
}

/// The scene as it stands in a case: itself, or the name of its file.
std::string scene_in_case(const std::string& scene, const CaseFile& file) {
    if (trimmed(scene).starts_with('{')) {
        parse_json(scene, "the scene that the test gives for " + file.name);
        return std::string(trimmed(scene));
    }
    check_file_name(scene);
    std::error_code ignored;
    if (!std::filesystem::exists(scene, ignored)) throw InputError(scene, "", "there is no such file");
    // Not through symbolic links, as a case's paths are read.
    const std::filesystem::path from = whole_path(file.file.parent_path());
    std::ostringstream out;
    JsonWriter json(out);
    json.value(whole_path(scene).lexically_relative(from).generic_string());
    return std::move(out).str();
}

/// In the text of a scene its lines count as in the case, where it begins in the first one.
std::string case_text(const JsonPlace& request, const CaseFile& file) {
    std::string out = R"({"mobbscope_case": 1, "scene": )" + scene_in_case(request.require("scene").string(), file);
    if (const auto keys = request.find("keys")) {
        const std::string_view members = checked_keys(keys->string(), file.name);
        if (!members.empty()) out.append(",\n ").append(members);
    }
    return out + "}\n";
}

/// The first line of an answer.
std::string answer_line(CaseOutcome outcome, const std::string& name) {
    return std::string(picture_tests::name(outcome)) + ' ' + cleaned(name) + '\n';
}

CaseResult failed_case(const CaseFile& file, const std::string& why) {
    CaseResult out;
    out.file = file;
    out.outcome = CaseOutcome::failed;
    out.message = why;
    return out;
}

}  // namespace

AskedCases::AskedCases(AskedCasesOptions options)
    : options_(std::move(options)), drawer_({.backend = options_.backend, .jobs = 1}, options_.folder) {}

CaseResult AskedCases::drawn(const CaseFile& file, const std::string& asked) {
    picture_tests::RunOptions options = run_options(file.name, options_.update_names, options_.update_all);
    options.asked = asked;
    CaseResult result = drawer_.draw({file, std::move(options)});
    for (const std::filesystem::path& read : std::exchange(result.read, {})) note_read(read);
    return result;
}

std::string AskedCases::answer(std::string_view line) {
    const std::string of = "a request";
    const auto fail = [](const std::string& name, const std::string& why) {
        return answer_line(CaseOutcome::failed, name) + why + '\n';
    };
    try {
        if (!is_utf8(line)) {
            // The name may be all right, and tells which test is meant.
            std::string plain(line);
            std::ranges::replace_if(
                plain, [](char c) { return static_cast<unsigned char>(c) > '~'; }, '?');
            const JsonText text = parse_json(plain, of);
            const JsonPlace root(text, of);
            return fail(root.require("name").string(),
                        "what the test gives is not UTF-8; write its name, scene and keys in UTF-8");
        }
        const JsonText text = parse_json(line, of);
        const JsonPlace root(text, of);
        root.allow_only({"name", "scene", "keys"});
        root.require("scene").string();
        const std::string& name = root.require("name").string();
        if (picture_tests::is_case_name(name)) return answer_to(root);
        return fail(name, in_quotes(name) +
                              " cannot be the name of a case: give words as a file's name has, without , * ? and a "
                              "leading -; all and 1 have a meaning of their own");
    } catch (const InputError& error) {
        return fail("", error.what());
    }
}

std::string AskedCases::answer_to(const JsonPlace& request) {
    const std::string& name = request.require("name").string();
    const CaseFile file = picture_tests::case_named(options_.folder, name);
    CaseResult result;
    std::ostringstream wrote;
    const auto failed = [&](const std::string& why) {
        return answer_line(CaseOutcome::failed, name) + "failed: " + cleaned(name) + ": " + why + '\n';
    };
    try {
        const std::string text = case_text(request, file);
        const auto [before, is_new] = asked_.emplace(name, text);
        if (!is_new && before->second != text) {
            // What was found of the first stays.
            return failed(
                "another test has asked for this name with another scene or other keys; give each its own name");
        }
        result = drawn(file, text);
        try {
            check_not_read(options_.output / picture_tests::kReportFile);
            check_kept(result, options_.output);
        } catch (const InputError& error) {
            return failed(cleaned(error.what()));
        }
        if (!result.fresh.empty() && (options_.update_all || matches_any(options_.update_names, name))) {
            take_named({&result, 1}, {}, wrote);
        }
    } catch (const InputError& error) {
        result = failed_case(file, error.what());
    }
    std::string out =
        answer_line(result.outcome, name) + wrote.str() + picture_tests::words_on(result, options_.output);
    if (can_be_taken(result)) out += "  or run the test with MOBBSCOPE_UPDATE=" + shell_word(name) + '\n';
    std::erase_if(results_, [&](const CaseResult& one) { return one.file.name == name; });
    results_.push_back(std::move(result));
    // Of what cannot be written the report may still tell.
    keep_pictures(results_.back(), options_.output);
    if (results_.back().outcome == CaseOutcome::passed) results_.back().actual.clear();
    return out;
}

void AskedCases::keep_report() {
    const std::string replaced =
        add_to_case_report(options_.output, options_.folder, results_, picture_tests::Cases::some);
    if (!replaced.empty()) warn(replaced);
}

}  // namespace mobbscope::cli
