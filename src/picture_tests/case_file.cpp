#include <picture_tests/case_file.h>

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

std::filesystem::path beside(const CaseFile& file, std::string_view extension) {
    const std::string name = file.file.filename().string();
    return file.file.parent_path() / (name.substr(0, name.size() - kExtension.size()) + std::string(extension));
}

Tolerance read_tolerance(const JsonPlace& place) {
    for (const Tolerance tolerance : {Tolerance::tight, Tolerance::loose}) {
        if (place.string() == name(tolerance)) return tolerance;
    }
    place.fail(in_quotes(place.string()) + " is no tolerance; give tight or loose");
}

}  // namespace

std::string_view name(Tolerance tolerance) { return tolerance == Tolerance::tight ? "tight" : "loose"; }

DiffOptions diff_options(Tolerance tolerance) {
    if (tolerance == Tolerance::tight) return {.channel_tolerance = 3, .pixel_fraction = 0.001, .shift = 0};
    return {.channel_tolerance = 8, .pixel_fraction = 0.005, .shift = 1};
}

std::filesystem::path CaseFile::golden() const { return beside(*this, ".png"); }

std::filesystem::path CaseFile::draw() const { return beside(*this, ".draw.json"); }

std::filesystem::path CaseFile::plain() const { return beside(*this, ".plain.png"); }

std::filesystem::path CaseFile::plain_draw() const { return beside(*this, ".plain.draw.json"); }

std::filesystem::path CaseFile::plain_state() const { return beside(*this, ".plain.state.json"); }

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

Case read_case(const std::filesystem::path& file) {
    const std::string name = file.string();
    const JsonValue value = parse_json(read_file(file), name);
    const JsonPlace root(value, name);
    root.allow_only({"$schema", "mobbscope_case", "tolerance", "skip", "scene", "fit", "view", "panels", "columns",
                     "select", "size", "scale", "samples", "background", "window"});
    if (const auto schema = root.find("$schema")) schema->string();
    const JsonPlace version = root.require("mobbscope_case");
    if (version.number() != kVersion) {
        version.fail("the case has version " + short_double(version.number()) + "; this program reads version " +
                     std::to_string(kVersion));
    }
    Case out;
    if (const auto tolerance = root.find("tolerance")) out.tolerance = read_tolerance(*tolerance);
    if (const auto skip = root.find("skip")) {
        if (skip->string().empty()) skip->fail("say why the case is skipped");
        out.skip = skip->string();
    } else {
        out.shot = read_shot(root, file.parent_path());
        out.shot.file = file;
    }
    return out;
}

}  // namespace mobbscope::picture_tests
