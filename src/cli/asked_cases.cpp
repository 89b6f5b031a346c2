#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cases/case_file.h>
#include <cases/case_report.h>
#include <cli/asked_cases.h>
#include <cli/golden_updates.h>
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
    const std::filesystem::path from = std::filesystem::weakly_canonical(whole_path(file.file.parent_path()), ignored);
    const std::filesystem::path to = std::filesystem::canonical(scene, ignored);
    std::ostringstream out;
    JsonWriter json(out);
    json.value(to.lexically_relative(from).generic_string());
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
    return drawer_.draw({file, std::move(options)});
}

std::string AskedCases::answer(std::string_view line) {
    const std::string of = "a request";
    const JsonText text = parse_json(line, of);
    const JsonPlace root(text, of);
    root.allow_only({"name", "scene", "keys"});
    const JsonPlace named = root.require("name");
    const std::string& name = named.string();
    if (!picture_tests::is_case_name(name)) {
        return "failed\n" + in_quotes(name) + " cannot be the name of a case: give words as a file's name has\n";
    }
    const CaseFile file = picture_tests::case_named(options_.folder, name);
    CaseResult result;
    std::ostringstream wrote;
    try {
        result = drawn(file, case_text(root, file));
        if (!result.fresh.empty() && (options_.update_all || matches_any(options_.update_names, name))) {
            check_is_from_here(options_.folder, result);
            take_named({&result, 1}, {}, wrote);
        }
    } catch (const InputError& error) {
        result = failed_case(file, error.what());
    }
    keep_pictures(result, options_.output);
    std::string out = std::string(picture_tests::name(result.outcome)) + '\n' + wrote.str() +
                      picture_tests::words_on(result, options_.output);
    if (can_be_taken(result)) out += "  or run the test with MOBBSCOPE_UPDATE=" + shell_word(name) + '\n';
    std::erase_if(results_, [&](const CaseResult& one) { return one.file.name == name; });
    if (result.outcome == CaseOutcome::passed) result.actual.clear();
    results_.push_back(std::move(result));
    return out;
}

void AskedCases::keep_report() {
    const std::filesystem::path report = options_.output / picture_tests::kReportFile;
    std::error_code ignored;
    if (results_.empty()) return;
    if (picture_tests::summary(results_).ok() && !std::filesystem::exists(report, ignored)) return;
    picture_tests::make_folder_of(report);
    add_to_case_report(options_.output, options_.folder, std::move(results_));
}

}  // namespace mobbscope::cli
