// `mobbscope graph`, as a user runs it.
#include "run_program.h"

#include <render/image/png.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include "render/backends.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

class GraphTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TempFolder>();
        built_ = run_program({"graph", "build", kClips, "-o", graph()});
    }
    static void TearDownTestSuite() { folder_.reset(); }
    static std::string graph() { return folder_->path() / "graph.json"; }
    static std::string path(const std::string& name) { return folder_->path() / name; }
    /// The graph as JSON, to be damaged.
    static nlohmann::json json() { return nlohmann::json::parse(slurp(graph())); }

    static void expect_refused(const std::vector<std::string>& arguments, const std::string& why, int status = 2) {
        testing::expect_refused(run_program(arguments), status, why);
    }

    static std::unique_ptr<TempFolder> folder_;
    static Result built_;
};

std::unique_ptr<TempFolder> GraphTest::folder_;
Result GraphTest::built_;

TEST_F(GraphTest, IsBuiltAndItsBoundsHold) {
    EXPECT_EQ(built_.status, 0) << built_.err;
    EXPECT_EQ(built_.err, "");
    EXPECT_NE(built_.out.find(" hubs, "), std::string::npos) << built_.out;
    const Result run = run_program({"graph", "info", graph(), "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json info = nlohmann::json::parse(run.out);
    EXPECT_TRUE(info["holds"]);
    EXPECT_EQ(info["moves"], json()["graph"]["moves"].size());
    EXPECT_EQ(info["hubs"].size(), json()["graph"]["hubs"].size());
    EXPECT_LE(info["joints"]["pose_distance"]["largest"], info["bounds"]["pose_distance"]);
    EXPECT_LE(info["joints"]["root_speed"]["largest"], info["bounds"]["root_speed"]);
    EXPECT_EQ(info["joints"]["pose_distance"]["count"], info["joints"]["count"]);
    EXPECT_EQ(info["dead_ends"].size(), 0u);
    EXPECT_EQ(info["continuity"]["measured"], info["joints"]["count"]);
    EXPECT_GT(info["continuity"]["foot_slide"]["within"]["metres"], info["continuity"]["foot_slide"]["median"]);
    double seconds = 0;
    for (const auto& source : info["sources"]) seconds += source["seconds"].get<double>();
    EXPECT_NEAR(seconds, info["seconds"].get<double>(), 1e-9);
    const Result words = run_program({"graph", "info", graph()});
    EXPECT_EQ(words.status, 0);
    for (const char* part :
         {"hubs, ", "a choice", "pose distance", "root velocity", "wander.glb",
          "joins           changes from frame to frame", "largest ratio   ", "feet            slide "}) {
        EXPECT_NE(words.out.find(part), std::string::npos) << part << " in " << words.out;
    }
}

TEST_F(GraphTest, TheSameInputAndSeedGiveTheSameFile) {
    ASSERT_EQ(run_program({"graph", "build", kClips, "-o", path("again.json")}).status, 0);
    EXPECT_TRUE(slurp(path("again.json")) == slurp(graph()));
    ASSERT_EQ(run_program({"graph", "build", kClips, "--seed", "9", "-o", path("other.json")}).status, 0);
    EXPECT_FALSE(slurp(path("other.json")) == slurp(graph()));
}

/// A body of 202 joints that stands still but for a hand, which moves by 10 nm a frame.
std::string statue() {
    const auto joint = [](const std::string& name, const std::string& offset, const std::string& channels) {
        return "JOINT " + name + "\n{\nOFFSET " + offset + "\nCHANNELS " + channels + "\n";
    };
    std::string text = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n";
    for (int i = 0; i < 100; ++i) {
        const std::string number = std::to_string(i);
        text += joint("spine" + number, "0.3 1 0.2", "0") + joint("rib" + number, "0.5 0.1 0.25", "0") + "}\n}\n";
    }
    text += joint("arm", "0 0 1", "3 Xposition Yposition Zposition") + joint("hand", "0 0 1", "0") + "}\n}\n}\n";
    text += "MOTION\nFrames: 150\nFrame Time: 0.0333333333\n";
    for (int i = 0; i < 150; ++i) text += "0 1 0 0 0 1." + std::to_string(100000000 + i).substr(1) + '\n';
    return text;
}

TEST_F(GraphTest, NothingIsWrittenIfNoMoveKeepsItsBoundsInTheFiles) {
    // Of a body of a kilometre the search, made to be fast, takes poses for the same that differ a little.
    folder_->write("statue.bvh", statue());
    const std::string out = path("statue.json");
    expect_refused({"graph", "build", path("statue.bvh"), "--unit", "1000", "--pose-distance", "1e-6", "-o", out},
                   "measured again from the files no move keeps the bounds (", 1);
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(run_program({"graph", "build", path("statue.bvh"), "--unit", "1", "-o", out}).status, 0);
}

TEST_F(GraphTest, TheOrderAndSpellingOfPathsDoNotMatter) {
    const auto built_from = [&](std::vector<std::string> places) {
        std::vector<std::string> arguments{"graph", "build", "--moves", "3", "-o", path("ordered.json")};
        arguments.insert(arguments.end(), places.begin(), places.end());
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 0) << run.err;
        return slurp(path("ordered.json"));
    };
    const std::string first = built_from({kClips / "wander.glb", kClips / "run.glb", kClips / "turn.glb"});
    EXPECT_NE(first, "");
    const std::string relative = std::filesystem::relative(kClips).string();
    EXPECT_TRUE(built_from({kClips / "turn.glb", relative + "/./run.glb", kClips / "../clips/wander.glb",
                            kClips / "run.glb"}) == first);
    const auto rigs = nlohmann::json::parse(first)["graph"]["rigs"];
    ASSERT_EQ(rigs.size(), 1u);
    EXPECT_GT(rigs[0]["joints"].size(), 5u);
}

TEST_F(GraphTest, ABadFileInAFolderIsLeftOutNamedAndCounted) {
    std::filesystem::create_directory(path("mixed"));
    std::filesystem::copy_file(kClips / "wander.glb", path("mixed/wander.glb"));
    folder_->write("mixed/broken.bvh", "HIERARCHY");
    folder_->write("mixed/empty.glb", "");
    const std::vector<std::string> build{"graph", "build", path("mixed"), "-o", path("mixed.json")};
    const Result run = run_program(build);
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* part : {"warning: left out: ", "mixed/broken.bvh: ", "mixed/empty.glb: ",
                             "left out 2 of 3 files; with --strict a bad file ends the build"}) {
        EXPECT_NE(run.err.find(part), std::string::npos) << part << " in " << run.err;
    }
    EXPECT_EQ(run_program({"graph", "info", path("mixed.json")}).status, 0);
    std::filesystem::remove(path("mixed.json"));
    expect_refused({"graph", "build", path("mixed"), "-o", path("mixed.json"), "--strict"}, "mixed/broken.bvh: ");
    expect_refused({"graph", "build", path("mixed"), path("mixed/empty.glb"), "-o", path("mixed.json")},
                   "mixed/empty.glb: ");
    std::filesystem::remove(path("mixed/wander.glb"));
    expect_refused(build, "mixed/broken.bvh: ");
    EXPECT_FALSE(std::filesystem::exists(path("mixed.json")));
    EXPECT_EQ(run_program({"graph", "build", kClips, path("mixed"), "--whole", "-o", path("mixed.json")}).status, 0);
}

TEST_F(GraphTest, TheJointsThatCountStandInTheFile) {
    const nlohmann::json graph = json()["graph"];
    ASSERT_EQ(graph["rigs"].size(), 1u);
    for (const auto& move : graph["moves"]) EXPECT_EQ(move["rig"], 0);
    EXPECT_NE(built_.out.find("measured again from the files: "), std::string::npos) << built_.out;
    EXPECT_NE(built_.out.find("; 0 moves dropped"), std::string::npos) << built_.out;

    const auto largest = [&](const nlohmann::json& of) {
        folder_->write("changed.json", of.dump());
        const Result run = run_program({"graph", "info", path("changed.json"), "--json"});
        EXPECT_EQ(run.status, 0) << run.err;
        return nlohmann::json::parse(run.out)["joints"]["pose_distance"]["largest"].get<double>();
    };
    const double as_built = largest(json());
    nlohmann::json changed = json();
    changed["graph"]["rigs"][0]["joints"] = nlohmann::json::array({graph["rigs"][0]["joints"][0]});
    EXPECT_NE(largest(changed), as_built);
    EXPECT_NE(run_program({"graph", "info", path("changed.json")}).out.find("poses compared by 1 joint: Hips\n"),
              std::string::npos);
    const auto info = nlohmann::json::parse(run_program({"graph", "info", path("changed.json"), "--json"}).out);
    EXPECT_EQ(info["rigs"][0]["joints"], nlohmann::json({"Hips"}));
    EXPECT_EQ(info["rigs"][0]["moves"], graph["moves"].size());
    // A file of before they stood there is measured by the joints of its own clips.
    changed = json();
    changed["graph"].erase("rigs");
    for (auto& move : changed["graph"]["moves"]) move.erase("rig");
    EXPECT_EQ(largest(changed), as_built);

    changed = json();
    changed["graph"]["rigs"][0]["joints"][1] = "wing";
    folder_->write("changed.json", changed.dump());
    expect_refused({"graph", "info", path("changed.json")}, "there is no joint 'wing' below its root");
}

TEST_F(GraphTest, ABrokenBoundIsExitStatus1) {
    nlohmann::json broken = json();
    broken["graph"]["bounds"]["pose_distance"] = 0.01;
    folder_->write("pose.json", broken.dump());
    const Result pose = run_program({"graph", "info", path("pose.json")});
    EXPECT_EQ(pose.status, 1);
    EXPECT_TRUE(is_one_line(pose.err)) << pose.err;
    EXPECT_NE(pose.err.find("over the bound of 0.01 m"), std::string::npos) << pose.err;
    EXPECT_FALSE(nlohmann::json::parse(run_program({"graph", "info", path("pose.json"), "--json"}).out)["holds"]);
    broken = json();
    broken["graph"]["moves"][3]["exit"][0] = broken["graph"]["moves"][3]["exit"][0].get<double>() + 0.2;
    folder_->write("speed.json", broken.dump());
    const Result run = run_program({"graph", "info", path("speed.json")});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("the change of the root's velocity is"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("the change of the joint position is"), std::string::npos) << "and bodies jump";
}

TEST_F(GraphTest, TheTurnedMovesOfARunAreMeasuredAsRecorded) {
    const std::string run = path("turned.json");
    ASSERT_EQ(run_program(
                  {"simulate", graph(), "-o", run, "--agents", "30", "--area", "9x9", "--seconds", "10", "--plan", "0"})
                  .status,
              0);
    ASSERT_NE(slurp(run).find("\"turned\""), std::string::npos) << "nobody turns on the way";
    const Result result = run_program({"graph", "info", run, "--json"});
    EXPECT_EQ(result.status, 0) << result.err;
    const auto largest = [](const std::string& info) {
        return nlohmann::json::parse(info)["joints"]["root_speed"]["largest"].get<double>();
    };
    EXPECT_EQ(largest(result.out), largest(run_program({"graph", "info", graph(), "--json"}).out));
}

TEST_F(GraphTest, NoSpeedIsInfinite) {
    const std::string graph =
        R"("graph": {"hubs": [{"name": "h"}], "moves": [{"clip": "c", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [1, 0, 0]}]})";
    const std::string fast = folder_->write(
        "fast.json", R"({"clips": {"c": {"dt": 2.1e-9, "samples": [[-1e9, 0, 1], [1e9, 0, 1]]}}, )" + graph + "}");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"graph", "info", fast}, {"graph", "info", fast, "--json"}, {"info", fast}}) {
        const Result run = run_program(command);
        EXPECT_EQ(run.status, 0) << run.err;
        for (const char* no_number : {" inf", " nan", " -nan", "\"root_speed\": {\"count\": 1, \"median\": null"}) {
            EXPECT_EQ(run.out.find(no_number), std::string::npos) << run.out;
        }
    }
    const std::string damaged =
        folder_->write("damaged.json", R"({"clips": {"c": {"dt": 1e-310, "samples": [[0, 0, 1]]}}, )" + graph + "}");
    for (const std::vector<std::string>& command : {std::vector<std::string>{"graph", "info", damaged},
                                                    {"graph", "draw", damaged, "-o", path("x.png")},
                                                    {"info", damaged},
                                                    {"simulate", damaged, "-o", path("x.json")}}) {
        expect_refused(command, "damaged.json: line 1, /clips/c/dt: dt must be a finite number over 2e-9 s");
    }
    EXPECT_FALSE(std::filesystem::exists(path("x.json")));
    EXPECT_FALSE(std::filesystem::exists(path("x.png")));
}

TEST_F(GraphTest, WithSamplesInsideItStandsAlone) {
    const TempFolder elsewhere;
    const std::string file = elsewhere.path() / "g.json";
    ASSERT_EQ(run_program({"graph", "build", kClips, "--inline", "--moves", "2", "-o", file}).status, 0);
    EXPECT_EQ(slurp(file).find("\"source\""), std::string::npos);
    const Result run = run_program({"graph", "info", file, "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json info = nlohmann::json::parse(run.out);
    EXPECT_TRUE(info["joints"]["pose_distance"]["largest"].is_null());
    EXPECT_GT(info["joints"]["root_speed"]["largest"], 0);
    EXPECT_EQ(info["continuity"]["measured"], 0);
    EXPECT_NE(run_program({"graph", "info", file}).out.find("not measured"), std::string::npos);
}

TEST_F(GraphTest, WholeClipsHaveOneHubAndNoBounds) {
    ASSERT_EQ(run_program({"graph", "build", kClips, "--whole", "-o", path("whole.json")}).status, 0);
    const nlohmann::json whole = nlohmann::json::parse(slurp(path("whole.json")));
    EXPECT_EQ(whole["graph"]["hubs"].size(), 1u);
    EXPECT_EQ(whole["graph"]["moves"].size(), 7u);
    EXPECT_TRUE(whole["graph"]["bounds"]["pose_distance"].is_null());
    const Result run = run_program({"graph", "info", path("whole.json")});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("bound none"), std::string::npos) << run.out;
}

TEST_F(GraphTest, ClipsLeadToTheirFilesFromWhereverTheGraphIs) {
    std::filesystem::create_directories(path("a/b"));
    ASSERT_EQ(run_program({"graph", "build", kClips / "wander.glb", "-o", path("a/b/g.json")}).status, 0);
    EXPECT_EQ(run_program({"graph", "info", path("a/b/g.json")}).status, 0);
}

TEST_F(GraphTest, WhatCannotBeDoneIsSaidInOneLine) {
    const std::string none = path("none.json");
    std::filesystem::create_directory(path("empty"));
    folder_->write("plain.json", R"({"clips": {"c": {"dt": 1, "samples": [[0, 0, 1]]}}})");
    folder_->write("track.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n");
    expect_refused({"graph", "build", path("empty"), "-o", none}, "there are no clips in this folder");
    expect_refused({"graph", "build", path("missing.bvh"), "-o", none}, "no such file");
    expect_refused({"graph", "build", path("plain.json"), "-o", none}, "a graph is built from clip files");
    expect_refused({"graph", "build", path("track.csv"), "-o", none}, "no clip has joints");
    expect_refused({"graph", "build", kClips, "-o", path("none.txt")}, "a graph is written as .json");
    expect_refused({"graph", "build", kClips, "-o", none, "--pose-distance", "0"}, "no pose comes again often enough");
    expect_refused({"graph", "build", kClips, "-o", none, "--seconds", "4:1"}, "--seconds");
    expect_refused({"graph", "build", kClips, "-o", none, "--seconds", "0:1"}, "--seconds");
    expect_refused({"graph", "build", kClips, "-o", none, "--seed", "-1"}, "--seed");
    expect_refused({"graph", "build", kClips, "-o", none, "--seed", "9007199254740993"}, "from 0 to 9007199254740992");
    expect_refused({"graph", "build", kClips, "-o", none, "--hubs", "0"}, "--hubs");
    expect_refused({"graph", "build", kClips, "-o", none, "--root-speed", "x"}, "--root-speed");
    expect_refused({"graph", "build", kClips}, "output");
    expect_refused({"graph", "info", path("plain.json")}, "there is no motion graph in it");
    expect_refused({"graph", "draw", path("plain.json"), "-o", path("x.png")}, "there is no motion graph in it");
    expect_refused({"graph", "draw", graph(), "-o", path("x.jpg")}, "pictures are written as .png, .svg or .pdf");
    expect_refused({"graph"}, "subcommand");
    EXPECT_FALSE(std::filesystem::exists(none));
    EXPECT_FALSE(std::filesystem::exists(path("x.png")));
    expect_refused({"graph", "build", kClips, "--hubs", "1", "-o", path("nowhere/g.json")}, "nowhere", 3);
}

TEST_F(GraphTest, IsDrawnWithoutADisplay) {
    const auto renderer = open_or_skip(Backend::automatic);
    if (!renderer) return;
    for (const std::string size : {"640x360", "300x700", "64x64"}) {
        const Result run =
            run_program({"graph", "draw", graph(), "-o", path("g.png"), "--size", size, "--theme", "light"});
        ASSERT_EQ(run.status, 0) << run.err;
        const Image image = read_png(path("g.png"));
        EXPECT_EQ(std::to_string(image.width) + 'x' + std::to_string(image.height), size);
    }
}

}  // namespace
}  // namespace mobbscope
