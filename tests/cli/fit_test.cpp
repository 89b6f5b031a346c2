#include "run_program.h"

#include <base/text.h>
#include <explain/expected_cost.h>
#include <explain/level_columns.h>
#include <explain/tree_cost.h>
#include <scene/fitted_scene.h>
#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

TEST(Fit, JsonIsTheTree) {
    const Result run = run_program({"fit", kCrossing, "--json", "--tree", "umobb", "--leaf", "7", "--axes",
                                    "covariance", "--time-scale", "1.5", "--levels", "4"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const json trees = json::parse(run.out)["trees"];
    ASSERT_EQ(trees.size(), 2u);
    const FittedScene fitted(load_scene(kCrossing), {mobb::TreeKind::umobb, 7, 4, mobb::Axes::covariance, 1.5});
    const mobb::Tree& tree = fitted.tree(1);
    const json& printed = trees[1];
    EXPECT_EQ(keys(printed), (std::set<std::string>{"clip", "tree", "axes", "leaf", "time_scale", "expected", "counted",
                                                    "levels", "nodes", "findings"}));
    EXPECT_EQ(printed["clip"], "bend");
    EXPECT_EQ(printed["tree"], "umobb");
    EXPECT_EQ(printed["axes"], "covariance");
    EXPECT_EQ(printed["leaf"], 7);
    EXPECT_EQ(printed["time_scale"], 1.5);
    ASSERT_EQ(printed["nodes"].size(), tree.nodes().size());
    const ExpectedCost cost = expected_cost(tree, tree).value();
    const std::vector<double> shares = cost.node_shares();
    for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
        const mobb::Node& node = tree.nodes()[i];
        const mobb::Box box = tree.box(static_cast<int>(i));
        const json& entry = printed["nodes"][i];
        EXPECT_EQ(keys(entry),
                  (std::set<std::string>{"index", "parent", "level", "first", "count", "leaf", "kind", "center", "axes",
                                         "half", "t0", "t1", "share", "empty", "floor", "overhang", "waste"}));
        EXPECT_EQ(entry["index"], i);
        EXPECT_EQ(entry["parent"], tree.parent(static_cast<int>(i)));
        EXPECT_EQ(entry["level"], tree.level(static_cast<int>(i)));
        EXPECT_EQ(entry["first"], node.first);
        EXPECT_EQ(entry["count"], node.count);
        EXPECT_EQ(entry["leaf"], node.is_leaf());
        const std::size_t dimensions = entry["kind"] == "obb2d" ? 2 : 3;
        ASSERT_EQ(entry["center"].size(), dimensions);
        ASSERT_EQ(entry["axes"].size(), dimensions);
        ASSERT_EQ(entry["half"].size(), dimensions);
        for (int k = 0; k < static_cast<int>(dimensions); ++k) {
            const auto at = static_cast<std::size_t>(k);
            EXPECT_EQ(entry["center"][at], box.center[k]);
            EXPECT_EQ(entry["half"][at], box.half[k]);
            ASSERT_EQ(entry["axes"][at].size(), dimensions);
            for (int m = 0; m < static_cast<int>(dimensions); ++m) {
                EXPECT_EQ(entry["axes"][at][static_cast<std::size_t>(m)], box.axes[at][m]);
            }
        }
        EXPECT_EQ(entry["t0"], tree.t0(node));
        EXPECT_EQ(entry["t1"], tree.t1(node));
        EXPECT_EQ(entry["share"], shares[i]);
    }
    EXPECT_EQ(keys(printed["expected"]), (std::set<std::string>{"box_tests", "sample_pairs", "area", "offset"}));
    EXPECT_EQ(printed["expected"]["box_tests"], cost.tests.boxes());
    EXPECT_EQ(printed["expected"]["sample_pairs"], cost.tests[mobb::TestKind::samples]);
    EXPECT_EQ(printed["expected"]["area"], cost.placements.area());
    EXPECT_EQ(printed["expected"]["offset"], cost.placements.offset);
    const auto counted = standard_cost(fitted.shared_tree(1), most_counted(2));
    EXPECT_EQ(keys(printed["counted"]),
              (std::set<std::string>{"box_tests", "sample_pairs", "standard_error", "placements", "seed"}));
    EXPECT_EQ(printed["counted"]["box_tests"], counted->tests.boxes());
    EXPECT_EQ(printed["counted"]["sample_pairs"], counted->tests[mobb::TestKind::samples]);
    EXPECT_EQ(printed["counted"]["standard_error"], counted->count.standard_error());
    EXPECT_LT(printed["counted"]["standard_error"], 0.005);
    EXPECT_EQ(printed["counted"]["placements"], counted->queries);
    EXPECT_EQ(printed["counted"]["seed"], kCountedSeed);
    const auto figures = mobb::level_figures(tree);
    ASSERT_EQ(printed["levels"].size(), figures.size());
    EXPECT_EQ(printed["levels"][2]["nodes"], figures[2].nodes);
    EXPECT_EQ(printed["levels"][2]["volume"], figures[2].volume);
    EXPECT_EQ(printed["levels"][2]["tightness"], *figures[2].tightness);
    std::set<std::string> columns;
    for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
        columns.emplace(column.name);
        EXPECT_EQ(printed["levels"][2][std::string(column.name)], *column.of(figures[2])) << column.name;
    }
    EXPECT_EQ(keys(printed["levels"][2]), columns);
}

/// The fields of lines without line breaks in quotes.
std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
    std::vector<std::vector<std::string>> out;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        out.push_back({""});
        bool quoted = false;
        for (const char c : line) {
            if (c == '"') quoted = !quoted;
            if (c == ',' && !quoted) {
                out.back().emplace_back();
            } else {
                out.back().back() += c;
            }
        }
    }
    return out;
}

/// Every number of --csv is that of --json, and figures of levels follow from its rows.
TEST(Fit, CsvHasARowForEachNode) {
    const std::string scene = kCrossing;
    for (const char* kind : {"mobb", "umobb", "moving", "blocks"}) {
        const Result run = run_program({"fit", scene, "--csv", "--tree", kind, "--leaf", "7"});
        ASSERT_EQ(run.status, 0) << run.err;
        const json trees =
            json::parse(run_program({"fit", scene, "--json", "--tree", kind, "--leaf", "7"}).out)["trees"];
        const auto rows = csv_rows(run.out);
        const std::vector<std::string>& names = rows.front();
        std::size_t row = 1;
        for (const json& tree : trees) {
            std::vector<double> volumes(tree["levels"].size());
            double box_tests = 0;
            for (const json& node : tree["nodes"]) {
                ASSERT_LT(row, rows.size());
                ASSERT_EQ(rows[row].size(), names.size());
                std::map<std::string, std::string> cells;
                for (std::size_t i = 0; i < names.size(); ++i) cells[names[i]] = rows[row][i];
                EXPECT_EQ(cells["clip"], tree["clip"].get<std::string>());
                EXPECT_EQ(cells["tree"], kind);
                EXPECT_EQ(cells["leaf"], "7");
                EXPECT_EQ(cells["axes"], tree["axes"].get<std::string>());
                EXPECT_EQ(cells["time_scale"], format_double(tree["time_scale"]));
                for (const char* whole : {"index", "parent", "level", "first", "count"})
                    EXPECT_EQ(cells[whole], node[whole].dump()) << whole;
                for (const char* number : {"t0", "t1"}) EXPECT_EQ(cells[number], format_double(node[number]));
                EXPECT_EQ(cells["is_leaf"], node["leaf"] ? "true" : "false");
                EXPECT_EQ(cells["kind"], node["kind"].get<std::string>());
                for (const char* figure : {"share", "empty", "floor", "overhang", "waste"})
                    EXPECT_EQ(cells[figure], node[figure].is_null() ? "" : format_double(node[figure])) << figure;
                EXPECT_EQ(node["overhang"].is_null(), cells["tree"] != "umobb");
                EXPECT_NEAR(std::stod(cells["empty"]), std::stod(cells["volume"]) * (1 - std::stod(cells["tightness"])),
                            1e-9);
                if (!cells["box_tests"].empty()) box_tests += std::stod(cells["box_tests"]);
                const auto level = static_cast<std::size_t>(node["level"]);
                const bool ends = cells["is_leaf"] == "true";
                for (std::size_t k = level; k < (ends ? volumes.size() : level + 1); ++k)
                    volumes[k] += std::stod(cells["volume"]);
                ++row;
            }
            for (std::size_t k = 0; k < volumes.size(); ++k) {
                const double volume = tree["levels"][k]["volume"];
                EXPECT_NEAR(volumes[k], volume, 1e-9 * volume);
            }
            if (!tree["counted"].is_null()) {
                const double counted = tree["counted"]["box_tests"];
                EXPECT_NEAR(box_tests, counted, 1e-9 * counted);
            }
        }
        EXPECT_EQ(row, rows.size());
    }
}

TEST(Fit, CsvQuotesNamesAndIsNoJson) {
    const TempFolder folder;
    const auto file = folder.write("named.json", R"({"clips": {"a, \"b\"\nc": {"dt": 1, "samples": [[0, 0, 1]]}}})");
    const Result run = run_program({"fit", file.string(), "--csv"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("\n\"a, \"\"b\"\"\nc\",mobb,10,"), std::string::npos) << run.out;
    EXPECT_EQ(run_program({"fit", file.string(), "--csv", "--json"}).status, 2);
    if (std::filesystem::exists("/dev/full")) {
        EXPECT_EQ(run_program({"fit", file.string(), "--csv"}, "/dev/full").status, 3);
    }
}

TEST(Fit, BlocksAreNotCounted) {
    const Result run = run_program({"fit", kCrossing, "--json", "--tree", "blocks"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json tree = json::parse(run.out)["trees"][0];
    EXPECT_TRUE(tree["expected"].is_null());
    EXPECT_TRUE(tree["counted"].is_null());
    EXPECT_TRUE(tree["nodes"][0]["share"].is_null());
    const std::string text = run_program({"fit", kCrossing, "--tree", "blocks"}).out;
    EXPECT_NE(text.find("\n  Blocks are not counted"), std::string::npos) << text;
}

TEST(Fit, TheTableHasTheColumnsOfALevel) {
    const Result run = run_program({"fit", kCrossing});
    const std::string headings = "  level   nodes   volume m^2*s   tightness %   box tests   cost ns";
    EXPECT_NE(run.out.find("\n" + headings + "\n"), std::string::npos) << run.out;
    const FittedScene fitted(load_scene(kCrossing), {});
    const auto cost = standard_cost(fitted.shared_tree(0), most_counted(2));
    std::istringstream lines(run.out);
    std::string line;
    for (int i = 0; i < 2; ++i) std::getline(lines, line);
    EXPECT_EQ(line.rfind("  against itself: " + figure(cost->tests.boxes(), 3) + " box tests and ", 0), 0u) << line;
    for (int i = 0; i < 2; ++i) std::getline(lines, line);
    std::istringstream root(line);
    std::string shown;
    for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
        root >> shown;
        EXPECT_EQ(shown, level_text(column, mobb::level_figures(fitted.tree(0)).front())) << column.name;
    }
    root >> shown;
    EXPECT_EQ(shown, figure(cost->levels[0].boxes(), 3));
    root >> shown;
    EXPECT_EQ(shown, figure(cost->ns(cost->levels[0]), 3));
    EXPECT_EQ(line.size(), headings.size());
}

TEST(Fit, ColumnsStayApartWhereNumbersAreWiderThanHeadings) {
    const TempFolder folder;
    // Disks so thin that the tightness takes twelve characters.
    const auto file = folder.write(
        "thin.json", R"({"clips": {"thin": {"dt": 1, "samples": [[0, 0, 1e-60], [3, 1, 1e-60], [4, 9, 1e-60]]}}})");
    const Result run = run_program({"fit", file.string(), "--leaf", "3"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("\n  level   nodes   volume m^2*s    tightness %   box tests   cost ns\n"
                           "      0       1             69   1.36591e-119           1     "),
              std::string::npos)
        << run.out;
}

TEST(Fit, AMovingBoxIsGivenAtT0WithItsVelocity) {
    const Result run = run_program({"fit", kCrossing, "--json", "--tree", "moving"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json printed = json::parse(run.out)["trees"][1];
    EXPECT_EQ(printed["tree"], "moving");
    const Scene scene = load_scene(kCrossing);
    const std::span<const mobb::Disk> samples = scene.clips[1].clip->samples();
    for (const json& node : printed["nodes"]) {
        EXPECT_EQ(keys(node), (std::set<std::string>{"index", "parent", "level", "first", "count", "leaf", "kind",
                                                     "center", "axes", "half", "velocity", "t0", "t1", "share", "empty",
                                                     "floor", "overhang", "waste"}));
        EXPECT_EQ(node["kind"], "moving");
        ASSERT_EQ(node["velocity"].size(), 2u);
        ASSERT_EQ(node["axes"].size(), 2u);
        // What the file says must hold every disk at both ends of its hold interval, and touch one on each side.
        const double t0 = node["t0"];
        const double dt = scene.clips[1].clip->dt();
        for (std::size_t k = 0; k < 2; ++k) {
            double low = 0, high = 0;
            for (std::size_t i = node["first"]; i < node["first"].get<std::size_t>() + node["count"].get<std::size_t>();
                 ++i) {
                for (const std::size_t end : {i, i + 1}) {
                    const double t = static_cast<double>(end) * dt - t0;
                    const auto apart = [&](std::size_t m, double x) {
                        return (x - node["center"][m].get<double>() - t * node["velocity"][m].get<double>()) *
                               node["axes"][k][m].get<double>();
                    };
                    const double along = apart(0, samples[i].x) + apart(1, samples[i].y);
                    low = std::min(low, along - samples[i].r);
                    high = std::max(high, along + samples[i].r);
                }
            }
            EXPECT_NEAR(-low, node["half"][k], 1e-9);
            EXPECT_NEAR(high, node["half"][k], 1e-9);
        }
    }
}

TEST(Fit, AnAabbIsAFlatBoxAlongXAndY) {
    const Result run = run_program({"fit", kCrossing, "--json", "--tree", "aabb", "--axes", "minarea"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json result = json::parse(run.out);
    ASSERT_FALSE(result["trees"][1]["nodes"].empty());
    for (const json& node : result["trees"][1]["nodes"]) {
        EXPECT_EQ(node["kind"], "aabb");
        EXPECT_EQ(node["axes"], (json{{1.0, 0.0}, {0.0, 1.0}}));
        EXPECT_EQ(node["center"].size(), 2u);
        EXPECT_FALSE(node.contains("velocity"));
    }
}

TEST(Fit, SaysWhatStandsOut) {
    const std::vector<std::string> fit{"fit", kScenes / "circles.json", "--tree", "umobb", "--leaf", "7"};
    const Result text = run_program(fit);
    std::vector<std::string> in_json = fit;
    in_json.emplace_back("--json");
    const json findings = json::parse(run_program(in_json).out)["trees"][0]["findings"];
    ASSERT_FALSE(findings.empty());
    const json& loose = findings[0];
    EXPECT_EQ(keys(loose), (std::set<std::string>{"kind", "text", "level", "node", "sample", "mend"}));
    EXPECT_EQ(loose["kind"], "loose_levels");
    EXPECT_GT(loose["level"], 5);
    EXPECT_TRUE(loose["node"].is_null());
    EXPECT_TRUE(loose["sample"].is_null());
    EXPECT_EQ(loose["mend"]["tree"], "mobb");
    EXPECT_EQ(loose["mend"]["leaf"], 7);
    const std::string notice = "\n  notice: " + loose["text"].get<std::string>() + '\n';
    EXPECT_NE(text.out.find(notice), std::string::npos) << text.out;
    EXPECT_EQ(run_program({"fit", kScenes / "circles.json"}).out.find("notice:"), std::string::npos);
}

TEST(Fit, TextHasALineForEachLevel) {
    const Result run = run_program({"fit", kScenes / "circles.json", "--levels", "3"});
    ASSERT_EQ(run.status, 0) << run.err;
    // One of what stands out, too.
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 7);
    EXPECT_TRUE(run.out.starts_with("circles: 1260 samples in 42 s; mobb tree of 7 nodes"));
}

TEST(Fit, FitsAreCompared) {
    const Result run = run_program({"fit", kCrossing, "--compare", "mobb", "umobb,leaf=40", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json clips = json::parse(run.out)["compared"];
    ASSERT_EQ(clips.size(), 2u);
    const FittedScene fitted(load_scene(kCrossing), {.tree = mobb::TreeKind::umobb, .leaf = 40});
    for (int clip = 0; clip < 2; ++clip) {
        const json& found = clips[static_cast<std::size_t>(clip)];
        EXPECT_EQ(found["fits"][1]["fit"]["leaf"], 40);
        EXPECT_EQ(found["fits"][1]["name"], "UMOBB, leaf 40");
        const std::vector<mobb::LevelFigures> figures = mobb::level_figures(fitted.tree(clip));
        for (std::size_t i = 0; i < found["levels"].size(); ++i) {
            const json& volume = found["levels"][i]["volume"];
            if (i < figures.size()) {
                EXPECT_EQ(volume["values"][1], figures[i].volume);
                EXPECT_EQ(volume["best"], volume["values"][1] < volume["values"][0] ? 1 : 0) << i;
            } else {
                EXPECT_TRUE(volume["values"][1].is_null()) << "it is not so deep";
            }
        }
        EXPECT_EQ(found["leaves"]["volume"]["values"][1], figures.back().volume);
        EXPECT_GT(found["cost"]["values"][0], 0);
        EXPECT_NE(found["verdict"].get<std::string>().find("UMOBB"), std::string::npos);
    }
    const Result words = run_program({"fit", kCrossing, "--compare", "mobb", "umobb"});
    EXPECT_EQ(words.status, 0);
    for (const char* told : {"straight: UMOBB is tighter", "MOBB m^2*s", "* "})
        EXPECT_NE(words.out.find(told), std::string::npos) << words.out;
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"mobb"}, {"mobb", "x"}}) {
        std::vector<std::string> line{"fit", kCrossing, "--compare"};
        line.insert(line.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run_program(line).status, 2);
    }
}

}  // namespace
}  // namespace mobbscope
