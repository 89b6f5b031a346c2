// What is written is read back as the same scene, bit for bit.
#include <scene/crowd_run.h>
#include <scene/fitted_scene.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>
#include <scene/view_options.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace mobbscope {
namespace {

/// Numbers with all their digits.
Scene random_scene(std::mt19937_64& random) {
    std::uniform_real_distribution<double> length(-20, 20);
    std::uniform_real_distribution<double> positive(0.01, 1);
    Scene scene;
    for (const char* name : {"walk", "a \"b\" \\ c/~\n", "\xc3\xa9t\xc3\xa9"}) {
        std::vector<mobb::Disk> samples;
        for (int i = 0; i < 40; ++i) samples.push_back({length(random), length(random), positive(random)});
        samples.push_back({-0.0, 5e-324, 0});
        scene.clips.push_back({name, {}, {}, std::make_shared<mobb::Clip>(positive(random), samples), {}});
    }
    for (int i = 0; i < 3; ++i) {
        scene.agents.push_back({"agent " + std::to_string(i),
                                i,
                                {{length(random), length(random)}, length(random), length(random)},
                                i == 1 ? std::optional<Color>({1, 200, 30}) : std::nullopt});
    }
    constexpr double kNone = std::numeric_limits<double>::infinity();
    MotionGraph graph{{{"h"}, {"\"g\""}}, {}, {positive(random), kNone}, {{{"hips", "\"k\"nee"}}, {{"a"}}}};
    for (int i = 0; i < 5; ++i) {
        graph.moves.push_back({i % 3,
                               i % 2,
                               i % 3 % 2,
                               {{length(random), length(random)}, length(random)},
                               {{length(random), length(random)}, length(random)},
                               i % 3 - 1});
    }
    scene.graph = std::make_shared<MotionGraph>(std::move(graph));
    scene.fit = {static_cast<mobb::TreeKind>(random() % mobb::tree_kind_names().size()), 4, 3, mobb::Axes::covariance,
                 positive(random)};
    scene.view.camera = {
        CameraPreset::free, length(random), length(random), false, 33.3, glm::dvec3{0.1, 0.2, 0.3}, 9.7, {0.1, -0.7}};
    scene.view.levels = {1, 4, false};
    scene.view.query = 1;
    scene.view.step = {Step::Unit::percent, 100.0 / 3};
    scene.view.time = length(random);
    scene.view.time_height = positive(random);
    scene.view.hidden = {scene.agents.front().name};
    scene.view.arrange = Arrange::grid;
    scene.view.color_by = ColorBy::empty;
    scene.view.color_range = {0.5, 7};
    scene.view.theme = Theme::light;
    for (const ViewOption& option : view_options()) {
        if (option.toggle) scene.view.*option.toggle = random() % 2 == 0;
    }
    return scene;
}

/// The same scene with the answers and traces of its queries: a capture.
Scene capture(const Scene& scene) {
    Scene out = scene;
    const FittedScene fitted(scene, scene.fit);
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        const SceneQuery query = fitted.queries()[i];
        const RecordedQuery recorded = record(fitted, query);
        out.queries.push_back({query.a, query.b, Expectation{recorded.contact.has_value(), recorded.contact},
                               std::make_shared<mobb::Trace>(recorded.trace)});
    }
    out.queries.push_back({{"walk", 0, {{0.1, 0.2}, 0.3, 0.4}, -1}, out.queries[0].b, {}, {}});
    return out;
}

bool same_bits(double a, double b) { return a == b && std::signbit(a) == std::signbit(b); }

void expect_same(const mobb::Trace& a, const mobb::Trace& b) {
    ASSERT_EQ(a.size(), b.size());
    for (int i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].parent, b[i].parent);
        EXPECT_EQ(a[i].depth, b[i].depth);
        EXPECT_EQ(a[i].a, b[i].a);
        EXPECT_EQ(a[i].b, b[i].b);
        EXPECT_EQ(a[i].test, b[i].test);
        EXPECT_EQ(a[i].outcome, b[i].outcome);
        EXPECT_EQ(a[i].axis, b[i].axis);
        EXPECT_EQ(a[i].gap, b[i].gap);
        ASSERT_EQ(a[i].pairs.size(), b[i].pairs.size());
        for (std::size_t k = 0; k < a[i].pairs.size(); ++k) {
            EXPECT_EQ(a[i].pairs[k].i, b[i].pairs[k].i);
            EXPECT_EQ(a[i].pairs[k].j, b[i].pairs[k].j);
            EXPECT_EQ(a[i].pairs[k].distance, b[i].pairs[k].distance);
        }
    }
}

TEST(SceneRoundTrip, ATraceWhoseRecordingStoppedSaysHowManyEventsThereWere) {
    std::mt19937_64 random(8);
    Scene scene = capture(random_scene(random));
    mobb::Trace stopped = *scene.queries[0].trace;
    stopped.leave_out(12);
    scene.queries[0].trace = std::make_shared<const mobb::Trace>(stopped);
    const std::string text = to_json(scene);
    const Scene read = parse_scene(text, "s.json", "");
    EXPECT_EQ(read.queries[0].trace->events(), stopped.size() + 12);
    EXPECT_FALSE(read.queries[1].trace->stopped());
    EXPECT_EQ(to_json(read), text);
}

TEST(SceneRoundTrip, CapturesComeBackBitForBit) {
    std::mt19937_64 random(7);
    for (int round = 0; round < 20; ++round) {
        const Scene scene = capture(random_scene(random));
        const std::string text = to_json(scene);
        const Scene read = parse_scene(text, "s.json", "");
        ASSERT_EQ(read.clips.size(), scene.clips.size());
        for (std::size_t i = 0; i < scene.clips.size(); ++i) {
            EXPECT_EQ(read.clips[i].name, scene.clips[i].name);
            EXPECT_EQ(read.clips[i].clip->dt(), scene.clips[i].clip->dt());
            ASSERT_EQ(read.clips[i].clip->count(), scene.clips[i].clip->count());
            for (std::size_t k = 0; k < scene.clips[i].clip->samples().size(); ++k) {
                const mobb::Disk& a = scene.clips[i].clip->samples()[k];
                const mobb::Disk& b = read.clips[i].clip->samples()[k];
                EXPECT_TRUE(same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.r, b.r)) << i << ' ' << k;
            }
        }
        for (std::size_t i = 0; i < scene.agents.size(); ++i) {
            EXPECT_EQ(read.agents[i].name, scene.agents[i].name);
            EXPECT_EQ(read.agents[i].placement, scene.agents[i].placement);
            EXPECT_EQ(read.agents[i].color, scene.agents[i].color);
        }
        ASSERT_TRUE(read.graph);
        EXPECT_EQ(*read.graph, *scene.graph);
        EXPECT_EQ(read.fit, scene.fit);
        EXPECT_EQ(read.view, scene.view);
        ASSERT_EQ(read.queries.size(), scene.queries.size());
        for (std::size_t i = 0; i < scene.queries.size(); ++i) {
            EXPECT_EQ(read.queries[i].a.placement, scene.queries[i].a.placement);
            EXPECT_EQ(read.queries[i].a.agent, scene.queries[i].a.agent);
            ASSERT_EQ(read.queries[i].trace == nullptr, scene.queries[i].trace == nullptr);
            if (!scene.queries[i].trace) continue;
            EXPECT_EQ(read.queries[i].expect->collides, scene.queries[i].expect->collides);
            EXPECT_EQ(read.queries[i].expect->contact, scene.queries[i].expect->contact);
            expect_same(*read.queries[i].trace, *scene.queries[i].trace);
        }
        EXPECT_EQ(to_json(read), text);
    }
}

TEST(SceneRoundTrip, SourcesStaySourcesUnlessSamplesAreAskedFor) {
    const TempFolder folder;
    folder.write("a.csv", "id,t,x,y,r\n1,0,0,0,0\n1,1,0,0,0\n1,1.37,0,0,0\n1,5,0,0,0\n");
    const auto file = folder.write("s.json", R"({"clips": {"c": {"source": "a.csv", "id": 1, "fps": 12.5, "unit": 0.1,
        "trim": [0.25, 3], "origin": "start_heading", "radius": 0.1}}})");
    const Scene scene = load_scene(file);
    const Scene linked = parse_scene(to_json(scene), "s.json", folder.path());
    EXPECT_EQ(linked.clips[0].source, "a.csv");
    EXPECT_EQ(linked.clips[0].options, scene.clips[0].options);
    EXPECT_EQ(linked.clips[0].clip->count(), scene.clips[0].clip->count());
    const Scene whole = parse_scene(to_json(scene, true), "s.json", "/nowhere");
    EXPECT_FALSE(whole.clips[0].source);
    EXPECT_EQ(whole.clips[0].clip->count(), scene.clips[0].clip->count());
    EXPECT_EQ(whole.clips[0].clip->dt(), 1 / 12.5);
}

}  // namespace
}  // namespace mobbscope
