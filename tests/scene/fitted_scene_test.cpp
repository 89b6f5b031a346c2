#include <scene/answer.h>
#include <scene/fitted_scene.h>

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace mobbscope {
namespace {

Scene head_on() {
    return parse_scene(R"({"clips": {"walk": {"dt": 0.5, "samples":
        [[0,0,0.4],[0.5,0,0.4],[1,0,0.4],[1.5,0,0.4],[2,0,0.4],[2.5,0,0.4],[3,0,0.4],[3.5,0,0.4]]}},
        "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [4, 0.1], "rotate_deg": 180}]})",
                       "s.json", "");
}

TEST(FittedScene, TheRecordIsTheAnswer) {
    const Scene scene = head_on();
    const FittedScene fitted(scene, {mobb::TreeKind::umobb, 2, 0, mobb::Axes::endpoints, 1});
    ASSERT_EQ(fitted.queries().size(), 1u);
    const RecordedQuery recorded = record(fitted, fitted.queries()[0]);
    const auto a = fitted.placed(fitted.queries()[0].a);
    const auto b = fitted.placed(fitted.queries()[0].b);
    ASSERT_TRUE(recorded.contact);
    EXPECT_EQ(recorded.contact, mobb::direct_search(a.placed_clip(), b.placed_clip()));
    mobb::Statistics statistics;
    mobb::query(a, b, statistics);
    EXPECT_EQ(recorded.tests, statistics.tests);
    EXPECT_EQ(recorded.trace[recorded.trace.size() - 1].outcome, mobb::Outcome::hit);
}

TEST(FittedScene, WhatIsSharedTakesNoMemoryTwice) {
    const Scene scene = head_on();
    const FittedScene fitted(scene, {.leaf = 1});
    EXPECT_EQ(fitted.bytes_beyond(fitted.fits()), 0u);
    const FittedScene moved(scene, {.leaf = 1}, &fitted);
    EXPECT_EQ(moved.fits(), fitted.fits());
    const FittedScene refitted(scene, {.leaf = 2}, &fitted);
    EXPECT_GE(refitted.bytes_beyond(fitted.fits()), refitted.tree(0).nodes().size_bytes());
    const FittedScene other(head_on(), {.leaf = 2});
    EXPECT_EQ(other.bytes_beyond(fitted.fits()),
              refitted.bytes_beyond(fitted.fits()) + scene.clips[0].clip->samples().size_bytes());
}

TEST(FittedScene, HoldsSeveralFitsOfOneScene) {
    const FittedScene mobb(head_on(), {.leaf = 1});
    const mobb::FitOptions tilted{mobb::TreeKind::umobb, 1, 0, mobb::Axes::endpoints, 1};
    const FittedScene both = mobb.with_fit("tilted", tilted);
    ASSERT_EQ(both.fits().size(), 2u);
    EXPECT_EQ(both.fit_in_use(), 0u);
    EXPECT_EQ(&both.tree(0), &mobb.tree(0));
    EXPECT_EQ(&both.scene(), &mobb.scene());

    const FittedScene umobb = both.using_fit(1);
    EXPECT_EQ(umobb.options(), tilted);
    EXPECT_EQ(umobb.fits()[1]->name, "tilted");
    EXPECT_EQ(&umobb.placed(umobb.placed_agents()[0]).tree(), &umobb.tree(0));
    EXPECT_EQ(record(umobb, umobb.queries()[0]).contact, record(both, both.queries()[0]).contact);
    EXPECT_GT(record(umobb, umobb.queries()[0]).tests[mobb::BoxKind::obb3d], 0);
    EXPECT_EQ(record(both, both.queries()[0]).tests[mobb::BoxKind::obb3d], 0);

    // A scene made of this one shares the trees of all its fits.
    EXPECT_EQ(&FittedScene(mobb.scene(), tilted, &both).tree(0), &umobb.tree(0));
    EXPECT_EQ(&mobb.with_fit("again", tilted, std::vector{&both}).using_fit(1).tree(0), &umobb.tree(0));
    EXPECT_EQ(both.bytes_beyond(mobb.fits()), umobb.tree(0).bytes());

    EXPECT_THROW(static_cast<void>(both.with_fit("tilted", tilted)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(both.with_fit("", tilted)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(both.with_fit("no", {.leaf = -1})), std::invalid_argument);
}

TEST(FittedScene, PairsAreCountedThrough) {
    for (const int agents : {0, 1, 2, 3, 7, 50}) {
        Scene scene = head_on();
        scene.agents.assign(static_cast<std::size_t>(agents), scene.agents[0]);
        std::size_t index = 0;
        for (int a = 0; a < agents; ++a) {
            for (int b = a + 1; b < agents; ++b, ++index) {
                const SceneQuery query = query_at(scene, index);
                ASSERT_EQ(query.a.agent, a) << index;
                ASSERT_EQ(query.b.agent, b) << index;
            }
        }
        EXPECT_EQ(query_count(scene), index);
    }
}

TEST(FittedScene, ACrowdIsFittedWithoutItsMillionsOfPairs) {
    Scene scene = head_on();
    scene.agents.assign(3000, scene.agents[0]);
    const auto memory = [] {
        struct rusage usage {};
        ::getrusage(RUSAGE_SELF, &usage);
        return usage.ru_maxrss;
    };
    const long before = memory();
    std::vector<std::size_t> fits;
    const FittedScene fitted(scene, scene.fit, nullptr, [&](std::size_t done, std::size_t) { fits.push_back(done); });
    EXPECT_EQ(fits, std::vector<std::size_t>{1});
    EXPECT_LT(memory() - before, 20'000) << "KiB";
    ASSERT_EQ(fitted.queries().size(), 4'498'500u);
    EXPECT_EQ(fitted.queries()[4'498'499].a.agent, 2998);
    EXPECT_EQ(fitted.queries()[4'498'499].b.agent, 2999);
}

TEST(FittedScene, TheDirectSearchIsRecordedToo) {
    const FittedScene fitted(head_on(), {});
    const RecordedQuery direct = record(fitted, fitted.queries()[0], Search::direct);
    EXPECT_EQ(direct.contact, record(fitted, fitted.queries()[0]).contact);
    EXPECT_EQ(direct.tests[mobb::TestKind::time], 0);
    EXPECT_EQ(direct.trace.size(), 1);
}

TEST(FittedScene, WhoeverAsksForAQuerysRecordGetsTheOneThatIsHeld) {
    const FittedScene fitted(head_on(), {});
    const auto first = fitted.recorded(0);
    const FittedScene copy = fitted;
    EXPECT_EQ(copy.recorded(0), first);
    const FittedScene other = fitted.with_fit("other", {.tree = mobb::TreeKind::umobb}).using_fit(1);
    const auto others = other.recorded(0);
    EXPECT_NE(others, first) << "other trees make other tests";
    EXPECT_EQ(others->tests, record(other, other.queries()[0]).tests);
    EXPECT_EQ(fitted.recorded(0), first);
    EXPECT_EQ(first->tests, first->trace.counts());
}

TEST(FittedScene, AnAnswerSaysWhereRecordingStopped) {
    const FittedScene fitted(head_on(), {.leaf = 1});
    const SceneQuery query = fitted.queries()[0];
    const auto json = [&](const mobb::TraceBound& bound) {
        RecordedQuery recorded = record(fitted, query, Search::trees, bound);
        Answer answer;
        answer.contact = recorded.contact;
        answer.tests = recorded.tests;
        answer.trace = std::move(recorded.trace);
        std::ostringstream text;
        JsonWriter out(text);
        out.begin_object();
        write_answer(out, 0, query, answer);
        out.end_object();
        return nlohmann::json::parse(text.str());
    };
    const auto whole = json({});
    EXPECT_FALSE(whole.contains("recorded") || whole.contains("events"));
    const auto stopped = json({.events = 5});
    EXPECT_EQ(stopped["recorded"], 5);
    EXPECT_EQ(stopped["trace"].size(), 5u);
    EXPECT_EQ(stopped["events"], whole["trace"].size());
    EXPECT_EQ(stopped["contact"], whole["contact"]);
    EXPECT_EQ(stopped["tests"], whole["tests"]);
}

TEST(FittedScene, OptionsOutOfRangeAreRefused) {
    mobb::FitOptions options;
    options.leaf = 0;
    EXPECT_THROW(FittedScene(head_on(), options), std::invalid_argument);
}

TEST(FittedScene, MovingAnAgentFitsNothing) {
    Scene scene = head_on();
    scene.clips.push_back(scene.clips[0]);
    scene.clips[1].name = "long";
    std::vector<mobb::Disk> samples(42 * 30);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = {0.04 * static_cast<double>(i), 0, 0.4};
    scene.clips[1].clip = std::make_shared<const mobb::Clip>(1 / 30.0, samples);
    const FittedScene before(scene, scene.fit);

    scene.agents[0].placement = {{3, 4}, 90, 2};
    const FittedScene after(scene, scene.fit, &before);
    for (const int clip : {0, 1}) EXPECT_EQ(&after.tree(clip), &before.tree(clip));
    EXPECT_EQ(after.placed(after.placed_agents()[0]).placed_clip().placement().start, 2);

    // Other options or another clip, though an equal one, is another tree.
    mobb::FitOptions finer = scene.fit;
    finer.leaf = 2;
    EXPECT_NE(&FittedScene(scene, finer, &before).tree(1), &before.tree(1));
    scene.clips[1].clip = std::make_shared<const mobb::Clip>(1 / 30.0, samples);
    const FittedScene changed(scene, scene.fit, &before);
    EXPECT_EQ(&changed.tree(0), &before.tree(0));
    EXPECT_NE(&changed.tree(1), &before.tree(1));
    EXPECT_EQ(&changed.tree(1).clip(), scene.clips[1].clip.get());
}

TEST(FittedScene, SharedTreesOutliveTheSceneTheyCameFrom) {
    const Scene scene = head_on();
    auto before = std::make_unique<FittedScene>(scene, scene.fit);
    const FittedScene after(scene, scene.fit, before.get());
    before.reset();
    EXPECT_EQ(after.tree(0).nodes()[0].count, 8);
}

struct Cancelled {};

TEST(FittedScene, ProgressIsToldAndMayCancel) {
    Scene scene = head_on();
    scene.clips.resize(3, scene.clips[0]);
    std::vector<std::size_t> told;
    const FittedScene fitted(scene, scene.fit, nullptr, [&](std::size_t done, std::size_t all) {
        EXPECT_EQ(all, 3u);
        told.push_back(done);
    });
    EXPECT_EQ(told, (std::vector<std::size_t>{1, 2, 3}));
    EXPECT_THROW(FittedScene(scene, scene.fit, nullptr, [](std::size_t, std::size_t) { throw Cancelled(); }),
                 Cancelled);
}

TEST(Scene, ReadingTellsItsProgressAndMayBeCancelled) {
    const char* text = R"({"clips": {"a": {"dt": 1, "samples": [[0,0,1]]}, "b": {"dt": 1, "samples": [[0,0,1]]}}})";
    std::vector<std::size_t> told;
    parse_scene(text, "s.json", "", {}, [&](std::size_t done, std::size_t all) {
        EXPECT_EQ(all, 2u);
        told.push_back(done);
    });
    EXPECT_EQ(told, (std::vector<std::size_t>{0, 1}));
    EXPECT_THROW(parse_scene(text, "s.json", "", {}, [](std::size_t, std::size_t) { throw Cancelled(); }), Cancelled);
}

}  // namespace
}  // namespace mobbscope
