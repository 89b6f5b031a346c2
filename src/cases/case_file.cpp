#include <cases/case_file.h>

#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/text.h>

#include <algorithm>
#include <system_error>

namespace mobbscope::picture_tests {

namespace {

constexpr int kVersion = 1;
constexpr std::string_view kExtension = ".case.json";

std::string stem_of(const CaseFile& file) {
    const std::string name = file.file.filename().string();
    return name.substr(0, name.size() - kExtension.size());
}

Tolerance read_tolerance(const JsonPlace& place) {
    if (const auto named = tolerance_from_name(place.string())) return *named;
    place.fail(in_quotes(place.string()) + " is no tolerance; give tight or loose");
}

}  // namespace

std::string_view name(Tolerance tolerance) { return tolerance == Tolerance::tight ? "tight" : "loose"; }

std::optional<Tolerance> tolerance_from_name(std::string_view text) {
    for (const Tolerance tolerance : {Tolerance::tight, Tolerance::loose}) {
        if (text == name(tolerance)) return tolerance;
    }
    return std::nullopt;
}

DiffOptions diff_options(Tolerance tolerance) {
    if (tolerance == Tolerance::tight) return {.channel_tolerance = 3, .pixel_fraction = 0.001, .shift = 0};
    return {.channel_tolerance = 8, .pixel_fraction = 0.005, .shift = 1};
}

std::filesystem::path CaseFile::beside(std::string_view ending) const {
    return file.parent_path() / (stem_of(*this) + std::string(ending));
}

std::string CaseFile::ending_of(const std::filesystem::path& other) const {
    return other.filename().string().substr(stem_of(*this).size());
}

std::vector<CaseFile> find_cases(const std::filesystem::path& folder) {
    std::vector<CaseFile> cases;
    std::error_code error;
    std::filesystem::recursive_directory_iterator at(folder, error);
    for (const std::filesystem::recursive_directory_iterator end; !error && at != end; at.increment(error)) {
        const std::string file = at->path().filename().string();
        if (!file.ends_with(kExtension) || file.size() == kExtension.size()) continue;
        const std::string path = at->path().lexically_relative(folder).generic_string();
        cases.push_back({path.substr(0, path.size() - kExtension.size()), at->path()});
    }
    if (error) {
        throw InputError(folder.string(), "",
                         "cannot be searched for cases: " + error.message() + "; give the folder that holds them");
    }
    if (cases.empty()) throw InputError(folder.string(), "", "holds no case; a case is a file NAME.case.json");
    std::sort(cases.begin(), cases.end(), [](const CaseFile& a, const CaseFile& b) { return a.name < b.name; });
    return cases;
}

CaseTerms read_terms(const JsonPlace& root) {
    const JsonPlace version = root.require("mobbscope_case");
    if (version.number() != kVersion) {
        version.fail("the case has version " + short_double(version.number()) + "; this program reads version " +
                     std::to_string(kVersion));
    }
    CaseTerms out;
    if (const auto tolerance = root.find("tolerance")) out.tolerance = read_tolerance(*tolerance);
    if (const auto skip = root.find("skip")) {
        if (skip->string().empty()) skip->fail("say why the case is skipped");
        out.skip = skip->string();
    }
    return out;
}

CaseTerms read_terms(const CaseFile& file) {
    const std::string name = file.file.string();
    const JsonValue value = parse_json(read_file(file.file), name);
    return read_terms(JsonPlace(value, name));
}

}  // namespace mobbscope::picture_tests
