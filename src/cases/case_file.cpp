#include <cases/case_file.h>
#include <cases/case_scene.h>

#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/text.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <ios>
#include <set>
#include <system_error>

namespace mobbscope::picture_tests {

namespace {

constexpr int kVersion = 1;
constexpr double kLeastTimeLimit = 0.1;  // seconds
constexpr double kMostTimeLimit = 86400;

std::string stem_of(const CaseFile& file) {
    const std::string name = file.file.filename().string();
    return name.substr(0, name.size() - kCaseExtension.size());
}

Tolerance read_tolerance(const JsonPlace& place) {
    if (const auto named = enumerator_named<Tolerance>(kTolerances, place.string())) return *named;
    place.fail(in_quotes(place.string()) + " is not a tolerance; give tight or loose");
}

/// What options take as text, here as text or number.
std::string word_of(const JsonPlace& place) {
    return place.is_number() ? format_double(place.number()) : place.string();
}

/// What a golden's file adds to the name of its case, and what is held by it.
struct GoldenEnding {
    std::string_view ending;
    Held held;
};
constexpr auto kGoldenEndings = std::to_array<GoldenEnding>({{".state.json", Held::picture},
                                                             {".png", Held::picture},
                                                             {".answers.json", Held::answers},
                                                             {".trace.json", Held::trace},
                                                             {".fit.json", Held::fit}});

std::vector<Held> read_hold(const JsonPlace& place) {
    if (place.is_string()) place.fail("give an array: [\"" + cleaned(place.string()) + "\"]");
    if (place.size() == 0) place.fail("nothing is held; name one or more of " + listed(kHeld) + ", or remove the key");
    std::vector<Held> out;
    place.each([&](const JsonPlace& word) {
        const auto held = enumerator_named<Held>(kHeld, word.string());
        if (!held) {
            word.fail(in_quotes(word.string()) + " cannot be held; give " + either(kHeld) +
                      did_you_mean(word.string(), std::vector<std::string>(kHeld.begin(), kHeld.end())));
        }
        if (std::ranges::find(out, *held) != out.end()) word.fail(in_quotes(word.string()) + " is given twice");
        out.push_back(*held);
    });
    return out;
}

/// Of a case that draws nothing.
void refuse_picture_keys(const JsonPlace& root) {
    for (const char* key : {"tolerance", "threshold", "allowed", "mask", "state", "columns", "select", "size", "scale",
                            "samples", "background", "window"}) {
        const auto found = root.find(key);
        if (found) found->fail("the case holds no picture; remove this, or hold the picture too");
    }
}

/// Whether a file with an ending such as ".answers.json" begins as such a golden: a scene may have such a name too.
bool begins_as(std::string_view ending, const std::filesystem::path& file) {
    const std::string key = "\"mobbscope_" + std::string(ending.substr(1, ending.rfind('.') - 1)) + '"';
    std::string begin(64, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    const std::size_t first = begin.find_first_not_of(" \t\r\n{");
    return first != begin.npos && std::string_view(begin).substr(first).starts_with(key);
}

std::vector<CaseFile> search_cases(const std::filesystem::path& folder, std::error_code& error) {
    std::vector<CaseFile> cases;
    std::filesystem::recursive_directory_iterator at(folder, error);
    for (const std::filesystem::recursive_directory_iterator end; !error && at != end; at.increment(error)) {
        const std::string file = at->path().filename().string();
        if (!file.ends_with(kCaseExtension) || file.size() == kCaseExtension.size()) continue;
        const std::string path = at->path().lexically_relative(folder).generic_string();
        cases.push_back({path.substr(0, path.size() - kCaseExtension.size()), at->path()});
    }
    std::ranges::sort(cases, {}, &CaseFile::name);
    return cases;
}

}  // namespace

DiffOptions diff_options(Tolerance tolerance) {
    if (tolerance == Tolerance::tight) return {};
    return {.channel_tolerance = 8, .pixel_fraction = 0.005, .shift = 1, .tile_tolerance = 8};
}

std::filesystem::path CaseFile::beside(std::string_view ending) const {
    return file.parent_path() / (stem_of(*this) + std::string(ending));
}

std::filesystem::path CaseFile::folder() const {
    std::filesystem::path out = file.parent_path();
    for (auto left = std::ranges::count(name, '/'); left > 0; --left) out = out.parent_path();
    return out;
}

std::vector<std::filesystem::path> CaseFile::goldens(std::span<const Held> held) const {
    std::vector<std::filesystem::path> out;
    for (const GoldenEnding& one : kGoldenEndings) {
        if (std::ranges::find(held, one.held) != held.end()) out.push_back(beside(one.ending));
    }
    return out;
}

std::filesystem::path CaseFile::golden_of(Held held) const {
    if (held == Held::picture) return golden();
    return beside('.' + std::string(mobbscope::picture_tests::name(held)) + ".json");
}

std::string CaseFile::ending_of(const std::filesystem::path& other) const {
    return other.filename().string().substr(stem_of(*this).size());
}

CaseFile case_named(const std::filesystem::path& folder, const std::string& name) {
    return {name, folder / (name + std::string(kCaseExtension))};
}

bool is_golden_ending(std::string_view ending) {
    return ending == kCaseExtension ||
           std::ranges::find(kGoldenEndings, ending, &GoldenEnding::ending) != kGoldenEndings.end();
}

std::vector<CaseFile> find_cases(const std::filesystem::path& folder) {
    std::error_code error;
    std::vector<CaseFile> cases = search_cases(folder, error);
    if (error) {
        throw InputError(folder.string(), "",
                         "cannot be searched for cases: " + error.message() + "; give the folder that holds them");
    }
    if (cases.empty()) throw InputError(folder.string(), "", "holds no case; a case is a file NAME.case.json");
    return cases;
}

std::vector<CaseFile> cases_there(const std::filesystem::path& folder) {
    std::error_code ignored;
    return search_cases(folder, ignored);
}

bool is_case_name(std::string_view name) {
    const std::filesystem::path path(name);
    constexpr std::string_view kSigns = ",*?";  // of --update
    const bool is_plain = is_utf8(name) && path.is_relative() && path.has_filename() && name.find("//") == name.npos &&
                          name != "all" && name != "1" && std::ranges::none_of(name, [&](char c) {
                              return static_cast<unsigned char>(c) < ' ' || kSigns.find(c) != kSigns.npos;
                          });
    return is_plain && std::ranges::none_of(path, [](const auto& part) {
               return part == ".." || part == "." || part.native().starts_with('-');
           });
}

std::vector<std::filesystem::path> orphaned_goldens(const std::filesystem::path& folder,
                                                    const std::vector<CaseFile>& cases) {
    std::set<std::filesystem::path> owned;
    for (const CaseFile& file : cases) {
        std::optional<CaseTerms> terms;
        try {
            terms = read_terms(file);
            // A scene may be called as a golden is.
            owned.insert(terms->scene.lexically_normal());
        } catch (const InputError&) {
            // What is wrong with a case is told where it is drawn.
        }
        constexpr std::array kAll{Held::picture, Held::answers, Held::trace, Held::fit};
        for (const std::filesystem::path& golden : file.goldens(terms ? std::span<const Held>(terms->hold) : kAll))
            owned.insert(golden.lexically_normal());
        if (terms && terms->mask) owned.insert(terms->mask->lexically_normal());
    }
    std::vector<std::filesystem::path> out;
    std::error_code error;
    std::filesystem::recursive_directory_iterator at(folder, error);
    for (const std::filesystem::recursive_directory_iterator end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        if (at->is_directory(ignored)) {
            if (std::filesystem::exists(at->path() / kReportFile, ignored)) at.disable_recursion_pending();
            continue;
        }
        const std::string name = at->path().filename().string();
        const bool is_golden = std::ranges::any_of(kGoldenEndings, [&](const GoldenEnding& one) {
            return name.ends_with(one.ending) && (one.ending == ".png" || begins_as(one.ending, at->path()));
        });
        if (is_golden && !owned.contains(at->path().lexically_normal())) out.push_back(at->path());
    }
    std::ranges::sort(out);
    return out;
}

bool CaseTerms::holds(Held held) const { return std::ranges::find(hold, held) != hold.end(); }

CaseTerms read_terms(const JsonPlace& root, const std::filesystem::path& folder) {
    const JsonPlace version = root.require("mobbscope_case");
    if (version.number() != kVersion) {
        version.fail("the case has version " + format_double(version.number()) + "; this program reads version " +
                     std::to_string(kVersion));
    }
    CaseTerms out;
    if (const auto hold = root.find("hold")) out.hold = read_hold(*hold);
    if (!out.holds(Held::picture)) refuse_picture_keys(root);
    if (const auto tolerance = root.find("tolerance")) out.tolerance = read_tolerance(*tolerance);
    out.diff = diff_options(out.tolerance);
    if (const auto threshold = root.find("threshold")) {
        read_at(*threshold, [&] { set_threshold(out.diff, word_of(*threshold)); });
    }
    if (const auto allowed = root.find("allowed")) {
        read_at(*allowed, [&] { set_allowance(out.diff, word_of(*allowed)); });
    }
    if (const auto mask = root.find("mask")) out.mask = read_path(*mask, folder);
    if (const auto state = root.find("state")) out.state = state->boolean();
    if (const auto limit = root.find("time_limit")) out.time_limit = limit->number(kLeastTimeLimit, kMostTimeLimit);
    if (const auto skip = root.find("skip")) {
        if (skip->string().empty()) skip->fail("say why the case is skipped");
        out.skip = skip->string();
    }
    const auto scene = root.find("scene");
    if (scene && scene->is_string()) out.scene = folder / scene->string();
    return out;
}

CaseTerms read_terms(const CaseFile& file, const std::optional<std::string>& text) {
    const std::string name = file.file.string();
    const JsonText value = parse_json(text ? *text : read_file(file.file), name);
    return read_terms(JsonPlace(value, name), file.file.parent_path());
}

}  // namespace mobbscope::picture_tests
