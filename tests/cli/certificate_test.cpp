// Proofs of answers: what query writes and says, and what verify takes and refuses.
#include "run_program.h"

#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

/// A passes between B, whom it misses, and C, whom it meets.
class Certificates : public ::testing::Test {
  protected:
    Certificates() {
        folder.write("scene.json", R"({"clips": {
            "walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [0.3, 0, 0.4], [0.6, 0, 0.4], [0.9, 0, 0.4]]},
            "stand": {"dt": 2, "samples": [[0, 0, 0.3]]}},
            "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "stand", "translate": [0, 1.0005]},
                       {"name": "C", "clip": "stand", "translate": [1.5, 0]}],
            "queries": [{"a": "A", "b": "B"}, {"a": "A", "b": "C"}]})");
        const Result run = run_program({"query", path("scene.json"), "--certificate", path("proof.json")});
        EXPECT_EQ(run.status, 0) << run.err;
        proof = json::parse(slurp(folder.path() / "proof.json"));
    }

    std::string path(const std::string& name) const { return folder.path() / name; }
    Result verify(const std::string& text) {
        folder.write("changed.json", text);
        return run_program({"verify", path("scene.json"), path("changed.json")});
    }
    Result verify_changed(const std::function<void(json&)>& change) {
        json changed = proof;
        change(changed);
        return verify(changed.dump());
    }
    /// Refused in a line that says so and names the file.
    void expect_refused(const Result& run, int status, const std::string& says) {
        SCOPED_TRACE(says);
        EXPECT_EQ(run.status, status);
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
        EXPECT_NE(run.err.find("changed.json"), std::string::npos) << run.err;
    }

    TempFolder folder;
    json proof;
};

TEST_F(Certificates, AreWrittenAsTheFormatSays) {
    EXPECT_EQ(keys(proof), (std::set<std::string>{"mobbscope_certificate", "queries"}));
    EXPECT_EQ(proof["mobbscope_certificate"], 1);
    ASSERT_EQ(proof["queries"].size(), 2u);
    const json& miss = proof["queries"][0];
    EXPECT_EQ(keys(miss), (std::set<std::string>{"query", "a", "b", "collides", "contact", "tiles", "margins"}));
    EXPECT_EQ(miss["a"], "A");
    EXPECT_EQ(miss["collides"], false);
    EXPECT_TRUE(miss["contact"].is_null());
    ASSERT_EQ(miss["tiles"].size(), 1u);
    EXPECT_EQ(keys(miss["tiles"][0]), (std::set<std::string>{"t0", "t1", "direction", "speed", "gap"}));
    EXPECT_NEAR(miss["tiles"][0]["gap"], 0.3005, 1e-4);
    EXPECT_EQ(keys(miss["margins"]), (std::set<std::string>{"growth", "shift_in_time", "free_region", "bounded"}));
    EXPECT_NEAR(miss["margins"]["growth"], 0.15025, 1e-4);
    EXPECT_TRUE(miss["margins"]["shift_in_time"].is_null()) << "any";
    EXPECT_EQ(miss["margins"]["bounded"], false);
    const json& hit = proof["queries"][1];
    EXPECT_EQ(hit["contact"]["time"], 1.5);
    EXPECT_NEAR(hit["tiles"][0]["t1"], 1.5, 1e-8);
    EXPECT_TRUE(hit["margins"].is_null());
}

TEST_F(Certificates, AreTaken) {
    const Result run = verify(proof.dump());
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_NE(
        run.out.find("0: A and B never collide. Proven bound: at least 0.300 m apart. Proof: 1 line over 2.000 s.\n"),
        std::string::npos)
        << run.out;
    EXPECT_NE(run.out.find("No contact before 1.500 s. Proof: 1 line over 1.500 s.\n"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("2 of 2 queries proven\n"), std::string::npos) << run.out;
    // Some alone, and from standard input.
    EXPECT_NE(verify_changed([](json& j) { j["queries"].erase(0); }).out.find("1 of 2 queries proven\n"),
              std::string::npos);
    EXPECT_EQ(run_program({"verify", path("scene.json"), "-"}, {}, folder.path() / "proof.json").status, 0);
    EXPECT_EQ(verify_changed([](json& j) {
                  j["queries"][0]["tiles"][0].erase("speed");
                  j["queries"][0].erase("margins");
              }).status,
              0);
}

TEST_F(Certificates, GoToAPipeToo) {
    const Result run = run_program({"query", path("scene.json"), "--json", "--certificate", "/dev/stderr"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(json::parse(run.err), proof);
    EXPECT_EQ(json::parse(run.out)["results"].size(), 2u);
}

TEST_F(Certificates, ThatProveNothingAreRefusedWithStatusOne) {
    const auto tile = [](json& j) -> json& { return j["queries"][0]["tiles"][0]; };
    expect_refused(verify_changed([&](json& j) { tile(j)["gap"] = 0.31; }), 1, "query 0 is not proven: tile 0");
    expect_refused(verify_changed([&](json& j) { tile(j)["t1"] = 1.0; }), 1, "nothing is said of samples 2 and 0");
    expect_refused(verify_changed([](json& j) { j["queries"][0]["tiles"] = json::array(); }), 1, "nothing is said");
    expect_refused(verify_changed([&](json& j) { tile(j)["direction"] = {0, -1}; }), 1, "a disk passes its line");
    expect_refused(verify_changed([&](json& j) { tile(j)["direction"] = {0, 1.1}; }), 1, "no unit vector");
    expect_refused(verify_changed([&](json& j) { tile(j)["speed"] = 9; }), 1, "a disk passes its line");
    expect_refused(verify_changed([](json& j) { j["queries"][1]["contact"]["time"] = 1.4; }), 1, "the contact begins");
    expect_refused(verify_changed([](json& j) {
                       j["queries"][1]["contact"] = nullptr;
                       j["queries"][1]["collides"] = false;
                   }),
                   1, "nothing is said");
    // The other proof is told all the same.
    EXPECT_NE(verify_changed([&](json& j) { tile(j)["gap"] = 1; }).out.find("1 of 2 queries proven"),
              std::string::npos);
}

TEST_F(Certificates, ThatAreNoneAreRefusedWithStatusTwo) {
    const std::string text = proof.dump(1);
    expect_refused(verify(text.substr(0, text.size() / 2)), 2, "line");
    expect_refused(verify(""), 2, "changed.json");
    expect_refused(verify("[]"), 2, "is no certificate");
    expect_refused(verify(slurp(folder.path() / "scene.json")), 2, "is no certificate");
    expect_refused(verify(std::string(100'000, '[')), 2, "deep");
    const auto tile = [](json& j) -> json& { return j["queries"][0]["tiles"][0]; };
    const std::vector<std::pair<std::function<void(json&)>, std::string>> changes{
        {[](json& j) { j["mobbscope_certificate"] = 2; }, "newer version"},
        {[](json& j) { j["mobbscope_certificate"] = "1"; }, "/mobbscope_certificate"},
        {[](json& j) { j.erase("queries"); }, "queries"},
        {[](json& j) { j["queries"] = 7; }, "/queries"},
        {[](json& j) { j["queries"][0]["query"] = 2; }, "the scene has 2 queries"},
        {[](json& j) { j["queries"][0]["query"] = -1; }, "/queries/0/query"},
        {[](json& j) { j["queries"][0]["query"] = 0.5; }, "/queries/0/query"},
        {[](json& j) { j["queries"].push_back(j["queries"][0]); }, "is given twice"},
        {[](json& j) { j["queries"][0]["b"] = "C"; }, "it is about 'C', and the scene's query about 'B'"},
        {[](json& j) { j["queries"][0]["collides"] = true; }, "/queries/0/collides"},
        {[](json& j) { j["queries"][0].erase("contact"); }, "contact"},
        {[](json& j) { j["queries"][1]["contact"]["a_sample"] = 4; }, "/queries/1/contact"},
        {[&](json& j) { tile(j).erase("gap"); }, "gap"},
        {[&](json& j) { tile(j)["gap"] = nullptr; }, "/queries/0/tiles/0/gap"},
        {[&](json& j) { tile(j)["gap"] = 1e300; }, "/queries/0/tiles/0/gap"},
        {[&](json& j) { tile(j)["speed"] = -1e300; }, "/queries/0/tiles/0/speed"},
        {[&](json& j) { tile(j)["t1"] = 1e30; }, "/queries/0/tiles/0/t1"},
        {[&](json& j) { tile(j)["t1"] = tile(j)["t0"]; }, "it ends before it begins"},
        {[&](json& j) { tile(j)["direction"] = {1}; }, "/queries/0/tiles/0/direction"},
        {[&](json& j) {
             tile(j)["direction"] = {1, "0"};
         },
         "/queries/0/tiles/0/direction/1"},
        {[&](json& j) { j["queries"][0]["tiles"].push_back(tile(j)); }, "begins before the one before it ends"},
    };
    for (const auto& [change, says] : changes) expect_refused(verify_changed(change), 2, says);
    std::string nan = text;
    nan.replace(nan.find("\"gap\": ") + 7, 3, "NaN");
    expect_refused(verify(nan), 2, "line");
    std::string huge = text;
    huge.replace(huge.find("\"gap\": ") + 7, 3, "1e999");
    expect_refused(verify(huge), 2, "line");
}

TEST_F(Certificates, AreOfOneSceneAlone) {
    EXPECT_EQ(run_program({"verify", path("scene.json"), path("none.json")}).status, 2);
    EXPECT_EQ(run_program({"verify", path("scene.json")}).status, 2);
    const Result wrong = run_program({"verify", kScenes / "circles.json", path("proof.json")});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_TRUE(is_one_line(wrong.err)) << wrong.err;
}

TEST_F(Certificates, AreSaidInWords) {
    const Result run = run_program({"query", path("scene.json"), "--proof"});
    EXPECT_EQ(run.status, 0);
    EXPECT_NE(run.out.find(
                  "0: A and B never collide.\n   Proven bound: at least 0.300 m apart. Proof: 1 line over 2.000 s; the "
                  "trees needed 1 box pair.\n   Both radii may grow by 0.150 m; B may start at any time.\n"
                  "   Tests: "),
              std::string::npos)
        << run.out;
    EXPECT_NE(run.out.find("   No contact before 1.500 s. Proof: 1 line over 1.500 s; the trees needed 1 run of "
                           "samples.\n   Tests: "),
              std::string::npos)
        << run.out;
    EXPECT_EQ(run_program({"query", path("scene.json")}).out.find("Proof"), std::string::npos);
    EXPECT_EQ(run_program({"query", path("scene.json"), "--proof", "--json"}).status, 2);
}

}  // namespace
}  // namespace mobbscope
