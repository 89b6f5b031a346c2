// Starts at which doubles cannot hold the samples' times are refused at their place; those that hold them badly are
// warned of.
#include "scene_refusal.h"

#include <import/clip/sample_times.h>
#include <scene/crowd_run.h>
#include <scene/scene.h>
#include <scene/scene_edits.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mobbscope {
namespace {

std::string clip_every(const std::string& dt) {
    return R"("clips": {"c": {"dt": )" + dt + R"(, "samples": [[0, 0, 0.4], [0.1, 0, 0.4]]}})";
}

std::string started_at(const std::string& dt, const std::string& start) {
    return "{" + clip_every(dt) + R"(, "agents": [{"name": "A", "clip": "c", "start": )" + start +
           R"(}, {"name": "B", "clip": "c", "start": )" + start + "}]}";
}

std::string run_of(const std::string& dt, const std::string& start) {
    return "{" + clip_every(dt) + R"(, "graph": {"hubs": [{"name": "a"}],
            "moves": [{"clip": "c", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [0.2, 0, 0]}]},
            "crowd": {"area": [9, 9], "seconds": 1, "seed": 1, "agents": [{"name": "A", "plays": [
                {"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": )" +
           start + "}]}]}}";
}

std::vector<std::string> warnings_of(const std::string& scene) {
    std::vector<std::string> out;
    const Scene read = parse_scene(scene, "s.json", "");
    for (const ImportWarning& warning : read.clips[0].facts.warnings) out.push_back(warning.text);
    return out;
}

TEST(SampleTimes, StartsThatTheyAreLostAtAreRefusedAtTheirPlace) {
    for (const auto& [dt, start] : {std::pair("1e-5", "1e12"), {"1e-4", "-1e12"}, {"1e-8", "1e8"}}) {
        EXPECT_NE(scene_refusal(started_at(dt, start)).find("/agents/0/start: start "), std::string::npos) << dt;
        EXPECT_NE(scene_refusal(run_of(dt, start)).find("/crowd/agents/0/plays/0/start: start "), std::string::npos)
            << scene_refusal(run_of(dt, start));
        const std::string query = "{" + clip_every(dt) + R"(, "agents": [{"name": "A", "clip": "c"}],
            "queries": [{"a": "A", "b": {"clip": "c", "start": )" +
                                  start + "}}]}";
        EXPECT_NE(scene_refusal(query).find("/queries/0/b/start: start "), std::string::npos) << scene_refusal(query);
    }
}

TEST(SampleTimes, ThoseThatAreHeldBadlyAreWarnedOfOnce) {
    for (const auto& [dt, start] : {std::pair("1e-5", "1e10"), {"0.03", "-1e12"}, {"1e-8", "0"}}) {
        for (const std::string& scene : {started_at(dt, start), run_of(dt, start)}) {
            const std::vector<std::string> said = warnings_of(scene);
            const auto is_meant = [](const std::string& text) {
                return text.find(" % of each sample's ") != std::string::npos;
            };
            EXPECT_EQ(std::ranges::count_if(said, is_meant), 1) << dt << " from " << start;
        }
    }
    for (const auto& [dt, start] : {std::pair("0.03", "1e6"), {"1e-5", "1000"}, {"0.0333", "1.7e9"}})
        EXPECT_TRUE(warnings_of(started_at(dt, start)).empty()) << dt << " from " << start;
}

TEST(SampleTimes, AreSaidWithTheirRounding) {
    EXPECT_EQ(coarse_times(1e-5, 1e10, 1),
              "up to 22 % of each sample's 1e-05 s is not sure where it starts at 1e+10 s: doubles tell times apart by "
              "1.9e-06 s there, and what two samples share for at most 1e-9 s is not tested");
    EXPECT_EQ(coarse_times(0.1, 1e5, 1e3), "");
}

TEST(SampleTimes, EditsAreHeldToThem) {
    Scene scene = parse_scene(started_at("1e-5", "0"), "s.json", "");
    EXPECT_THROW(place_agent(scene, 0, {.start = 1e12}), std::invalid_argument);
    EXPECT_THROW(add_agent(scene, 0, {.start = 1e12}), std::invalid_argument);
    EXPECT_EQ(scene.agents.size(), 2u);
    EXPECT_EQ(scene.agents[0].placement.start, 0);
    EXPECT_NO_THROW(place_agent(scene, 0, {.start = 1e9}));
}

TEST(SampleTimes, RowsOfFilesAreHeldToThem) {
    EXPECT_THROW(check_file_times(1e-5, 1e12), std::invalid_argument);
    EXPECT_NO_THROW(check_file_times(0.04, 1.7e9));
    EXPECT_NE(rounded_time_hint(1e12).find("0.00012 s"), std::string::npos) << rounded_time_hint(1e12);
    EXPECT_EQ(rounded_time_hint(1e6), "");
}

}  // namespace
}  // namespace mobbscope
