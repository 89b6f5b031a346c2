// Answers, traces and fits held by a case: what is found, and in which words. Nothing is drawn, so no OpenGL is needed.
#include <base/file.h>
#include <cases/result_line.h>
#include <picture_tests/held_answers.h>
#include <picture_tests/run_cases.h>
#include <support/input_error.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kNumbers{Held::answers, Held::trace, Held::fit};

class HeldAnswersTest : public ::testing::Test {
  protected:
    /// A case that holds no picture; `more` follows its keys.
    CaseFile add(const std::string& hold, const std::string& more = "") const {
        return cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json", "hold": )" + hold +
                                    (more.empty() ? "" : ", " + more) + "}");
    }
    static CaseResult run(const CaseFile& file, const RunOptions& options = {}) {
        return run_case(file, nullptr, "no OpenGL", options);
    }
    /// Runs a case and takes its goldens.
    void take_of(const CaseFile& file) const {
        CaseResult result = run(file);
        ASSERT_EQ(result.outcome, CaseOutcome::missing_golden) << result.message;
        take(result);
        ASSERT_EQ(result.outcome, CaseOutcome::passed);
        ASSERT_EQ(run(file).message, "");
    }
    /// A golden with something else in it.
    void change(const CaseFile& file, Held held, const std::function<void(Json&)>& with) const {
        Json golden = Json::parse(read_file(file.golden_of(held)));
        with(golden);
        write_file(file.golden_of(held), golden.dump());
    }
    void write_scene(const std::function<void(Json&)>& with) const {
        Json scene = Json::parse(mobbscope::testing::kSmallScene);
        with(scene);
        cases.folder().write("scene.json", scene.dump());
    }

    const CaseFolder cases;
};

TEST_F(HeldAnswersTest, NeedNoOpenGL) {
    const CaseFile file = add(R"(["answers", "trace", "fit"])");
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden);
    EXPECT_EQ(result.findings.size(), 3u);
    EXPECT_EQ(result.drawn_by.backend, kDrawsNothing);
    EXPECT_FALSE(lacks_opengl(result));
    EXPECT_TRUE(can_be_taken(result));
    take_of(file);
    for (const Held held : kNumbers) EXPECT_TRUE(std::filesystem::exists(file.golden_of(held))) << name(held);
    EXPECT_FALSE(std::filesystem::exists(file.golden()));
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);

    const CaseResult skipped = run(add(R"(["answers"])", R"("skip": "why")"));
    EXPECT_EQ(skipped.outcome, CaseOutcome::skipped);
    EXPECT_FALSE(lacks_opengl(skipped)) << "that is not the reason";
}

TEST_F(HeldAnswersTest, BesideAPictureTheyAreHeldWithoutOpenGL) {
    const CaseFile file = add(R"(["answers", "picture", "trace"])");
    CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden);
    EXPECT_EQ(result.findings.size(), 2u);
    ASSERT_EQ(result.fresh.size(), 2u) << "of the picture there is nothing to take";
    EXPECT_EQ(result.remarks, std::vector<std::string>{"the picture was not drawn: no OpenGL"});
    EXPECT_PRED2(says, words_on(result, "out"), "\n  the picture was not drawn: no OpenGL\n");
    take(result);
    EXPECT_EQ(result.outcome, CaseOutcome::skipped);
    EXPECT_EQ(result.message, "the picture was not drawn: no OpenGL");

    result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::skipped);
    EXPECT_EQ(result.message, "as in the goldens: answers, trace; the picture was not drawn: no OpenGL");
    EXPECT_TRUE(lacks_opengl(result));
    EXPECT_TRUE(result.remarks.empty() && result.fresh.empty());

    change(file, Held::trace, [](Json& golden) { golden["traces"][0]["trace"][0]["outcome"] = "disjoint_in_time"; });
    result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_PRED2(says, result.message, "a.trace.json: query 0, A and B: ");
    EXPECT_TRUE(lacks_opengl(result) && can_be_taken(result));
    std::stringstream line;
    write_result_line(line, result);
    EXPECT_EQ(read_result_line(line.str(), {file}).not_drawn, "no OpenGL");
}

TEST_F(HeldAnswersTest, OneDigitOfAContactIsFound) {
    const CaseFile file = add(R"(["answers"])");
    take_of(file);
    double time = 0;
    change(file, Held::answers, [&](Json& golden) {
        Json& contact = golden["answers"][0]["contact"];
        ASSERT_TRUE(contact.is_object()) << golden.dump();
        time = contact["time"].get<double>();
        contact["time"] = std::nextafter(time, std::numeric_limits<double>::infinity());
    });
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_PRED2(says, result.message, "a.answers.json: query 0, A and B: they collide at ");
    EXPECT_PRED2(says, result.message, " s instead of ");
    EXPECT_EQ(result.findings.at(0).golden, file.golden_of(Held::answers));
}

TEST_F(HeldAnswersTest, OneTestMoreIsFound) {
    const CaseFile file = add(R"(["answers"])");
    take_of(file);
    int before = 0;
    change(file, Held::answers, [&](Json& golden) {
        Json& tests = golden["answers"][0]["tests"]["time"];
        before = tests.get<int>();
        tests = before - 1;
    });
    EXPECT_PRED2(says, run(file).message,
                 std::to_string(before) + " tests of time instead of " + std::to_string(before - 1));
}

TEST_F(HeldAnswersTest, AFitThatMakesMoreTestsIsFound) {
    take_of(add(R"(["answers", "trace", "fit"])"));
    const CaseResult result = run(add(R"(["answers", "trace", "fit"])", R"("fit": {"leaf": 1, "axes": "covariance"})"));
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    ASSERT_EQ(result.findings.size(), 3u) << result.message;
    EXPECT_PRED2(says, result.findings[0].message, " tests of time instead of ");
    EXPECT_PRED2(says, result.findings[0].message, " times as many)");
    EXPECT_PRED2(says, result.findings[1].message, "a.trace.json: query 0, A and B: the traces differ at step ");
    EXPECT_PRED2(says, result.findings[2].message,
                 "a.fit.json: fit of 'walk': axes covariance instead of endpoints, leaf 1 instead of 2; 15 nodes "
                 "instead of 7");
}

TEST_F(HeldAnswersTest, CollisionsComeFirstThenContactsThenTests) {
    write_scene([](Json& scene) {
        scene["agents"].push_back({{"name", "C"}, {"clip", "walk"}, {"translate", {0.2, 0}}});
        scene["agents"].push_back({{"name", "far"}, {"clip", "walk"}, {"translate", {50, 0}}});
    });
    const CaseFile file = add(R"(["answers"])");
    take_of(file);
    change(file, Held::answers, [](Json& golden) {
        ASSERT_EQ(golden["answers"].size(), 6u);
        golden["answers"][0]["tests"]["time"] = 1;
        golden["answers"][1]["contact"]["distance"] = 9;
        Json& far = golden["answers"][2];
        far["collides"] = true;
        far["contact"] = golden["answers"][1]["contact"];
        golden["answers"][3]["query"] = 9;
    });
    const std::vector<std::string> words = run(file).findings.at(0).words;
    ASSERT_EQ(words.size(), 5u);
    EXPECT_PRED2(says, words[0], "query 2, A and far: no collision; the golden has one at ");
    EXPECT_EQ(words[1], "query 3, B and C: the golden has no such query");
    EXPECT_EQ(words[2], "query 9, B and C: only the golden has it, now it is not asked");
    EXPECT_PRED2(says, words[3], "query 1, A and C: in contact they are apart by ");
    EXPECT_PRED2(says, words[4], "query 0, A and B: ");
}

TEST_F(HeldAnswersTest, NoMoreThanTwelveLinesAreTold) {
    write_scene([](Json& scene) {
        for (const char* name : {"C", "D", "E", "F"})
            scene["agents"].push_back({{"name", name}, {"clip", "walk"}, {"translate", {0.1, 0}}});
    });
    const CaseFile file = add(R"(["answers"])");
    take_of(file);
    change(file, Held::answers, [](Json& golden) { golden["answers"] = Json::array(); });
    const Finding found = run(file).findings.at(0);
    ASSERT_EQ(found.words.size(), 13u);
    EXPECT_EQ(found.words.back(), "and 3 more");
    EXPECT_PRED2(says, found.message, "; and 14 more");
}

TEST_F(HeldAnswersTest, AViewNamesTheQueryThatIsHeld) {
    write_scene([](Json& scene) { scene["agents"].push_back({{"name", "C"}, {"clip", "walk"}}); });
    const auto held = [&](const std::string& more) {
        const CaseFile file = add(R"(["answers"])", more);
        CaseResult result = run(file);
        std::vector<int> out;
        if (result.fresh.empty()) return out;
        const Json golden = Json::parse(*result.fresh.at(0).bytes);
        for (const Json& one : golden["answers"]) out.push_back(one["query"].get<int>());
        return out;
    };
    EXPECT_EQ(held(""), (std::vector{0, 1, 2}));
    EXPECT_EQ(held(R"("view": {"query": 1})"), (std::vector{1}));
    EXPECT_EQ(held(R"("view": {"query": null})"), (std::vector{0, 1, 2}));
    EXPECT_EQ(held(R"("panels": [{"view": {"query": 2}}, {"view": {"query": 0}}])"), (std::vector{0, 2}));
    EXPECT_EQ(held(R"("panels": [{"fit": {"leaf": 1}}, {"view": {"query": 0}}])"), (std::vector{0, 1, 2, 0}));
    EXPECT_PRED2(says, run(add(R"(["answers"])", R"("view": {"query": 7})")).message, "query 7");
}

TEST_F(HeldAnswersTest, EachFitOfThePanelsIsHeld) {
    const std::string panels = R"("panels": [{"title": "coarse"}, {"title": "fine", "fit": {"leaf": 1}}])";
    const CaseFile file = add(R"(["answers", "trace", "fit"])", panels);
    take_of(file);
    change(file, Held::answers, [](Json& golden) {
        ASSERT_EQ(golden["answers"].size(), 2u);
        EXPECT_EQ(golden["answers"][1]["panel"], 1);
        golden["answers"][1]["tests"]["time"] = 1;
    });
    EXPECT_PRED2(says, run(file).message, "panel 'fine', query 0, A and B: ");
    const CaseResult no_title = run(add(R"(["answers"])", R"("panels": [{}, {"fit": {"leaf": 1}}])"));
    EXPECT_PRED2(says, no_title.message, "panel 1, query 0, A and B: ");
    const CaseResult alike = run(add(R"(["fit"])", R"("panels": [{"title": "coarse"}, {"title": "fine"}])"));
    EXPECT_PRED2(says, alike.message, "panel 'fine', fit of 'walk': only the golden has it");
    const CaseResult alone = run(add(R"(["fit"])"));
    EXPECT_PRED2(says, alone.message, "panel 1, fit of 'walk': only the golden has it, now there is no such tree");
}

TEST_F(HeldAnswersTest, NodesMayBeRoundedOtherwise) {
    const CaseFile file = add(R"(["fit"])");
    take_of(file);
    const auto widen = [&](double by) {
        change(file, Held::fit, [&](Json& golden) {
            Json& half = golden["trees"][0]["nodes"][2]["half"][1];
            half = half.get<double>() + by;
        });
    };
    widen(1e-12);
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);
    widen(1e-6);
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_PRED2(says, result.message, "a.fit.json: fit of 'walk': node 2: half[1] ");
}

TEST_F(HeldAnswersTest, ACutTraceIsFound) {
    const CaseFile file = add(R"(["trace"])");
    take_of(file);
    const std::string whole = read_file(file.golden_of(Held::trace));
    for (const std::size_t left : {0u, 1u}) {
        write_file(file.golden_of(Held::trace), whole);
        std::size_t events = 0;
        change(file, Held::trace, [&](Json& golden) {
            Json& trace = golden["traces"][0]["trace"];
            events = trace.size();
            trace.erase(trace.begin() + static_cast<std::ptrdiff_t>(left), trace.end());
        });
        const CaseResult result = run(file);
        EXPECT_EQ(result.outcome, CaseOutcome::different);
        EXPECT_PRED2(says, result.message,
                     "query 0, A and B: the golden has only " + std::to_string(left) + " of " + std::to_string(events) +
                         " events, now there are " + std::to_string(events) + "; it was cut");
    }
}

TEST_F(HeldAnswersTest, TreesAreComparedInPlainWords) {
    const CaseFile file = add(R"(["fit"])");
    take_of(file);
    const std::string whole = read_file(file.golden_of(Held::fit));
    const auto message = [&](const std::function<void(Json&)>& with) {
        write_file(file.golden_of(Held::fit), whole);
        change(file, Held::fit, [&](Json& golden) { with(golden["trees"][0]); });
        return run(file).message;
    };
    EXPECT_PRED2(says, message([](Json& tree) { tree["nodes"][1]["half"] = {1}; }),
                 "node 1: half 2 values instead of 1 value");
    EXPECT_PRED2(says, message([](Json& tree) { tree["nodes"][1]["half"] = "1"; }),
                 "node 1: half 2 values instead of the text '1'");
    EXPECT_PRED2(says, message([](Json& tree) { tree["leaf"] = "2"; }), "leaf 2 instead of the text '2'");
    EXPECT_PRED2(says, message([](Json& tree) { tree["leaf"] = 2.0000000001; }), "leaf 2 instead of 2.0000000001");
    EXPECT_PRED2(says, message([](Json& tree) { tree["nodes"][1]["first"] = 1e-10; }),
                 "node 1: first 0 instead of 1e-10");
    EXPECT_PRED2(says, message([](Json& tree) { tree["nodes"][1]["note"] = 1; }), "unknown key 'note'");
    EXPECT_PRED2(says, message([](Json& tree) { tree["note"] = 1; }), "unknown key 'note'");

    // Boxes of another kind have other members: that alone is told.
    write_file(file.golden_of(Held::fit), whole);
    const std::string other = run(add(R"(["fit"])", R"("fit": {"tree": "umobb"})")).message;
    EXPECT_PRED2(says, other, "tree umobb instead of mobb");
    EXPECT_PRED2(says, other, "node 0: kind obb3d instead of obb2d, and ");
}

TEST_F(HeldAnswersTest, FewerTestsAreTimesFewer) {
    EXPECT_EQ(ratio_words(31, 10), "3.1 times as many");
    EXPECT_EQ(ratio_words(1, 13), "13 times fewer");
    EXPECT_EQ(ratio_words(10, 28), "2.8 times fewer");
    EXPECT_EQ(ratio_words(100, 101), "");
    EXPECT_EQ(ratio_words(0, 5), "");
    const CaseFile file = add(R"(["answers"])");
    take_of(file);
    change(file, Held::answers, [](Json& golden) {
        Json& tests = golden["answers"][0]["tests"]["time"];
        tests = tests.get<int>() * 13;
    });
    EXPECT_PRED2(says, run(file).message, " (13 times fewer)");
}

TEST_F(HeldAnswersTest, ADamagedGoldenIsOneLineAndCanBeTaken) {
    const CaseFile file = add(R"(["answers", "trace", "fit"])");
    take_of(file);
    for (const Held held : kNumbers) {
        const std::string whole = read_file(file.golden_of(held));
        const std::string key = "\"mobbscope_" + std::string(name(held)) + "\"";
        std::string newer = whole;
        newer.replace(newer.find(key), key.size() + 3, key + ": 9");
        for (const std::string& damaged : {std::string(), std::string("{"), std::string("[]"), std::string("{}"),
                                           whole.substr(0, whole.size() / 2), newer}) {
            write_file(file.golden_of(held), damaged);
            CaseResult result = run(file);
            EXPECT_EQ(result.outcome, CaseOutcome::different) << damaged;
            ASSERT_EQ(result.findings.size(), 1u) << result.message;
            EXPECT_PRED2(says, result.message, "the golden cannot be read: ");
            EXPECT_EQ(result.message.find('\n'), std::string::npos);
            take(result);
            EXPECT_EQ(read_file(file.golden_of(held)), whole);
        }
    }
}

TEST_F(HeldAnswersTest, AGoldenIsHeldToItsForm) {
    const CaseFile file = add(R"(["answers", "trace", "fit"])");
    take_of(file);
    const auto message = [&](Held held, const std::function<void(Json&)>& with) {
        const std::string whole = read_file(file.golden_of(held));
        change(file, held, with);
        const std::string out = run(file).message;
        write_file(file.golden_of(held), whole);
        return out;
    };
    const auto twice = [](const char* list) {
        return [list](Json& golden) { golden[list].push_back(golden[list][0]); };
    };
    EXPECT_PRED2(says, message(Held::answers, twice("answers")), "the query is given twice");
    EXPECT_PRED2(says, message(Held::trace, twice("traces")), "the query is given twice");
    EXPECT_PRED2(says, message(Held::fit, twice("trees")), "the tree of 'walk' is given twice");
    EXPECT_PRED2(says, message(Held::answers, [](Json& golden) { golden["answers"][0]["contact"] = nullptr; }),
                 "it does not fit collides");
    EXPECT_PRED2(says, message(Held::fit, [](Json& golden) { golden["trees"][0]["nodes"][0].erase("half"); }), "half");
    EXPECT_PRED2(says, message(Held::trace, [](Json& golden) { golden["traces"][0]["events"] = 0; }), "events");
    EXPECT_PRED2(says, message(Held::trace, [](Json& golden) { golden["traces"][0]["events"] = 1e3 + 0.5; }),
                 "1000.5 is out of range; give a whole number from ");
    const auto first_answer = [&](const std::function<void(Json&)>& with) {
        return message(Held::answers, [&](Json& golden) { with(golden["answers"][0]); });
    };
    EXPECT_PRED2(says, first_answer([](Json& one) { one["tests"]["time"] = one["tests"]["time"].get<int>() + 0.5; }),
                 "give a whole number from 0");
    EXPECT_PRED2(says, first_answer([](Json& one) { one["tests"]["foo"] = 3; }),
                 "'foo' is not a kind of test; give time, obb2d, obb3d, moving, aabb, block or samples");
    EXPECT_PRED2(says, first_answer([](Json& one) { one["tests"].erase("time"); }), "the key 'time' is missing");
    for (const Held held : kNumbers)
        EXPECT_PRED2(says, message(held, [](Json& golden) { golden["note"] = 1; }), "unknown key 'note'");
    EXPECT_PRED2(says, message(Held::trace, [](Json& golden) { golden["traces"][0]["trace"].erase(1); }), "step");
}

TEST_F(HeldAnswersTest, ASceneIsNotItsGolden) {
    const std::string scene = read_file(cases.path() / "scene.json");
    cases.folder().write("b.fit.json", scene);
    const CaseFile file = cases.write("b", R"({"mobbscope_case": 1, "scene": "b.fit.json", "hold": ["fit"]})");
    const CaseResult result = run(file, {.fresh = FreshGoldens::of_all});
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_PRED2(says, result.message, "the case reads b.fit.json, where its golden goes");
    EXPECT_TRUE(result.fresh.empty());
}

TEST_F(HeldAnswersTest, WithoutAQueryThereIsNothingToHold) {
    cases.folder().write("scene.json", R"({"clips": {"walk": {"dt": 1, "samples": [[0, 0, 1]]}}})");
    const CaseResult result = run(add(R"(["answers"])"));
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_PRED2(says, result.message, "the scene has no query whose answer could be held");
    EXPECT_EQ(run(add(R"(["fit"])")).outcome, CaseOutcome::missing_golden);
}

TEST_F(HeldAnswersTest, WhatTheSceneExpectsIsChecked) {
    const CaseFile file = add(R"(["answers"])");
    const auto expect = [&](const char* text) {
        write_scene([&](Json& scene) { scene["queries"] = {{{"a", "A"}, {"b", "B"}, {"expect", Json::parse(text)}}}; });
    };
    expect(R"({"collides": true})");
    take_of(file);
    expect(R"({"collides": false, "tests": {"time": 1000}})");
    CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_TRUE(result.findings[0].golden.empty());
    EXPECT_PRED2(says, result.message, "scene.json: query 0: expected no collision, but A and B collide at ");
    EXPECT_PRED2(says, result.message, "; expected 1000 tests of time, but there are ");
    EXPECT_FALSE(can_be_taken(result)) << "no golden mends it";
    EXPECT_TRUE(result.fresh.empty());

    // With a golden that differs as well, that alone is taken.
    change(file, Held::answers, [](Json& golden) { golden["answers"][0]["tests"]["time"] = 1; });
    result = run(file);
    EXPECT_EQ(result.findings.size(), 2u);
    EXPECT_TRUE(can_be_taken(result));
    take(result);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_PRED2(says, result.message, "expected no collision");
    EXPECT_EQ(run(file).findings.size(), 1u);

    // Each panel's fit.
    expect(R"({"tests": {"obb2d": 0}})");
    const CaseResult panels = run(add(R"(["fit"])", R"("panels": [{}, {"fit": {"leaf": 1}}])"));
    EXPECT_PRED2(says, panels.message, "panel 0, query 0: expected 0 tests of obb2d");
    EXPECT_PRED2(says, panels.findings.at(0).words.at(1), "panel 1, query 0: expected 0 tests of obb2d");
}

TEST_F(HeldAnswersTest, KeysOfPicturesAreRefusedWithoutOne) {
    for (const char* key :
         {R"("size": "160x120")", R"("mask": "m.png")", R"("tolerance": "loose")", R"("window": {})",
          R"("state": false)", R"("view": {"levels": 1})", R"("panels": [{"view": {"labels": false}}])"}) {
        const CaseResult result = run(add(R"(["answers"])", key));
        EXPECT_EQ(result.outcome, CaseOutcome::failed) << key;
        EXPECT_PRED2(says, result.message, "the case holds no picture; remove this") << key;
    }
}

}  // namespace
}  // namespace mobbscope::picture_tests
