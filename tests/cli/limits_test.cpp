// What small files and single options may cost: refused where it is too much, said in docs/limits.md.
#include "run_program.h"

#include <base/file.h>
#include <conflicts/conflicts.h>
#include <crowd/simulation/simulate.h>
#include <import/clip/sampling.h>
#include <import/skeleton/motion.h>
#include <paper_tables/workload.h>
#include <render/drawlist/picture_options.h>
#include <render/image/image.h>
#include <render/image/png.h>
#include <render/pictures/build_draw_list.h>
#include <support/folders.h>
#include <support/gzip.h>
#include <support/png_file.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
namespace {

/// "33,554,432".
std::string with_commas(std::int64_t number) {
    std::string out = std::to_string(number);
    for (auto at = static_cast<std::ptrdiff_t>(out.size()) - 3; at > 0; at -= 3) out.insert(out.begin() + at, ',');
    return out;
}

TEST(Limits, AreThoseOfTheTable) {
    const std::string table = read_file(kSource / "docs/limits.md");
    const auto expect_row = [&table](std::string_view what, std::int64_t limit) {
        const std::size_t row = table.find("| " + std::string(what) + " |");
        ASSERT_NE(row, std::string::npos) << what;
        const std::string line = table.substr(row, table.find('\n', row) - row);
        EXPECT_NE(line.find(' ' + with_commas(limit)), std::string::npos) << line << " but " << limit;
    };
    expect_row("samples of a file of tracks or a table", kMaxSamples);
    expect_row("samples made of a file, or of the sources of a scene", kMostMadeSamples);
    expect_row("poses of single joints likewise", kMostMadePoses);
    expect_row("characters in a file", kMostCharacters);
    expect_row("pixels of a picture that is read", kMostPngPixels);
    expect_row("pixels of a strip", kMostStripPixels);
    expect_row("side of a picture that is drawn", kMaxSide);
    expect_row("its pixels", kMaxPixels);
    expect_row("its pixels with 4 samples each", kMostDrawn / (4 + 2));
    expect_row("its pixels with 8 samples each", kMostDrawn / (8 + 2));
    expect_row("disks drawn of agents that share clips", kMostDisksOfSharedClips);
    expect_row("conflicts in the window", kMostSceneConflicts);
    expect_row("`simulate --agents`", kMaxAgents);
    expect_row("plays of a run", kMostPlays);
    expect_row("`bench --queries`", kMaxQueries);
}

class LimitsTest : public ::testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& text) const {
        write_file(folder.path() / name, text);
        return folder.path() / name;
    }
    static void expect_refused(const Result& run, const std::string& why) { testing::expect_refused(run, 2, why); }

    const TempFolder folder;
};

TEST_F(LimitsTest, AFewRowsDoNotBecomeAnyNumberOfSamples) {
    // 50,000 seconds at 30 samples each: out of step, so made anew.
    write("long.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n50000,0,1,1\n");
    EXPECT_EQ(run_program({"info", folder.path() / "long.csv"}).status, 0);
    const std::string twice =
        write("twice.json", R"({"clips": {"a": {"source": "long.csv"}, "b": {"source": "long.csv"}}})");
    const Result run = run_program({"fit", twice});
    expect_refused(run, "/clips/b/source: with this one the scene's clips become more than 2000000");
}

TEST_F(LimitsTest, AFewJointsDoNotBecomeAnyNumberOfPoses) {
    std::string bvh = "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n";
    for (int i = 0; i < 100; ++i) bvh += "JOINT j\n{\nOFFSET 0 1 0\nCHANNELS 0\n}\n";
    bvh += "}\nMOTION\nFrames: 5\nFrame Time: 1000\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n";
    const std::string file = write("joints.bvh", bvh);
    expect_refused(run_program({"info", file}), "joints.bvh: its clips become more than 2000000 samples, or 10000000");
    EXPECT_EQ(run_program({"info", file, "--fps", "3"}).status, 0);
}

/// Bytes that the program takes at most.
std::int64_t peak_memory(const std::vector<std::string>& arguments) {
    const Result run = run_program(arguments, "/dev/null");
    EXPECT_EQ(run.status, 0) << run.err;
    return run.peak_memory;
}

TEST_F(LimitsTest, ConflictsAreWrittenAsTheyAreFound) {
#ifdef MOBBSCOPE_SANITIZED
    GTEST_SKIP() << "a sanitizer's memory is not the program's";
#endif
    const auto crowd = [this](int count) {
        std::string text = R"({"clips": {"c": {"dt": 0.1, "samples": [[0, 0, 1]]}}, "agents": [)";
        for (int i = 0; i < count; ++i)
            text += std::string(i > 0 ? "," : "") + R"({"name": ")" + std::to_string(i) + R"(", "clip": "c"})";
        return write("crowd.json", text + "]}");
    };
    const std::int64_t few = peak_memory({"conflicts", crowd(2)});
    constexpr int kCount = 500;
    constexpr std::int64_t kConflicts = std::int64_t{kCount} * (kCount - 1) / 2;
    // What sorts them is kept, 32 bytes each, and who is near whom; each whole takes over 400.
    EXPECT_LT(peak_memory({"conflicts", crowd(kCount)}) - few, 200 * kConflicts);
}

std::string repeated(std::string_view text, std::size_t bytes) {
    std::string out;
    while (out.size() + text.size() <= bytes) out += text;
    return out;
}

TEST_F(LimitsTest, NoSmallPackedFileTakesMuchMemory) {
#ifdef MOBBSCOPE_SANITIZED
    GTEST_SKIP() << "a sanitizer's memory is not the program's";
#endif
    constexpr std::size_t kUnpacked = std::size_t{63} << 20;
    const std::string fbx =
        "; FBX 7.4.0 project file\nFBXHeaderExtension: {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n";
    const struct {
        const char* name;
        std::string text;
        const char* why;
    } kKinds[] = {
        {"wide.json.gz", R"({"clips": [)" + repeated("1,", kUnpacked) + "1]}", "its JSON would take"},
        {"objects.json.gz", R"({"clips": [)" + repeated("{},", kUnpacked) + "1]}", "its JSON would take"},
        {"nested.json.gz", R"({"clips": [)" + repeated("[[[[]]]],", kUnpacked) + "1]}", "its JSON would take"},
        {"rows.csv.gz", "x,y\n" + repeated("0,0\n", kUnpacked), "its rows would take"},
        {"tracks.txt.gz", repeated("1 1 0 0\n", kUnpacked), "its rows would take"},
        {"deep.ndjson.gz", "{\"track\": " + std::string(kUnpacked, '['), "a line would take"},
        {"nodes.gltf.gz", R"({"asset": {"version": "2.0"}, "nodes": [)" + repeated("{},", 27'000'000) + "{}]}",
         "holds more than 10000000 values"},
        {"records.fbx.gz", fbx + repeated("a:1,", kUnpacked) + "1\n", "its records would take"},
        {"values.fbx.gz", fbx + "a: " + repeated("1,", kUnpacked) + "1\n", "its records would take"},
        {"cells.txt.gz", "0:" + repeated("(0,0),", kUnpacked), "its rows would take"},
    };
    for (const auto& kind : kKinds) {
        const std::string file = write(kind.name, gzipped(kind.text));
        ASSERT_LT(std::filesystem::file_size(file), 200'000u) << kind.name;
        const Result run = run_program({kind.name == std::string_view("rows.csv.gz") ? "fit" : "info", file});
        expect_refused(run, kind.why);
        EXPECT_LT(run.peak_memory, 1'000'000'000) << kind.name;
    }
    // Unpacked by hand, it is as large as it is.
    const std::string rows = write("rows.csv", "x,y\n" + repeated("0,0\n", 20'000'000));
    EXPECT_EQ(run_program({"info", rows, "--dt", "0.1", "--radius", "1"}).status, 0);
}

TEST_F(LimitsTest, TheLargestPicturesAreComparedInAGigabyte) {
#ifdef MOBBSCOPE_SANITIZED
    GTEST_SKIP() << "a sanitizer's memory is not the program's";
#endif
    Image black(1 << 25, 1);
    for (std::size_t i = 3; i < black.rgba.size(); i += 4) black.rgba[i] = 255;
    const std::string wide = write("wide.png", png_bytes(black));
    black = {};
    const Result run = run_program(
        {"diff", wide, wide, "-o", folder.path() / "h.png", "--strip", folder.path() / "s.png", "--shift", "1"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_LT(run.peak_memory, 1'000'000'000);
}

TEST_F(LimitsTest, AListAsTextEndsAfterAMillionRows) {
    // Two of each 1415 agents are 1000405 pairs, which share no time.
    std::string text = R"({"clips": {"c": {"dt": 0.1, "samples": [[0, 0, 1]]}}, "agents": [)";
    for (int i = 0; i < 1415; ++i)
        text += std::string(i > 0 ? "," : "") + R"({"name": ")" + std::to_string(i) + R"(", "clip": "c", "start": )" +
                std::to_string(i) + "}";
    const std::filesystem::path out = folder.path() / "out.txt";
    EXPECT_EQ(run_program({"query", write("crowd.json", text + "]}")}, out).status, 0);
    const std::string list = read_file(out);
    EXPECT_TRUE(list.ends_with("\n... and 405 more; --json has all\n")) << list.substr(list.size() - 200);
    EXPECT_NE(list.find("\n999999: "), std::string::npos);
}

std::string header_alone(int width, int height) {
    return png_header({.width = width, .height = height}) + png_chunk("IDAT", "");
}

TEST_F(LimitsTest, PicturesBeyondTheirPixelsAreRefusedByTheirHeader) {
    const std::string large = write("large.png", header_alone(12000, 11000));
    expect_refused(run_program({"diff", large, large, "--shift", "1"}),
                   "large.png: the picture of 12000x11000 pixels is too large; up to 33554432 pixels are read");
    const std::string tall = write("tall.png", header_alone(1, 134217728));
    expect_refused(run_program({"diff", tall, tall}), "too large");
}

TEST_F(LimitsTest, MovesOfAGraphAreShort) {
    write("long.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n20000,0,1,1\n");
    const std::string graph = R"({"clips": {"c": {"source": "long.csv"}}, "graph": {"hubs": [{"name": "h"}],
        "moves": [{"clip": "c", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [0, 1, 0]}]}})";
    const std::string run = folder.path() / "run.json";
    expect_refused(run_program({"simulate", write("graph.json", graph), "-o", run}),
                   "of 1 move there are 600001 samples, more than 500000 and 1000 for each");
    const Result whole = run_program({"simulate", folder.path() / "long.csv", "--whole", "-o", run});
    EXPECT_EQ(whole.status, 2) << whole.err;
    EXPECT_NE(whole.err.find("long.csv: of 1 move there are 600001 samples"), std::string::npos) << whole.err;
}

TEST_F(LimitsTest, AgentsThatShareALongClipAreNotDrawnInAnyNumber) {
    write("long.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n5000,0,1,1\n");
    std::string text = R"({"clips": {"c": {"source": "long.csv"}}, "agents": [)";
    for (int i = 0; i < 20; ++i)
        text += std::string(i > 0 ? "," : "") + R"({"name": ")" + std::to_string(i) + R"(", "clip": "c"})";
    const Result run =
        run_program({"render", write("agents.json", text + "]}"), "--draw-list", folder.path() / "l.json"});
    EXPECT_EQ(run_program({"render", folder.path() / "agents.json", "--show", "moment", "--draw-list",
                           folder.path() / "m.json"})
                  .status,
              0)
        << "shows a disk of each";
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("agents.json: its agents have 3000020 disks, and of clips that agents share 2000000"),
              std::string::npos)
        << run.err;
}

TEST_F(LimitsTest, PicturesWithTooManySamplesAreRefused) {
    const std::string scene =
        write("scene.json", R"({"clips": {"c": {"dt": 0.1, "samples": [[0, 0, 1]]}}, "agents": []})");
    const std::string out = folder.path() / "out.png";
    expect_refused(run_program({"render", scene, "-o", out, "--size", "7680x4320"}),
                   "--size, --samples: a picture of 7680x4320 pixels with 4 samples each takes too much memory");
    expect_refused(run_program({"render", scene, "-o", out, "--size", "7680x4320", "--ui"}), "takes too much memory");
    expect_refused(run_program({"render", scene, "-o", out, "--size", "4096x4096", "--samples", "8"}),
                   "at most 9953280");
    EXPECT_FALSE(std::filesystem::exists(out));
    const std::string list = folder.path() / "list.json";
    EXPECT_EQ(run_program({"render", scene, "--draw-list", list, "--size", "7680x4320"}).status, 0)
        << "needs no pixels";
    write("a.case.json", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "7680x4320"})");
    EXPECT_NE(run_program({"test", folder.path(), "--output", folder.path() / "o"}).out.find("takes too much memory"),
              std::string::npos);
}

TEST_F(LimitsTest, QueriesThatAreRecordedAndMeasuredAreLimited) {
    expect_refused(run_program({"bench", "table1", "--queries", "1000001"}), "1 to 1000000");
    expect_refused(
        run_program({"simulate", "g.json", "-o", "r.json", "--record", "q.json", "--record-queries", "500001"}),
        "0 to 500000");
}

}  // namespace
}  // namespace mobbscope
