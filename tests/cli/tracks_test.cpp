// Tracks in every command: each starts when its first row does, and is where nobody looks for it after its last.
#include "run_program.h"

#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

// As lab/late_start.csv: 1 is there from 0 to 1 s, 2 from 10 to 11 s, in the same place.
const std::string kLateStart =
    "id,t,x,y,r\n1,0,0,0,0.2\n1,0.5,0,0,0.2\n1,1,0,0,0.2\n2,10,0,0,0.2\n2,10.5,0,0,0.2\n2,11,0,0,0.2\n";

/// The same two, as different kinds of files say it. All of their clocks begin at 0 of late_start.csv.
const std::pair<std::string, std::string> kLateStarts[] = {
    {"plain.csv", kLateStart},
    {"id_last.csv",
     "x,y,r,t,id\n0,0,0.2,0,1\n0,0,0.2,0.5,1\n0,0,0.2,1,1\n0,0,0.2,10,2\n0,0,0.2,10.5,2\n0,0,0.2,11,2\n"},
    {"unix.csv",
     "id,t,x,y,r\n1,1700000000,0,0,0.2\n1,1700000000.5,0,0,0.2\n1,1700000001,0,0,0.2\n2,1700000010,0,0,0.2\n"
     "2,1700000010.5,0,0,0.2\n2,1700000011,0,0,0.2\n"},
    {"gaps.csv", "id,t,x,y,r\n1,0,0,0,0.2\n1,1,0,0,0.2\n2,10,0,0,0.2\n2,10.5,0,0,0.2\n2,11,0,0,0.2\n"},
    {"late_first.csv",
     "id,t,x,y,r\n2,10,0,0,0.2\n2,10.5,0,0,0.2\n2,11,0,0,0.2\n1,0,0,0,0.2\n1,0.5,0,0,0.2\n1,1,0,0,0.2\n"},
    {"petrack.txt", "#framerate: 2\n# id frame x/m y/m\n1 4 0 0\n1 5 0 0\n1 6 0 0\n2 24 0 0\n2 25 0 0\n2 26 0 0\n"},
    {"trajnet++.ndjson",
     "{\"scene\": {\"fps\": 2}}\n{\"track\": {\"f\": 0, \"p\": 1, \"x\": 0, \"y\": 0}}\n"
     "{\"track\": {\"f\": 1, \"p\": 1, \"x\": 0, \"y\": 0}}\n{\"track\": {\"f\": 2, \"p\": 1, \"x\": 0, \"y\": 0}}\n"
     "{\"track\": {\"f\": 20, \"p\": 2, \"x\": 0, \"y\": 0}}\n{\"track\": {\"f\": 21, \"p\": 2, \"x\": 0, \"y\": 0}}\n"
     "{\"track\": {\"f\": 22, \"p\": 2, \"x\": 0, \"y\": 0}}\n"},
};

TEST(Tracks, NobodyMeetsWhoIsThereAtAnotherTimeWhateverTheFile) {
    for (const auto& [name, text] : kLateStarts) {
        SCOPED_TRACE(name);
        const TempFolder folder;
        const std::string file = folder.write(name, text);
        EXPECT_EQ(json_of({"conflicts", file})["conflicts"].size(), 0u);
        EXPECT_EQ(json_of({"query", file})["results"][0]["collides"], false);
        const std::string csv = folder.path() / "out.csv";
        const std::string scene = folder.path() / "out.json";
        ASSERT_EQ(run_program({"convert", file, "-o", csv}).status, 0);
        ASSERT_EQ(run_program({"convert", file, "-o", scene}).status, 0);
        for (const std::string& converted : {csv, scene}) {
            EXPECT_EQ(json_of({"conflicts", converted})["conflicts"].size(), 0u) << converted;
            EXPECT_EQ(json_of({"conflicts", converted})["agents"], 2);
        }
        std::map<std::string, double> starts;
        const json agents = json::parse(slurp(scene))["agents"];
        for (const json& agent : agents) starts[agent["name"]] = agent["start"];
        EXPECT_EQ(starts, (std::map<std::string, double>{{"1", 0}, {"2", 10}}));
    }
}

TEST(Tracks, APictureOfAMomentShowsWhoIsThere) {
    for (const auto& [name, text] : kLateStarts) {
        SCOPED_TRACE(name);
        const TempFolder folder;
        const std::string file = folder.write(name, text);
        const auto caption = [&](const std::string& time) {
            const Result run = run_program({"render", file, "--show", "moment", "--time", time, "--view", "top", "-o",
                                            folder.path() / "moment.png", "--size", "320x200", "--draw-list",
                                            folder.path() / "list.json"});
            EXPECT_EQ(run.status, 0) << run.err;
            return slurp(folder.path() / "list.json");
        };
        EXPECT_NE(caption("0.5").find("\"1 at 0.50 s\""), std::string::npos);
        EXPECT_NE(caption("10.5").find("\"2 at 10.50 s\""), std::string::npos);
        EXPECT_NE(caption("5").find("Nobody is on the floor"), std::string::npos);
    }
}

TEST(Tracks, TrimIsOfTheFilesTime) {
    const TempFolder folder;
    for (const auto& [name, text] : kLateStarts) {
        SCOPED_TRACE(name);
        const std::string file = folder.write(name, text);
        const json found = json_of({"conflicts", file, "--trim", "10:11"});
        EXPECT_EQ(found["agents"], 1);
        const json info = json_of({"info", file, "--trim", "10.5:11"})["clips"];
        ASSERT_EQ(info.size(), 1u);
        EXPECT_EQ(info[0]["start"], 10.5);
        EXPECT_EQ(info[0]["samples"], 2);
    }
}

TEST(Tracks, JsonSaysWhatTimeZeroIsInTheFile) {
    const TempFolder folder;
    const std::map<std::string, double> t0{{"plain.csv", 0}, {"unix.csv", 1.7e9}, {"petrack.txt", 2}};
    for (const auto& [name, text] : kLateStarts) {
        if (!t0.contains(name)) continue;
        SCOPED_TRACE(name);
        const std::string file = folder.write(name, text);
        EXPECT_EQ(json_of({"conflicts", file})["t0"], t0.at(name));
        const json clips = json_of({"info", file})["clips"];
        for (const json& clip : clips) EXPECT_EQ(clip["t0"], t0.at(name));
        EXPECT_EQ(json_of({"conflicts", file, "--trim", "0:1"})["t0"], t0.at(name)) << "trim does not change it";
    }
    const json motion = json_of({"info", folder.write("m.csv", "t,x,y,r\n5,0,0,1\n6,0,0,1\n")})["clips"][0];
    EXPECT_TRUE(motion["t0"].is_null());
    EXPECT_TRUE(motion["start"].is_null());
}

TEST(Tracks, ASceneThatNamesOneTrackPlacesItItself) {
    const TempFolder folder;
    folder.write("late.csv", kLateStart);
    const std::string scene = folder.write("s.json", R"({"clips": {"one": {"source": "late.csv", "id": "1"},
        "two": {"source": "late.csv", "id": 2}}, "agents": [{"name": "A", "clip": "one"}, {"name": "B", "clip": "two"}]})");
    EXPECT_EQ(json_of({"conflicts", scene})["conflicts"].size(), 1u) << "both start at 0 there";
    EXPECT_TRUE(json_of({"conflicts", scene})["t0"].is_null());
}

TEST(Tracks, WarningsAreCountedNotALineATrack) {
    const TempFolder folder;
    std::string text = "id,t,x,y,r\n";
    for (int track = 0; track < 40; ++track) {
        for (int row = 0; row < 10; ++row) {
            if (track % 4 == 0 && row > 3 && row < 6 + track / 20) continue;
            const std::string jitter = track % 10 == 3 && row == 5 ? "3" : "";
            text += std::to_string(track) + ',' + std::to_string(row) + '.' + jitter + "0," + std::to_string(row) +
                    ',' + std::to_string(5 * track) + ",0.2\n";
        }
    }
    const std::string file = folder.write("crowd.csv", text);
    const Result run = run_program({"conflicts", file});
    EXPECT_EQ(run.status, 0);
    const std::string head = "mobbscope: warning: " + file + ": ";
    EXPECT_EQ(run.err,
              head + "of 40 clips 10, such as '0': there are gaps, which are filled linearly (25 samples, line 6)\n" +
                  head +
                  "of 40 clips 4, such as '3': the times are not uniform; the path is resampled at 30 fps (line "
                  "35)\n");
    EXPECT_EQ(json_of({"info", file})["clips"][0]["warnings"],
              json::parse(R"x(["there are gaps, which are filled linearly (2 samples, line 6)"])x"));
}

TEST(Tracks, ConvertTellsTheDtOfOneSampleWhereItIsAnother) {
    const TempFolder folder;
    const auto said = [&](const std::string& dt) {
        const std::string scene = folder.write(
            "s.json", R"({"clips": {"a": {"dt": 0.5, "motion": "linear", "samples": [[0,0,1],[1,0,1],[2,0,1]]},
            "b": {"dt": )" +
                          dt + R"(, "motion": "linear", "samples": [[0,0,1]]}}})");
        return run_program({"convert", scene, "-o", folder.path() / "out.csv"}).err;
    };
    EXPECT_EQ(said("0.5"), "");
    EXPECT_NE(said("0.25").find("clip 'b' has one sample, so the CSV does not tell its dt (0.25 s)"),
              std::string::npos);
}

TEST(Tracks, StartsStayInACsvOfASceneOfWhichSomebodyIsMoved) {
    const TempFolder folder;
    const std::string scene = folder.write("s.json", R"({"clips": {"a": {"dt": 1, "samples": [[0,0,1],[0,0,1]]},
        "b": {"dt": 1, "samples": [[9,0,1],[9,0,1]]}}, "agents": [{"name": "a", "clip": "a", "start": 0},
        {"name": "b", "clip": "b", "start": 5, "translate": [1, 0]}]})");
    const std::string csv = (folder.path() / "s.csv").string();
    const Result run = run_program({"convert", scene, "-o", csv, "--motion", "linear"});
    EXPECT_EQ(run.status, 0);
    EXPECT_NE(run.err.find("1 agent is moved or turned, which a CSV does not hold"), std::string::npos) << run.err;
    EXPECT_NE(slurp(csv).find("\nb,5,9,0,1\n"), std::string::npos) << slurp(csv);
}

TEST(Tracks, WhatIsWorkedOutOfNoColumnIsRefusedInOneLine) {
    const TempFolder folder;
    const std::string csv = folder.write("b.csv", "id,t,x,y,r\n1,0,0,0,1\n1,1,1,0,1\n");
    for (const char* const columns : {"r=-1", "t=1/0", "x=0/0"}) {
        const Result run = run_program({"conflicts", csv, "--columns", columns});
        EXPECT_EQ(run.status, 2) << columns;
        EXPECT_NE(run.err.find("b.csv: line 2: "), std::string::npos) << run.err;
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
    }
}

TEST(Tracks, AChosenColumnKeepsTheUnitThatItsNameSays) {
    const TempFolder folder;
    const std::string mixed = folder.write("u.csv", "id,t_ms,X_m,y_cm\n1,0,0,0\n1,1000,1,0\n2,0,1,0\n2,1000,0,0\n");
    for (const char* const columns : {"x=X_m", "t=t_ms", "y=y_cm,x=X_m"}) {
        const json found = json_of({"conflicts", mixed, "--columns", columns});
        ASSERT_EQ(found["conflicts"].size(), 1u) << columns;
        EXPECT_NEAR(found["conflicts"][0]["intervals"][0][0].get<double>(), 0.3, 1e-9) << columns;
    }
}

TEST(Tracks, PlacesOfMapsAreToldToTheCentimetre) {
    const TempFolder folder;
    for (const auto& [x, y, place] : std::vector<std::tuple<std::string, std::string, std::string>>{
             {"450125.9", "5654321.4", "(450125.9, 5654321.4)"},
             {"-450125.97", "-5654321.43", "(-450125.97, -5654321.43)"},
             {"12345678.01", "0", "(12345678.01, 0)"},
             {"999999.999", "1000000", "(999999.999, 1000000)"},
             {"0.125", "-0.25", "(0.125, -0.25)"}}) {
        std::string text = "id,t,x,y,r\n";
        for (const char* row : {"a,0,", "a,1,", "b,0,", "b,1,"}) text += row + x + ',' + y + ",0.2\n";
        const Result run = run_program({"conflicts", folder.write("map.csv", text)});
        EXPECT_NE(run.out.find(" near " + place + ", samples"), std::string::npos) << run.out;
    }
}

// The inputs of lab/README.md, and what a user of pandas or PedPy expects of them.
class Lab : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no test data at " << kFolder;
    }
    static std::string file(const std::string& name) { return (kFolder / name).string(); }

    inline static const std::filesystem::path kFolder = kSharedData / "lab";
};

TEST_F(Lab, LateStartIsAnsweredAsTheOneHere) {
    EXPECT_EQ(slurp(file("late_start.csv")).size(), 122u);
    EXPECT_EQ(json_of({"conflicts", file("late_start.csv")})["conflicts"].size(), 0u);
    EXPECT_EQ(json_of({"conflicts", file("late_start.csv"), "--trim", "10:11"})["agents"], 1);
}

TEST_F(Lab, RowsWithoutTimesAreRefusedOrSaidToStartTogether) {
    const Result without = run_program({"conflicts", file("id_x_y.csv"), "--radius", "0.2"});
    EXPECT_EQ(without.status, 2);
    EXPECT_TRUE(is_one_line(without.err)) << without.err;
    const Result with = run_program({"conflicts", file("id_x_y.csv"), "--dt", "0.1", "--radius", "0.2"});
    EXPECT_EQ(with.status, 0);
    EXPECT_TRUE(is_one_line(with.err)) << with.err;
    EXPECT_NE(with.err.find("all tracks start together"), std::string::npos);
}

TEST_F(Lab, ATrackOfOneRowTakesTheFilesStep) {
    const json found = json_of({"conflicts", file("one_row_track.csv")});
    ASSERT_EQ(found["conflicts"].size(), 1u);
    // 1 goes on at 2.5 m/s from where 2 stands for 0.4 s.
    const json& interval = found["conflicts"][0]["intervals"][0];
    EXPECT_NEAR(interval[0].get<double>(), 0.4, 1e-12);
    EXPECT_NEAR(interval[1].get<double>(), 0.56, 1e-12);
}

TEST_F(Lab, PlacesInUtmAreToldToTheCentimetre) {
    const Result run = run_program({"conflicts", file("utm.csv")});
    EXPECT_NE(run.out.find("near (450125.9, 5654321.4)"), std::string::npos) << run.out;
}

TEST_F(Lab, TheLeaderIsNotRunIntoAfterItHasLeft) {
    EXPECT_EQ(json_of({"conflicts", file("leader_leaves.csv")})["conflicts"].size(), 0u);
}

/// Who is there, and from when, and whom they meet.
struct CrowdAnswer {
    std::map<std::string, double> starts;
    std::map<std::pair<std::string, std::string>, std::vector<double>> meetings;  ///< ends of intervals
};

CrowdAnswer answer_of(const std::string& file, const std::vector<std::string>& options) {
    const auto with = [&](const std::string& command) {
        std::vector<std::string> arguments{command, file};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return json_of(arguments);
    };
    CrowdAnswer out;
    if (file.ends_with(".json")) {
        const json agents = json::parse(slurp(file))["agents"];
        for (const json& agent : agents) out.starts[agent["name"]] = agent["start"];
    } else {
        const json clips = with("info")["clips"];
        for (const json& clip : clips) out.starts[clip["name"]] = clip["start"];
    }
    const json found = with("conflicts");
    EXPECT_EQ(found["agents"], out.starts.size());
    for (const json& conflict : found["conflicts"]) {
        std::vector<double>& ends = out.meetings[{conflict["a"], conflict["b"]}];
        for (const json& interval : conflict["intervals"]) {
            ends.push_back(interval[0]);
            ends.push_back(interval[1]);
        }
    }
    return out;
}

void expect_same_crowd(const CrowdAnswer& a, const CrowdAnswer& b) {
    ASSERT_EQ(a.starts.size(), b.starts.size());
    for (const auto& [name, start] : a.starts) EXPECT_NEAR(start, b.starts.at(name), 1e-9) << name;
    ASSERT_EQ(a.meetings.size(), b.meetings.size());
    for (const auto& [pair, ends] : a.meetings) {
        ASSERT_TRUE(b.meetings.contains(pair)) << pair.first << ' ' << pair.second;
        const std::vector<double>& others = b.meetings.at(pair);
        ASSERT_EQ(ends.size(), others.size());
        for (std::size_t i = 0; i < ends.size(); ++i) EXPECT_NEAR(ends[i], others[i], 1e-9);
    }
}

TEST(Tracks, EveryTrajectoryFileIsTheSameThroughConvert) {
    const std::filesystem::path data = kSharedData / "trajectories";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no test data at " << data;
    const TempFolder folder;
    int files = 0;
    std::size_t met = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data)) {
        if (!entry.is_regular_file()) continue;
        const std::string file = entry.path().string();
        SCOPED_TRACE(entry.path().filename());
        // Pixels are less than metres, and a CSV of them is refused until somebody insists.
        const bool in_pixels = file.find("sdd_") != std::string::npos;
        const std::vector<std::string> radius{"--radius", in_pixels ? "10" : "0.3"};
        const std::vector<std::string> insist =
            in_pixels ? std::vector<std::string>{"--unit", "m", "--keep-jumps"} : std::vector<std::string>{};
        const CrowdAnswer here = answer_of(file, radius);
        std::string from = file;
        for (const std::string to : {"a.json", "b.csv", "c.json", "d.csv"}) {
            std::vector<std::string> convert{"convert", from, "-o", folder.path() / to};
            if (from == file) convert.insert(convert.end(), radius.begin(), radius.end());
            if (from.ends_with(".csv")) convert.insert(convert.end(), insist.begin(), insist.end());
            const Result converted = run_program(convert);
            ASSERT_EQ(converted.status, 0);
            EXPECT_EQ(converted.err.find("give --unit m") != std::string::npos, in_pixels && to.ends_with(".csv"))
                << converted.err;
            from = folder.path() / to;
            expect_same_crowd(here, answer_of(from, to.ends_with(".csv") ? insist : std::vector<std::string>{}));
        }
        EXPECT_TRUE(slurp(folder.path() / "b.csv") == slurp(folder.path() / "d.csv"));
        met += here.meetings.size();
        ++files;
    }
    EXPECT_EQ(files, 9);
    EXPECT_GT(met, 200u);
}

}  // namespace
}  // namespace mobbscope
