#include <cases/case_report.h>

#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/lock.h>
#include <base/text.h>
#include <render/image/png.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

constexpr int kReportVersion = 1;

/// Leaves of a page its report, with the lines that stand before it empty, so that messages count its lines; of a text
/// that is no page all of it.
std::string report_in(std::string text, const std::string& name) {
    const std::size_t begin = text.find(kReportBegins);
    if (begin == text.npos) {
        const std::size_t first = text.find_first_not_of(" \t\r\n");
        if (first != text.npos && text[first] == '<')
            throw InputError(name, "", "is a page without a report; give the one that mobbscope test --html wrote");
        return text;
    }
    const std::size_t end = text.find(kReportEnds, begin);
    if (end == text.npos) throw InputError(name, "", "ends within its report; copy the whole page");
    text.resize(end);
    const auto report = text.begin() + static_cast<std::ptrdiff_t>(begin + kReportBegins.size());
    std::replace_if(
        text.begin(), report, [](char c) { return c != '\n'; }, ' ');
    return text;
}

bool is_told(const CaseResult& result) {
    return result.outcome != CaseOutcome::passed && result.outcome != CaseOutcome::skipped;
}

/// Whether accepting what is told at this place would write the file of the case.
bool would_write_case(const JsonPlace& result) {
    bool brings = false;
    result.require("fresh").each(
        [&](const JsonPlace& one) { brings = brings || one.require("golden").string() == kCaseExtension; });
    return brings;
}

/// The folder of the goldens of a case that is told at this place; nothing if the report does not say, or only that it
/// is in there, as "..", and was moved: then the case is not there.
std::optional<std::filesystem::path> told_folder(const JsonPlace& place, const std::string& name,
                                                 const std::filesystem::path& report) {
    const auto told = place.find("folder");
    if (!told) return std::nullopt;
    std::filesystem::path folder = whole_path(whole_path(report).parent_path() / told->string());
    const bool is_around = std::filesystem::path(told->string()).filename() == ".." || told->string() == ".";
    std::error_code ignored;
    if (is_around && !(is_case_name(name) && std::filesystem::exists(case_named(folder, name).file, ignored)))
        return std::nullopt;
    return folder;
}

/// Whether a report that tells of a folder means this one, wherever the report may have been copied to.
bool is_same_folder(const std::filesystem::path& told, const std::filesystem::path& folder) {
    std::error_code ignored;
    if (is_same_file(told, folder)) return true;
    return !std::filesystem::exists(told, ignored) && own_name(told) == own_name(folder);
}

/// `others`: takes what the report tells of other folders.
CaseReport read_report(const std::filesystem::path& report, const std::filesystem::path& folder,
                       const std::vector<CaseFile>& cases, std::vector<CaseResult>& others) {
    CaseReport out;
    std::error_code ignored;
    out.file = std::filesystem::is_directory(report, ignored) ? report / kReportFile : report;
    const std::string name = out.file.string();
    if (!std::filesystem::exists(out.file, ignored)) {
        throw InputError(
            name, "", "there is no report; give the folder that mobbscope test --output left, or the page of --html");
    }
    const JsonText value = parse_json(report_in(read_file(out.file), name), name);
    const JsonPlace root(value, name);
    const JsonPlace version = root.require("mobbscope_report");
    if (version.number() != kReportVersion) {
        version.fail("the report has version " + format_double(version.number()) + "; this program reads version " +
                     std::to_string(kReportVersion));
    }
    std::set<std::pair<std::filesystem::path, std::string>> seen;
    root.require("cases").each([&](const JsonPlace& result) {
        const JsonPlace named = result.require("name");
        const std::string& of = named.string();
        const std::optional<std::filesystem::path> told = told_folder(result, of, out.file);
        if (!seen.insert({told.value_or(folder), of}).second)
            named.fail("the case " + in_quotes(of) + " is given twice");
        if (told && !is_same_folder(*told, folder)) {
            others.push_back(read_result(result, {case_named(*told, of)}));
        } else if (std::ranges::find(cases, of, &CaseFile::name) != cases.end()) {
            out.results.push_back(read_result(result, cases));
        } else if (is_case_name(of) && would_write_case(result)) {
            out.results.push_back(read_result(result, {case_named(folder, of)}));
        } else {
            out.unknown.push_back(of);
        }
    });
    return out;
}

}  // namespace

void write_case_report(std::ostream& out, std::span<const CaseResult> results, const std::filesystem::path& where) {
    const auto told_as = [&](const std::filesystem::path& folder) {
        return whole_path(folder).lexically_relative(whole_path(where)).generic_string();
    };
    std::ostringstream text;
    JsonWriter json(text);
    json.begin_object();
    json.member("mobbscope_report", kReportVersion);
    json.begin_array("cases");
    for (const CaseResult& result : results) {
        if (is_told(result)) write_result(json, result, Pictures::not_in_fresh, told_as(result.file.folder()));
    }
    json.end_array();
    json.end_object();
    // It can only stand in a string.
    for (const char c : text.str()) c == '<' ? out << "\\u003c" : out << c;
}

CaseReport read_case_report(const std::filesystem::path& report, const std::filesystem::path& folder,
                            const std::vector<CaseFile>& cases) {
    std::vector<CaseResult> others;
    CaseReport out = read_report(report, folder, cases, others);
    if (out.results.empty() && out.unknown.empty() && !others.empty()) {
        throw InputError(out.file.string(), "",
                         "tells of the goldens in " + others.front().file.folder().string() + ", not of those in " +
                             folder.string() + "; give that folder, or another report");
    }
    return out;
}

std::string add_to_case_report(const std::filesystem::path& output, const std::filesystem::path& folder,
                               std::span<const CaseResult> results, Cases cases) {
    constexpr std::chrono::seconds kPatience(60);
    const auto name_of = [](const CaseResult& one) -> const std::string& { return one.file.name; };
    std::vector<CaseResult> told;
    std::ranges::copy_if(results, std::back_inserter(told), is_told);
    const std::filesystem::path file = output / kReportFile;
    std::error_code ignored;
    std::string replaced;
    if (results.empty() || (told.empty() && !std::filesystem::exists(file, ignored))) return replaced;
    make_folder_of(file);
    const Descriptor lock = lock_folder(output, kPatience);
    if (!lock.is_open()) {
        throw MachineError(file.string() +
                           ": cannot be written, as another process has locked its folder for a minute, or the folder "
                           "cannot be locked; give another one");
    }
    if (std::filesystem::exists(file, ignored)) {
        try {
            std::vector<CaseResult> others;
            std::vector<CaseResult> before = read_report(file, folder, cases_there(folder), others).results;
            std::erase_if(before, [&](const CaseResult& one) {
                return cases == Cases::all || std::ranges::find(results, one.file.name, name_of) != results.end();
            });
            for (std::vector<CaseResult>* kept : {&before, &others}) std::ranges::move(*kept, std::back_inserter(told));
        } catch (const InputError& error) {
            replaced = "the old report cannot be read and is replaced: " + std::string(error.what());
        }
    }
    std::ranges::sort(told, {}, name_of);
    check_stays_in_folder(file);
    if (told.empty()) {
        std::filesystem::remove(file, ignored);
        return replaced;
    }
    std::ostringstream report;
    write_case_report(report, told, output);
    write_file(file, std::move(report).str());
    return replaced;
}

void check_bytes(std::span<const GoldenChange> changes, const std::filesystem::path& report) {
    std::vector<std::shared_ptr<const Spent>> spent;  // one picture follows the other, but all of them take time
    for (const GoldenChange& change : changes) {
        if (!change.bytes) continue;
        const std::string name = report.string() + ": " + change.file.string() + " as it would be";
        if (change.file.extension() == ".png") {
            spent.push_back(read_png_bytes(*change.bytes, name).spent);
        } else {
            parse_json(*change.bytes, name);
        }
    }
}

}  // namespace mobbscope::picture_tests
