/// What is said of an answer is true of two paths that are simple enough to tell.
#include <explain/query_findings.h>
#include <gtest/gtest.h>

#include <memory>

namespace mobbscope {
namespace {

/// Somebody who walks 4 m in 4 s, 10 samples a second, through (2, 0) at 2 s; 0.4 m thick.
Scene two_walkers(double start_b, double rotate_b, glm::dvec2 translate_b) {
    std::vector<mobb::Disk> walk;
    for (int i = 0; i < 40; ++i) walk.push_back({0.1 * i, 0, 0.2});
    Scene scene;
    scene.clips.push_back({"walk", std::nullopt, {}, std::make_shared<const mobb::Clip>(0.1, walk)});
    scene.agents.push_back({"A", 0, {}, std::nullopt});
    scene.agents.push_back({"B", 0, {translate_b, rotate_b, start_b}, std::nullopt});
    return scene;
}

QueryFindings findings_of(const std::shared_ptr<const FittedScene>& fitted) {
    ViewState view;
    view.query = 0;
    return find_out(*fitted, view, record(*fitted, fitted->queries()[0]));
}

std::string all(const QueryFindings& findings) {
    std::string out = answer_words(findings.sides, findings.clearance) + ".";
    for (const std::string& sentence : why_words(findings.sides, findings.clearance, findings.floor)) {
        out += " " + sentence;
    }
    return out;
}

std::string words(double start_b, double rotate_b, glm::dvec2 translate_b) {
    const auto fitted =
        std::make_shared<const FittedScene>(two_walkers(start_b, rotate_b, translate_b), mobb::FitOptions{});
    return all(findings_of(fitted));
}

TEST(WhyWords, PathsThatCrossButNotInTime) {
    // B crosses at right angles through (2, 0), two seconds later.
    const std::string said = words(2, 90, {2, -2});
    EXPECT_NE(said.find("A and B never collide."), std::string::npos) << said;
    EXPECT_NE(said.find("Their paths cross on the floor, but not in time: at the closest, B comes 1.400 s after A has "
                        "gone."),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("They come nearest at"), std::string::npos) << said;
}

TEST(WhyWords, WhoComesLaterIsTold) {
    const std::string said = words(-2, 90, {2, -2});
    EXPECT_NE(said.find("at the closest, A comes 1.400 s"), std::string::npos) << said;
    EXPECT_NE(said.find("after B has gone"), std::string::npos) << said;
}

TEST(WhyWords, PathsThatNeverCross) {
    const std::string said = words(0, 0, {0, 1});
    EXPECT_NE(said.find("Their paths stay 0.600 m apart on the floor, whatever the time."), std::string::npos) << said;
    EXPECT_NE(said.find("They come nearest at 0.000 s: 0.600 m apart."), std::string::npos) << said;
}

TEST(WhyWords, NoCommonTime) {
    const std::string said = words(5, 0, {0, 0});
    EXPECT_NE(said.find("They share no time: B begins 1.000 s after A ends."), std::string::npos) << said;
    EXPECT_EQ(said.find("nearest"), std::string::npos) << said;
}

TEST(WhyWords, ACollision) {
    const std::string said = words(0, 90, {2, -2});
    EXPECT_NE(said.find("They collide at 1."), std::string::npos) << said;
    EXPECT_NE(said.find("Deepest at 2.000 s: 0.400 m."), std::string::npos) << said;
    EXPECT_EQ(said.find("cross on the floor"), std::string::npos) << said;
}

TEST(WhyWords, TheGainCountsWhatTheDirectSearchWouldMeasure) {
    const auto fitted = std::make_shared<const FittedScene>(two_walkers(0, 0, {0, 1}), mobb::FitOptions{});
    const QueryFindings findings = findings_of(fitted);
    EXPECT_EQ(direct_pairs(findings.clearance), 40);
    mobb::Statistics statistics;
    const SceneQuery query = fitted->queries()[0];
    static_cast<void>(ask(*fitted, query, Search::direct, statistics));
    EXPECT_EQ(direct_pairs(findings.clearance), statistics.tests[mobb::TestKind::samples]);
    EXPECT_EQ(gain_words(findings.recursion.total(), findings.clearance),
              "The direct search would measure 40 pairs of samples; this took 2 tests, 20 times fewer.");
}

TEST(WhyWords, TheDirectSearchStopsAtTheFirstHit) {
    const auto fitted = std::make_shared<const FittedScene>(two_walkers(0, 90, {2, -2}), mobb::FitOptions{});
    mobb::Statistics statistics;
    const SceneQuery query = fitted->queries()[0];
    static_cast<void>(ask(*fitted, query, Search::direct, statistics));
    EXPECT_EQ(direct_pairs(findings_of(fitted).clearance), statistics.tests[mobb::TestKind::samples]);
}

}  // namespace
}  // namespace mobbscope
