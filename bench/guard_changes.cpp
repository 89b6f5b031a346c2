/// Draws picture tests with real changes, drawn by a seed, and says what comparing finds of each; draws all of them for
/// comparison with another machine's; compares two such folders. bench/guard makes tables of it.
///
///     bench_guard changes [--seed N] [--number N] [--goldens DRAWN] FOLDER...
///     bench_guard draw OUT [--backend B] [--samples N] [--shift PIXELS] [--noise SEED] [--panels no] FOLDER...
///     bench_guard compare DRAWN DRAWN
///
/// `changes` prints a line for each change, `compare` one for each picture. Lines are of fields with tabs between them,
/// the first line is their names. Cases of the window, and those that hold no picture, are left out.
#include "guard_kinds.h"

#include <base/error.h>
#include <base/file.h>
#include <base/random.h>
#include <base/text.h>
#include <picture_tests/picture_maker.h>
#include <picture_tests/picture_state.h>
#include <picture_tests/test_case.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

struct NamedShot {
    std::string name;
    Shot shot;
};

std::vector<NamedShot> read_shots(std::span<const std::string> folders) {
    std::vector<NamedShot> out;
    for (const std::string& folder : folders) {
        for (const CaseFile& file : find_cases(folder)) {
            Case read = read_case(file.file);
            if (read.terms.skip || read.shot.window || !read.terms.holds(Held::picture)) continue;
            std::string name = own_name(folder) + "/" + file.name;
            std::ranges::replace(name, '/', '.');
            out.push_back({std::move(name), std::move(read.shot)});
        }
    }
    return out;
}

/// Of a case, if there is something of the kind in it.
std::optional<Drawn> changed(const Kind& kind, const Drawn& before, PictureMaker& maker, Uniform& random,
                             std::string& what) {
    Drawn out = before;
    if (const auto* shot = std::get_if<ChangeShot>(&kind.change)) {
        if (!(*shot)(out.shot, before, random, what)) return std::nullopt;
        out.lists = panel_lists(out.shot);
    } else if (const auto* list = std::get_if<ChangeList>(&kind.change)) {
        if (!(*list)(out.lists[pick(out.lists, random)], random, what)) return std::nullopt;
    } else {
        if (!std::get<ChangeImage>(kind.change)(out.picture, before, random, what)) return std::nullopt;
        return out;
    }
    out.picture = maker.draw(out.shot, out.lists);
    return out;
}

/// Where in the picture what is drawn has its corners and ends.
std::vector<std::optional<glm::vec2>> points_of(const std::vector<DrawList>& lists) {
    std::vector<std::optional<glm::vec2>> out;
    for (const DrawList& list : lists) {
        const auto add = [&](const glm::vec3& point) { out.push_back(list.projection.project(point)); };
        for (const DiskInstance& disk : list.disks) add(disk.base), add(disk.top);
        for (const BoxInstance& box : list.boxes) std::ranges::for_each(box_corners(box), add);
        for (const LineInstance& line : list.lines) add(line.from), add(line.to);
        for (const TextRun& text : list.texts) out.emplace_back(text.baseline);
        for (const OverlayLine& line : list.overlay_lines) out.emplace_back(line.from), out.emplace_back(line.to);
    }
    return out;
}

/// How many pixels the same things are apart at most; nothing if there are others.
std::optional<double> largest_move(const std::vector<DrawList>& a, const std::vector<DrawList>& b) {
    const auto from = points_of(a), to = points_of(b);
    if (from.size() != to.size()) return std::nullopt;
    double out = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (from[i] && to[i]) out = std::max(out, double{glm::length(*from[i] - *to[i])});
    }
    return out;
}

// ---- What is printed.

constexpr int kRounding = 1;        // of 255: what nobody sees
constexpr double kLeastMove = 0.2;  // pixels: a change that moves all by less is not counted among those to be seen
constexpr const char* kComparedFields = "altered\tlargest\tbeyond\tallowed\tpasses";

/// The fields of two pictures.
std::string compared(const Image& actual, const Image& golden) {
    const ImageDiff found = diff(actual, golden);
    if (!found.same_size) throw InputError("the pictures differ in size");
    return formatted("%lld\t%d\t%lld\t%lld\t%d", static_cast<long long>(found.unequal), found.largest,
                     static_cast<long long>(found.differing), static_cast<long long>(found.allowed()),
                     found.passes ? 1 : 0);
}

struct Options {
    std::vector<std::string> words;  ///< what is no option
    std::map<std::string, std::string, std::less<>> named{{"--seed", "1"},   {"--number", "10"}, {"--goldens", ""},
                                                          {"--samples", ""}, {"--noise", ""},    {"--backend", "auto"},
                                                          {"--shift", "0"},  {"--panels", "yes"}};
    const std::string& operator[](const char* name) const { return named.find(name)->second; }
};

/// What is first found of two states, or "-".
std::string state_difference(const std::string& actual, const std::string& golden) {
    const StateDifferences found = compare_states(actual, golden, "the golden");
    return found.lines.empty() ? "-" : found.lines.front();
}

std::filesystem::path picture_file(const std::filesystem::path& folder, const std::string& name) {
    return folder / (name + ".png");
}
std::filesystem::path state_file(const std::filesystem::path& folder, const std::string& name) {
    return folder / (name + ".state.json");
}

void make_changes(const Options& options) {
    PictureMaker maker(*backend_from_name(options["--backend"]));
    struct Golden {
        std::string name;
        Drawn here;
        Image picture;
        std::string state;
    };
    std::vector<Golden> goldens;
    for (NamedShot& one : read_shots(options.words)) {
        Golden golden{std::move(one.name), {std::move(one.shot), {}, {}}, {}, {}};
        golden.here.lists = panel_lists(golden.here.shot);
        golden.here.picture = maker.draw(golden.here.shot, golden.here.lists);
        const std::string& from = options["--goldens"];
        golden.picture = from.empty() ? golden.here.picture : read_png(picture_file(from, golden.name));
        golden.state = from.empty() ? picture_state(golden.here.shot, golden.here.lists)
                                    : read_file(state_file(from, golden.name));
        goldens.push_back(std::move(golden));
    }
    if (goldens.empty()) throw InputError("there is no case to change");
    std::cout << "kind\tcase\twhat\there\tmoved\t" << kComparedFields << "\tstate\n";
    Uniform random(std::stoull(options["--seed"]));
    const int number = std::stoi(options["--number"]);
    for (const Kind& kind : kinds_of_change()) {
        int visible = 0;
        for (int attempt = 0; visible < number && attempt < 5 * number; ++attempt) {
            const Golden& golden = goldens[pick(goldens, random)];
            std::string what;
            const std::optional<Drawn> after = changed(kind, golden.here, maker, random, what);
            if (!after) continue;
            const std::optional<double> moved =
                kind.moves ? largest_move(golden.here.lists, after->lists) : std::nullopt;
            const std::string state = picture_state(after->shot, after->lists);
            if (after->picture.rgba == golden.here.picture.rgba &&
                state == picture_state(golden.here.shot, golden.here.lists))
                continue;
            const int here = diff(after->picture, golden.here.picture).largest;
            if (here > kRounding && (!moved || *moved >= kLeastMove)) ++visible;
            std::cout << kind.name << '\t' << golden.name << '\t' << what << '\t' << here << '\t'
                      << (moved ? formatted("%.3f", *moved) : "-") << '\t' << compared(after->picture, golden.picture)
                      << '\t' << state_difference(state, golden.state) << std::endl;
        }
    }
}

/// Of -2 to 2 levels. What that would take beyond black or white stays as it is: cut off, its mean would not be 0.
void add_noise(Image& image, std::uint64_t seed) {
    Uniform random(seed);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        const int by = random.below(5) - 2;
        if (i % 4 != 3 && image.rgba[i] >= 2 && image.rgba[i] <= 253)
            image.rgba[i] = static_cast<std::uint8_t>(image.rgba[i] + by);
    }
}

/// Draws the scene, and no text over it, so many pixels to the right and below.
void shift_scene(ViewProjection& projection, float pixels) {
    const glm::vec2 by = 2 * pixels / glm::vec2(projection.size.width, -projection.size.height);
    for (int column = 0; column < 4; ++column) {
        glm::vec4& one = projection.clip_from_world[column];
        one += glm::vec4(by * one.w, 0, 0);
    }
    projection.middle += by;
}

void draw_all(const Options& options) {
    if (options.words.size() < 2) throw InputError("give a folder to write, and folders of picture tests");
    const std::filesystem::path out = options.words.front();
    std::filesystem::create_directories(out);
    PictureMaker maker(*backend_from_name(options["--backend"]));
    std::cout << maker.backend() << ", " << maker.renderer().context().version() << ", "
              << maker.renderer().context().device() << '\n';
    for (NamedShot& one : read_shots(std::span(options.words).subspan(1))) {
        if (options["--panels"] == "no" && one.shot.panels.size() > 1) continue;
        Shot shot = std::move(one.shot);
        if (!options["--samples"].empty()) shot.picture.samples = parse_samples(options["--samples"]);
        std::vector<DrawList> lists = panel_lists(shot);
        write_file(state_file(out, one.name), picture_state(shot, lists));
        for (DrawList& list : lists) shift_scene(list.projection, std::stof(options["--shift"]));
        Image picture = maker.draw(shot, lists);
        if (!options["--noise"].empty()) add_noise(picture, std::stoull(options["--noise"]));
        write_png(picture_file(out, one.name), picture);
    }
}

void compare_folders(const Options& options) {
    if (options.words.size() != 2) throw InputError("give two folders that `draw` wrote");
    const std::filesystem::path actual = options.words[0], golden = options.words[1];
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(golden)) {
        if (entry.path().extension() == ".png") names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    std::cout << "case\t" << kComparedFields << "\tstate\n";
    for (const std::string& name : names) {
        std::cout << name << '\t'
                  << compared(read_png(picture_file(actual, name)), read_png(picture_file(golden, name))) << '\t'
                  << state_difference(read_file(state_file(actual, name)), read_file(state_file(golden, name))) << '\n';
    }
}

Options parse_options(std::span<char*> arguments) {
    Options out;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string word = arguments[i];
        const auto found = out.named.find(word);
        if (found != out.named.end() && i + 1 < arguments.size()) {
            found->second = arguments[++i];
        } else if (word.starts_with("--")) {
            throw InputError("there is no option " + word + ", or it has no value");
        } else {
            out.words.push_back(word);
        }
    }
    if (!backend_from_name(out["--backend"])) throw InputError("there is no backend " + out["--backend"]);
    return out;
}

}  // namespace

void run_guard(std::span<char*> arguments) {
    const std::string mode = arguments.empty() ? "" : arguments.front();
    if (mode != "changes" && mode != "draw" && mode != "compare") {
        throw InputError("say changes, draw or compare first");
    }
    const Options options = parse_options(arguments.subspan(1));
    if (mode == "changes") return make_changes(options);
    if (mode == "draw") return draw_all(options);
    compare_folders(options);
}

}  // namespace mobbscope::picture_tests

int main(int argc, char** argv) {
    try {
        mobbscope::picture_tests::run_guard(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "bench_guard: " << error.what() << '\n';
        return 2;
    }
}
