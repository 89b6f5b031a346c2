// "-" is standard input wherever a command takes a scene or a clip, packed or not; and the inputs of the shared data.
#include "run_program.h"

#include <support/folders.h>
#include <support/gzip.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

const std::string kInputTable = "id,frame,x,y,note\na,0,0,0,n\na,1,1,0,\nb,0,1,0.1,\nb,1,0,0.1,\n";

/// Runs the program with `input` as standard input.
Result run_with(const std::string& input, const std::vector<std::string>& arguments) {
    const TempFolder folder;
    return run_program(arguments, {}, folder.write("in", input));
}

TEST(StandardInput, IsWhatEveryCommandWorksOn) {
    const TempFolder folder;
    for (const std::string& input : {kInputTable, gzipped(kInputTable)}) {
        const Result info = run_with(input, {"info", "-", "--fps", "1"});
        EXPECT_EQ(info.status, 0) << info.err;
        EXPECT_NE(info.out.find("standard input: all of its 2 clips"), std::string::npos) << info.out;
        EXPECT_NE(info.out.find("the column 'note' is ignored"), std::string::npos);
        EXPECT_EQ(run_with(input, {"conflicts", "-", "--fps", "1", "--check"}).status, 1);
        for (const char* out : {"x.json", "x.csv"}) {
            const std::string file = (folder.path() / out).string();
            EXPECT_EQ(run_with(input, {"convert", "-", "--fps", "1", "-o", file}).status, 0);
            EXPECT_EQ(run_program({"conflicts", file, "--check"}).status, 1) << out;
        }
        EXPECT_EQ(run_with(input, {"query", "-", "--fps", "1"}).status, 0);
        EXPECT_EQ(run_with(input, {"fit", "-", "--fps", "1"}).status, 0);
    }
    const std::string scene = slurp(folder.path() / "x.json");
    EXPECT_EQ(run_with(scene, {"conflicts", "-", "--check"}).status, 1) << "a scene";
    EXPECT_EQ(run_with(gzipped(scene), {"query", "-"}).status, 0);
    EXPECT_EQ(run_program({"query", folder.write("x.json.gz", gzipped(scene)).string()}).status, 0);
}

TEST(StandardInput, OfASceneNamesSourcesFromTheWorkingFolder) {
    const TempFolder folder;
    const std::string file = folder.write("tracks.csv", kInputTable).string();
    const std::string source = std::filesystem::relative(file).string();
    const Result info =
        run_with(R"({"clips": {"one": {"source": ")" + source + R"(", "id": "b", "fps": 1, "columns": "x=x*2"}}})",
                 {"info", "-", "--json"});
    ASSERT_EQ(info.status, 0) << info.err;
    const auto clip = nlohmann::json::parse(info.out)["clips"][0];
    EXPECT_EQ(clip["path_length"], 2);
    EXPECT_EQ(clip["file"], source);
    EXPECT_EQ(
        nlohmann::json::parse(run_with(kInputTable, {"info", "-", "--json", "--dt", "1"}).out)["clips"][0]["file"],
        "standard input");
}

TEST(StandardInput, IsNamedInMessages) {
    for (const auto& [input, message] : std::initializer_list<std::pair<std::string, const char*>>{
             {"", "mobbscope: standard input: is empty"},
             {kInputTable,
              "mobbscope: standard input: line 1: the rows have frame numbers in place of times: give fps"},
             {kInputTable + "b,2,z,0,\n",
              "mobbscope: standard input: line 6, column 3 (x): 'z' is not a finite number"},
             {"<html>", "mobbscope: standard input: looks like an HTML page"},
             {gzipped(kInputTable).substr(0, 30), "mobbscope: standard input: ends within what gzip packed"},
             {"{\"clips\": {\"a\": {\"source\": \"-\"}}}",
              "mobbscope: standard input: line 1, /clips/a/source: standard "
              "input is not a source"}}) {
        for (const char* command : {"info", "conflicts", "query"}) {
            const Result run = run_with(input, {command, "-"});
            EXPECT_EQ(run.status, 2);
            EXPECT_TRUE(is_one_line(run.err)) << run.err;
            EXPECT_TRUE(run.err.starts_with(message)) << run.err;
        }
    }
}

TEST(StandardInput, IsRefusedAsWhatItIsLikeAFile) {
    const TempFolder folder;
    using namespace std::string_literals;
    for (const auto& [name, bytes, what] : std::initializer_list<std::tuple<const char*, std::string, const char*>>{
             {"a.h5", "\x89HDF\r\n\x1a\n\0"s, "looks like an HDF5 file; load it with pandas"},
             {"a.gpx", "<?xml version=\"1.0\"?><gpx/>", "looks like GPX, whose places are degrees; project them"},
             {"a.xml", "<a/>", "looks like XML or HTML; export the table as CSV"},
             {"a.json", "{\"features\": []}", "looks like GeoJSON, whose places are degrees; project them"},
             {"a.json", "[1]", "looks like JSON, a list; write it as CSV"},
             {"a.png", "\x89PNG\r\n\x1a\n", "looks like an image (PNG); give the tracks"},
             {"a.csv", "\xff\xfei\0d\0"s, "line 1: is UTF-16 text; save it as UTF-8"}}) {
        for (const char* command : {"info", "conflicts", "query"}) {
            const std::string file = folder.write(name, bytes).string();
            const std::string piped = run_with(bytes, {command, "-"}).err;
            EXPECT_TRUE(piped.starts_with("mobbscope: standard input: "s + what)) << piped;
            EXPECT_EQ(run_program({command, file}).err,
                      "mobbscope: " + file + piped.substr("mobbscope: standard input"s.size()));
        }
    }
}

TEST(Tables, ColumnsAreAnOptionOfCommandsAndScenes) {
    const TempFolder folder;
    const std::string file = folder.write("t.csv", "who;when;east;north\na;0;0,5;0\na;25;1,5;0\n").string();
    const Result info = run_program({"info", file, "--json", "--columns", "id=who,t=when/25,x=east,y=north"});
    ASSERT_EQ(info.status, 0) << info.err;
    EXPECT_EQ(nlohmann::json::parse(info.out)["clips"][0]["dt"], 1);
    const Result wrong = run_program({"info", file, "--columns", "east"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("write it like id=trackId,t=frame/25,x=xCenter"), std::string::npos) << wrong.err;
    const Result bvh =
        run_program({"conflicts", folder.write("t.txt", "10 1 0 0\n20 1 1 0\n").string(), "--columns", "x=y"});
    EXPECT_EQ(bvh.status, 2);
    EXPECT_NE(bvh.err.find("columns are for tables with a header"), std::string::npos) << bvh.err;
}

#define SKIP_WITHOUT_DATA(path) \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test data at " << (path)

TEST(TablesData, PublicAndLabTablesGiveTheirRightValues) {
    SKIP_WITHOUT_DATA(kSharedData / "public");
    const auto conflicts = [](const char* file, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"conflicts", (kSharedData / file).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments);
    };
    const Result axes = conflicts("public/jupedsim_semi_axes.txt");
    EXPECT_EQ(axes.status, 0);
    EXPECT_TRUE(axes.out.starts_with("0 conflicts among 2 agents")) << axes.out;
    EXPECT_NE(axes.err.find("semi-axes"), std::string::npos);
    EXPECT_EQ(axes.err.find("radii"), std::string::npos);
    // Grown by half of the clearance of 0.05 m they touch, by more they overlap.
    EXPECT_TRUE(conflicts("public/jupedsim_semi_axes.txt", {"--radius", "0.1749"}).out.starts_with("0 conflicts"));
    EXPECT_NE(conflicts("public/jupedsim_semi_axes.txt", {"--radius", "0.1751"}).out.find("1 conflict"),
              std::string::npos);

    const Result prose =
        run_program({"info", (kSharedData / "public/petrack_frame_rate_in_prose.txt").string(), "--json"});
    ASSERT_EQ(prose.status, 0) << prose.err;
    EXPECT_EQ(nlohmann::json::parse(prose.out)["clips"][0]["dt"], 0.04);

    const Result extra = run_program({"info", (kSharedData / "public/csv_extra_columns.csv").string(), "--json"});
    ASSERT_EQ(extra.status, 0) << extra.err;
    const auto clip = nlohmann::json::parse(extra.out)["clips"][0];
    EXPECT_EQ(clip["samples"], 2);
    EXPECT_NEAR(clip["path_length"].get<double>(), 0.1, 1e-12);
    EXPECT_EQ(clip["warnings"], nlohmann::json::array({"the columns 'vx' and 'vy' are ignored"}));

    EXPECT_EQ(conflicts("lab/id_frame_x_y.csv").status, 2);
    EXPECT_TRUE(conflicts("lab/id_frame_x_y.csv", {"--fps", "10"}).out.starts_with("0 conflicts among 2 agents"));
    const Result together = conflicts("lab/id_x_y.csv", {"--dt", "0.1", "--radius", "0.2"});
    EXPECT_EQ(together.status, 0);
    EXPECT_NE(together.err.find("all tracks start together"), std::string::npos);
    EXPECT_EQ(conflicts("lab/id_x_y.csv").status, 2);
}

}  // namespace
}  // namespace mobbscope
