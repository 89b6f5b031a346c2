#include <fuzz/targets.h>

#include <base/error.h>
#include <base/text.h>
#include <cases/case_report.h>
#include <cases/case_result.h>
#include <cases/result_line.h>
#include <crowd/graph/build_graph.h>
#include <crowd/simulation/move_set.h>
#include <crowd/simulation/simulate.h>
#include <fuzz/readers.h>
#include <mobb/clip.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>
#include <scene/fitted_scene.h>
#include <scene/scene.h>
#include <support/gzip.h>
#include <support/png_file.h>
#include <support/temp_folder.h>
#include "import/fbx_scene.h"
#include "import/gltf_bytes.h"

#include <sqlite3.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace mobbscope::fuzz {

namespace {

const std::filesystem::path kSource = MOBBSCOPE_SOURCE_DIR;
constexpr std::size_t kLargestSeed = 100'000;  // bytes

/// The files of a folder whose names end so, by name.
std::vector<std::string> files_in(const std::filesystem::path& folder, std::string_view ending) {
    std::vector<std::filesystem::path> paths;
    if (std::filesystem::is_directory(folder)) {
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.is_regular_file() && entry.file_size() <= kLargestSeed && entry.path().native().ends_with(ending))
                paths.push_back(entry.path());
        }
    }
    std::ranges::sort(paths);
    std::vector<std::string> out;
    for (const std::filesystem::path& path : paths) out.push_back(testing::slurp(path));
    return out;
}

std::vector<std::string> none() { return {}; }

template <std::size_t count>
std::vector<std::string> joined(const std::array<std::vector<std::string>, count>& lists) {
    std::vector<std::string> out;
    for (const std::vector<std::string>& list : lists) out.insert(out.end(), list.begin(), list.end());
    return out;
}

/// Walks in every form of the format; layers, stepped and curved keys, transforms with all their parts.
std::vector<std::string> fbx_seeds() {
    using namespace testing::fbx;
    const Walk walk;
    Walk rich({{"PreRotation", vector(10, 20, 30)},
               {"RotationPivot", vector(1, 0, 0)},
               {"RotationOrder", choice(3)},
               {"Lcl Scaling", vector(1, 2, 1)},
               {"InheritType", choice(2)}});
    const std::int64_t layer = rich.scene.layer(rich.stack, {{"Weight", scalar(50)}, {"BlendMode", choice(1)}});
    Keys bent{{0, 1, 2}, {0, 30, 90}};
    bent.flags = {kUser, kBroken, kStepped};
    bent.slopes = {{1, 2}, {3, 4}, {0, 0}};
    bent.weights = {{0.3, 0.5}, {0.2, 0.9}, {0, 0}};
    bent.ends = {{"Pre-Extrapolation", {std::int64_t{82}, std::int64_t{2}}},
                 {"Post-Extrapolation", {std::int64_t{77}, std::int64_t{-1}}}};
    rich.scene.animate(layer, rich.hand, "Lcl Rotation", {{"X", bent}, {"Z", line(0, 10)}}, {{"d|Y", scalar(5)}});
    rich.scene.animate(rich.base, layer, "Weight", {{"Weight", line(0, 100)}});
    rich.scene.setting("UnitScaleFactor", 2.54);
    rich.scene.setting("UpAxis", std::int64_t{2});
    rich.scene.setting("TimeMode", std::int64_t{11});
    rich.scene.model_template({{"Lcl Translation", vector(0, 1, 0)}});
    rich.scene.stack("Take 002", {{"LocalStart", choice(0)}, {"LocalStop", choice(46'186'158'000)}});
    std::vector<std::string> out;
    for (const testing::FbxForm form : {testing::FbxForm{7400}, testing::FbxForm{7500, false, true},
                                        testing::FbxForm{7400, true}, testing::FbxForm{7100, false, false, true}}) {
        out.push_back(walk.scene.bytes(form));
        out.push_back(rich.scene.bytes(form));
    }
    return out;
}

std::vector<std::string> gltf_seeds() {
    using namespace testing;
    const std::string data = "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAA=";
    GltfBytes small;
    const int times = small.add_floats("SCALAR", {0, 1});
    const int places = small.add_floats("VEC3", {0, 0, 0, 2, 0, 0});
    small.channel("0", "translation", times, places).animation("walk");
    return {small.text("[{\"name\":\"hips\",\"children\":[1]},{\"translation\":[0.3,0,0]}]", "", data)};
}

std::vector<std::string> glb_seeds() {
    std::vector<std::string> out = files_in(kSource / "assets/clips", "stand.glb");
    const testing::GltfBytes everything = testing::everything_in_gltf();
    out.push_back(everything.glb(testing::kEverythingNodes, testing::kEverythingSkins));
    out.push_back(everything.glb(testing::kEverythingNodes));
    return out;
}

std::vector<std::string> sqlite_seeds() {
    const std::string of_version_1 =
        "PRAGMA page_size = 512; CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
        "INSERT INTO metadata VALUES('version','1'),('fps','10.0');"
        "CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL, pos_y REAL, ori_x REAL, "
        "ori_y REAL);"
        "INSERT INTO trajectory_data "
        "VALUES(0,1,0,0,1,0),(1,1,0.1,0,1,0),(5,2,4,2.5,1,0),(2,1,0.2,0,1,0),(6,2,5,2,1,0);";
    const std::string of_version_2 =
        "UPDATE metadata SET value = '2' WHERE key = 'version'; INSERT INTO metadata VALUES('xmin','0');"
        "CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL); INSERT INTO geometry VALUES(1,'POLYGON');"
        "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
        "CREATE INDEX frame_id_idx ON trajectory_data(frame, id);";
    std::vector<std::string> out;
    for (const std::string& sql : {of_version_1, of_version_1 + of_version_2}) {
        sqlite3* opened = nullptr;
        sqlite3_open(":memory:", &opened);
        const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(opened, &sqlite3_close);
        sqlite3_exec(opened, sql.c_str(), nullptr, nullptr, nullptr);
        sqlite3_int64 size = 0;
        const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(sqlite3_serialize(opened, "main", &size, 0),
                                                                            &sqlite3_free);
        out.emplace_back(reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size));
    }
    return out;
}

std::vector<std::string> scene_seeds() {
    std::vector<std::string> out = files_in(kSource / "tests/goldens", "_level.json");
    const std::vector<std::string> with_queries = files_in(kSource / "tests/goldens", "query.json");
    out.insert(out.end(), with_queries.begin(), with_queries.end());
    return out;
}

std::vector<std::string> run_seeds() {
    Scene scene;
    for (const double speed : {0.5, 1.2}) {
        std::vector<mobb::Disk> disks;
        for (int i = 0; i < 6; ++i) disks.push_back({speed * i / 5, 0.05 * i * i, 0.3});
        scene.clips.push_back({formatted("walk %g", speed), {}, {}, std::make_shared<mobb::Clip>(0.2, disks), {}, {}});
    }
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    std::vector<std::string> out{to_json(scene, true)};
    const FittedScene fitted(scene, {});
    const MoveSet moves(fitted);
    SimulateOptions options;
    options.agents = 3;
    options.area = {5, 5};
    options.seconds = 4;
    options.threads = 1;
    out.push_back(to_json(scene_of_run(moves, simulate(moves, options).run), true));
    return out;
}

/// Of the scene beside the seeds.
std::vector<std::string> case_seeds() {
    std::vector<std::string> out = joined(std::array{files_in(kSource / "tests/goldens", ".case.json"),
                                                     files_in(kSource / "assets/figures", ".case.json"),
                                                     files_in(kSource / "tests/app/goldens/menus", ".case.json")});
    for (std::string& text : out) {
        nlohmann::ordered_json json = nlohmann::ordered_json::parse(text);
        json["scene"] = "scene.json";
        if (json.contains("window")) json["window"]["script"] = "a.script";
        text = json.dump(1);
    }
    return out;
}

std::vector<std::string> script_seeds() {
    return joined(std::array{files_in(kSource / "tests/app/scripts", ".script"),
                             files_in(kSource / "tests/app/goldens/queries", ".script"),
                             files_in(kSource / "tests/app/goldens/crowd", ".script")});
}

std::vector<std::string> state_seeds() {
    return joined(std::array{files_in(kSource / "tests/app/review_cases", ".state.json"),
                             files_in(kSource / "assets/figures", "6.state.json"),
                             files_in(kSource / "tests/goldens", "disk_stack.state.json"),
                             files_in(kSource / "tests/app/goldens/queries", "hit.state.json")});
}

std::vector<std::string> png_seeds() {
    using namespace testing;
    std::vector<std::string> out = files_in(kSource / "tests/app/review_cases", "same.png");
    out.push_back(png_file({2, 1, 8, 6, false}, {0, 1, 2, 3, 4, 5, 6, 7, 8}));
    out.push_back(png_file({2, 2, 8, 0, false}, {1, 10, 20, 2, 30, 40}));
    out.push_back(
        png_file({3, 1, 2, 3, false}, {0, 0x1b}, png_chunk("PLTE", bytes_of({0, 0, 0, 255, 0, 0, 0, 9, 9, 1, 2, 3}))));
    out.push_back(png_file({1, 1, 16, 2, false}, {4, 1, 2, 3, 4, 5, 6}, png_chunk("gAMA", big_endian(45455))));
    out.push_back(png_file({2, 2, 8, 4, true}, {0, 1, 2, 0, 3, 4, 0, 5, 6, 7, 8}));
    return out;
}

picture_tests::CaseResult a_result() {
    Image actual(2, 1);
    actual.at(1, 0)[3] = 200;
    const Image golden(2, 1);
    picture_tests::CaseResult result;
    result.file = {"a", "a.case.json"};
    result.outcome = picture_tests::CaseOutcome::different;
    result.message = "two things";
    result.actual = png_bytes(actual);
    result.golden = png_bytes(golden);
    result.image = diff(actual, golden);
    result.findings = {{result.file.golden(), "pixels", {}}, {result.file.state(), "the state", {"A moved"}}};
    result.fresh = {{result.file.golden(), result.actual, result.golden}, {result.file.state(), "{}", {}}};
    result.drawn_by = {"osmesa", "llvmpipe"};
    return result;
}

std::vector<std::string> result_line_seeds() {
    std::ostringstream line;
    picture_tests::write_result_line(line, a_result());
    return {line.str()};
}

std::vector<std::string> report_seeds() {
    const std::vector<picture_tests::CaseResult> results{a_result()};
    std::ostringstream report;
    picture_tests::write_case_report(report, results, ".");
    const std::string page = "<!DOCTYPE html>\n" + std::string(picture_tests::kReportBegins) + report.str() +
                             std::string(picture_tests::kReportEnds) + "\n";
    return {report.str(), page};
}

std::vector<std::string> request_line_seeds() {
    return {picture_tests::request_line({"a", {}}),
            picture_tests::request_line({"b", {picture_tests::FreshGoldens::of_all}})};
}

std::vector<std::string> golden_seeds() {
    return joined(std::array{files_in(kSource / "tests/goldens", "answers.answers.json"),
                             files_in(kSource / "tests/goldens", "answers.trace.json"),
                             files_in(kSource / "tests/goldens", "answers.fit.json")});
}

std::vector<std::string> csv_seeds() { return files_in(kSource / "assets/scenes", ".csv"); }

std::vector<std::string> gzip_seeds() {
    std::vector<std::string> out;
    for (const char* of : {"csv", "bvh", "text-tracks", "trajnetpp", "mapf-plan", "mapf-text-plan"}) {
        for (const std::string& text : files_in(kSource / "fuzz/seeds" / of, "")) out.push_back(testing::gzipped(text));
    }
    return out;
}

const Target kTargets[] = {
    {"fbx", Form::fbx, read_fbx, fbx_seeds},
    {"gltf", Form::json, read_gltf, gltf_seeds},
    {"glb", Form::glb, read_gltf, glb_seeds},
    {"bvh", Form::lines, read_bvh, none},
    {"radii", Form::lines, read_radius_table, none},
    {"gzip", Form::gzip, read_any_file, gzip_seeds},
    {"scene", Form::json, read_scene, scene_seeds},
    {"run", Form::json, read_scene, run_seeds},
    {"certificate", Form::json, read_certificate_file, none},
    {"view", Form::json, read_view_state, none},
    {"case", Form::json, read_case, case_seeds},
    {"golden", Form::json, read_golden, golden_seeds},
    {"script", Form::lines, read_script, script_seeds},
    {"settings", Form::json, read_settings, none},
    {"png", Form::png, read_png_file, png_seeds},
    {"state", Form::json, read_state, state_seeds},
    {"result-line", Form::json, read_result_line, result_line_seeds},
    {"request-line", Form::json, read_request_line, request_line_seeds},
    {"report", Form::json, read_report, report_seeds},
};

}  // namespace

std::span<const Target> targets() {
    // Every reader of tracks is one.
    static const std::vector<Target> all = [] {
        std::vector<Target> out(std::begin(kTargets), std::end(kTargets));
        for (const FileReader* reader : file_readers()) {
            if (reader->contents == Contents::skeletons) continue;
            const bool is_database = reader->name == "jupedsim";
            const bool is_json = reader->name == "robot-runners";
            out.push_back({reader->name,
                           is_database ? Form::sqlite
                           : is_json   ? Form::json
                                       : Form::lines,
                           [reader](const std::string& bytes) { read_tracks(*reader, bytes); },
                           is_database             ? sqlite_seeds
                           : reader->name == "csv" ? csv_seeds
                                                   : none});
        }
        return out;
    }();
    return all;
}

const Target& target_named(std::string_view name) {
    const auto at = std::ranges::find(targets(), name, &Target::name);
    if (at != targets().end()) return *at;
    std::string all;
    for (const Target& target : targets()) all += ' ' + std::string(target.name);
    throw std::invalid_argument("no such target: '" + std::string(name) + "'; there are" + all);
}

bool accepts(const Target& target, const std::string& bytes) {
    try {
        target.read(bytes);
        return true;
    } catch (const InputError& error) {
        const std::string_view message = error.what();
        if (message.find('\n') != message.npos)
            throw std::logic_error("a refusal is not one line: " + std::string(message));
        return false;
    }
}

std::vector<std::string> all_seeds(const Target& target) {
    return joined(std::array{target.seeds(), files_in(kSource / "fuzz/seeds" / target.name, "")});
}

}  // namespace mobbscope::fuzz
