// FBX: small documents against poses worked out by hand, each kind in several ways; damage. Real files:
// motion_data_test.cpp.
#include "fbx_scene.h"

#include <base/error.h>
#include <import/fbx/fbx.h>
#include <import/import.h>
#include <support/input_error.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <chrono>
#include <cmath>
#include <numbers>

namespace mobbscope {
namespace {

using testing::fbx_bytes;
using testing::FbxForm;
using testing::FbxWrite;
using testing::FbxWritten;
using namespace testing::fbx;

// ---- the document

TEST(FbxDocuments, EveryFormGivesTheSameMotion) {
    Walk walk;
    walk.scene.animate(walk.base, walk.hand, "Lcl Rotation",
                       {{"X", Keys{{0, 1, 2}, {0, 90, 0}, {kUser, kBroken, kUser}, {{45, 30}, {-60, 10}, {0, 0}}}}});
    walk.scene.model("Thumb", walk.hand, {{"Lcl Translation", vector(0, 1, 0)}});
    const glm::dvec3 right = place(walk.scene, "Thumb", 0.7);
    EXPECT_NE(right.y, 1);
    for (const int version : {7100, 7200, 7300, 7400, 7500, 7700}) {
        for (int form = 0; form < 6; ++form) {
            const FbxForm as{version, form >= 4, form % 2 == 1, form == 2 || form == 3};
            const glm::dvec3 it = place(walk.scene, "Thumb", 0.7, as);
            EXPECT_LT(glm::distance(it, right), 1e-12) << version << " form " << form;
        }
    }
}

TEST(FbxDocuments, TextMayBeWrittenInManyWays) {
    const std::string text = Walk().scene.bytes({7400, true});
    const auto hips = [](const std::string& of) {
        const auto motion = parse_fbx(of, "clip.fbx").motion(0, 0);
        std::vector<glm::dvec3> positions(motion->joints().size());
        motion->pose(1, positions);
        return positions[0].x;
    };
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string out = text;
        std::size_t count = 0;
        for (std::size_t at = out.find(from); at != out.npos; at = out.find(from, at + to.size()), ++count) {
            out.replace(at, from.size(), to);
        }
        EXPECT_GT(count, 0u) << from;
        return out;
    };
    EXPECT_NEAR(hips(text), 2, 1e-12);
    EXPECT_NEAR(hips(with("\n", "\r\n")), 2, 1e-12);
    EXPECT_NEAR(hips(with(",", " ,\n\t ")), 2, 1e-12);
    EXPECT_NEAR(hips(with("{", "\n{ ; a comment } with { braces\n")), 2, 1e-12);
    EXPECT_NEAR(hips("\xEF\xBB\xBF" + text), 2, 1e-12);
    EXPECT_NEAR(hips(with(": ", ":")), 2, 1e-12);
    EXPECT_NEAR(hips(with("\"Model::Hips\"", "\"Model::a &quot;Hips&quot;\"")), 2, 1e-12);
}

TEST(FbxDocuments, OldVersionsAreRefusedWithAWayOut) {
    for (const int version : {3000, 5800, 6100, 7000}) {
        for (const bool is_text : {false, true}) {
            const std::string message = refusal(Walk().scene.bytes({version, is_text}));
            EXPECT_NE(message.find("clip.fbx: is FBX " + std::to_string(version / 1000) + "."), message.npos)
                << message;
            EXPECT_NE(message.find("export it again as FBX 7.4"), message.npos) << message;
        }
    }
    EXPECT_NE(refusal("; FBX 6.1.0 project file\nFBXHeaderExtension: {\n}\n").find("is FBX 6.1"), std::string::npos);
    EXPECT_NE(refusal("FBXHeaderExtension: {\n}\n").find("does not say FBXVersion"), std::string::npos);
}

TEST(FbxDocuments, WhatIsNoneIsRefused) {
    for (const std::string& bytes : {std::string(), std::string("v 0 0 0\n"), std::string("Kaydara FBX Bin")}) {
        EXPECT_NE(refusal(bytes).find("is neither binary nor text FBX"), std::string::npos) << bytes;
    }
    EXPECT_NE(refusal("Kaydara FBX Binary").find("is cut off"), std::string::npos);
}

TEST(FbxDocuments, EveryBeginningIsReadOrRefusedInOneLine) {
    for (const bool is_text : {false, true}) {
        const std::string bytes = Walk().scene.bytes({7400, is_text, true});
        int refused = 0;
        for (std::size_t length = 0; length < bytes.size(); ++length) {
            try {
                parse_fbx(std::string_view(bytes).substr(0, length), "clip.fbx");
            } catch (const InputError& error) {
                ++refused;
                EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
            }
        }
        EXPECT_GT(refused, static_cast<int>(bytes.size() * 9 / 10));
    }
}

TEST(FbxDocuments, DamageIsReadOrRefused) {
    std::mt19937 random(20251125);
    Walk walk;
    walk.scene.animate(walk.scene.layer(walk.stack, {{"Weight", scalar(50)}}), walk.hand, "Lcl Rotation",
                       {{"Y", Keys{{0, 1, 2}, {0, 90, 0}, {kUser, kStepped, kUser}}}});
    for (const FbxForm form : {FbxForm{7400, false, true}, FbxForm{7500}, FbxForm{7400, true}}) {
        const std::string bytes = walk.scene.bytes(form);
        for (int round = 0; round < 3'000; ++round) {
            try {
                const MotionFile file = parse_fbx(testing::mutated(bytes, random), "clip.fbx");
                const auto motion = file.motion(0, 0);
                std::vector<glm::dvec3> positions(motion->joints().size());
                motion->pose(motion->times().last, positions);
            } catch (const InputError& error) {
                EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
            }
        }
    }
}

/// A curve whose record is changed by `change`.
template <class Change>
std::string with_curve(const Change& change, const FbxForm& form = {}) {
    Walk walk;
    for (FbxWrite& object : walk.scene.objects().inside) {
        if (object.name == "AnimationCurve") change(object);
    }
    return walk.scene.bytes(form);
}

TEST(FbxDocuments, CurvesThatDoNotAddUpAreRefused) {
    using Integers = std::vector<std::int64_t>;
    const auto message_with = [](std::size_t part, FbxWritten value) {
        return refusal(with_curve([&](FbxWrite& curve) { curve.inside[part].values = {std::move(value)}; }));
    };
    EXPECT_NE(message_with(0, Integers{0}).find("has 1 times for 2 values"), std::string::npos);
    EXPECT_NE(message_with(0, Integers{9, 3}).find("has key 1 before the one before it"), std::string::npos);
    EXPECT_NE(message_with(2, Integers{4}).find("do not belong together"), std::string::npos);
    EXPECT_NE(message_with(4, Integers{1, 0}).find("has tangents for 1 of its 2 keys"), std::string::npos);
    EXPECT_NE(message_with(4, Integers{-5, INT64_MAX}).find("counts -5 keys"), std::string::npos);
    EXPECT_NE(message_with(0, std::string("soon")).find("which is no number"), std::string::npos);
}

TEST(FbxDocuments, ClaimsTakeNoMemory) {
    // A few packed bytes that claim a billion numbers, and some that unpack to more than they claim.
    const std::string bytes = with_curve(
        [](FbxWrite& curve) { curve.inside[1].values = {std::vector<double>(100'000, 1.0)}; }, {7400, false, true});
    const std::size_t at = bytes.find("KeyValueFloatd") + 14;
    const auto claiming = [&](std::uint32_t count) {
        std::string out = bytes;
        for (int i = 0; i < 4; ++i) out[at + static_cast<std::size_t>(i)] = static_cast<char>(count >> (8 * i) & 0xff);
        return refusal(out);
    };
    EXPECT_NE(claiming(1'000'000'000).find("too many for this file"), std::string::npos);
    EXPECT_NE(claiming(5'000'000).find("does not unpack to the 5000000 numbers"), std::string::npos);
    EXPECT_NE(claiming(99'999).find("does not unpack to the 99999 numbers"), std::string::npos);
    EXPECT_NE(claiming(100'000).find("has 2 times for 100000 values"), std::string::npos);
}

TEST(FbxDocuments, DepthAndNumberAreNoTrouble) {
    const auto begin = std::chrono::steady_clock::now();
    std::string deep = "FBXHeaderExtension: {\n FBXVersion: 7400\n}\n";
    for (int i = 0; i < 100'000; ++i) deep += "a: {";
    EXPECT_NE(refusal(deep).find("the file ends inside 'a'"), std::string::npos);
    EXPECT_NE(refusal(deep + std::string(100'000, '}')).find("holds no animation"), std::string::npos);

    Scene chain;
    std::int64_t last = 0;
    for (int i = 0; i < 20'000; ++i) last = chain.model("n" + std::to_string(i), last);
    const std::int64_t layer = chain.layer(chain.stack("t"));
    chain.animate(layer, 1000, "Lcl Translation", {{"X", line(0, 4)}});
    expect_place(place(chain, "n19999", 1), 2, 0, 0);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(FbxDocuments, NodesInACircleAreRefused) {
    Walk walk;
    walk.scene.connect(walk.hips, walk.hand);
    EXPECT_NE(refusal(walk.scene.bytes()).find("2 nodes hang on each other in a circle"), std::string::npos);
    Walk own;
    own.scene.connect(own.hips, own.hips);
    EXPECT_NE(refusal(own.scene.bytes()).find("2 nodes hang on each other in a circle"), std::string::npos);
}

TEST(FbxDocuments, WithoutAnimationThereIsNoClip) {
    Scene scene;
    scene.model("Hips", 0);
    EXPECT_NE(refusal(scene.bytes()).find("holds no animation"), std::string::npos);
    scene.layer(scene.stack("Take 001"));
    const MotionFile still = parse_fbx(scene.bytes(), "clip.fbx");
    EXPECT_NE(testing::input_error([&] { still.motion(0, 0); }).find("moves no node"), std::string::npos);
}

// ---- keys

TEST(FbxKeys, LieOnTheirCurves) {
    const auto x_at = [](Keys keys, double seconds) {
        Walk walk;
        walk.scene.animate(walk.scene.layer(walk.stack, {{"BlendMode", choice(1)}}), walk.hips, "Lcl Translation",
                           {{"X", std::move(keys)}});
        return walk.hips_at(seconds).x;
    };
    const std::vector<double> two{0, 2};
    EXPECT_NEAR(x_at({two, {0, 4}}, 0.5), 1, 1e-9) << "linear";
    EXPECT_NEAR(x_at({two, {0, 4}, {kStepped, 0}}, 1.9), 0, 1e-9) << "stepped";
    EXPECT_NEAR(x_at({two, {0, 4}, {kStepped, 0}}, 2), 4, 1e-9) << "stepped, on the key";
    EXPECT_NEAR(x_at({two, {0, 4}, {kSteppedNext, 0}}, 0.1), 4, 1e-9) << "stepped to the next";
    EXPECT_NEAR(x_at({{1}, {7}}, 0.5), 7, 1e-9) << "one key";
    // Flat tangents: 4 (3 s^2 - 2 s^3).
    for (const double t : {0.3, 1.0, 1.7}) {
        const double s = t / 2;
        EXPECT_NEAR(x_at({two, {0, 4}, {kUser, kUser}}, t), 4 * (3 * s * s - 2 * s * s * s), 1e-6) << "flat " << t;
    }
    // Hermite's cubic: slopes 3 at the beginning and -1 at the end, units a second over 2 s.
    const double s = 0.25;
    const double hermite =
        4 * (3 * s * s - 2 * s * s * s) + 2 * 3 * (s - 2 * s * s + s * s * s) - 2 * (s * s * s - s * s);
    EXPECT_NEAR(x_at({two, {0, 4}, {kUser, kUser}, {{3, -1}, {0, 0}}}, 0.5), hermite, 1e-6) << "user tangents";
    // Bezier's with handles of 0.8 and 0.1 of the way: at its parameter u the time is known.
    const double u = 0.4;
    const double at = 2 * (3 * (1 - u) * (1 - u) * u * 0.8 + 3 * (1 - u) * u * u * 0.9 + u * u * u);
    const double value =
        3 * (1 - u) * (1 - u) * u * (0.8 * 2 * 3) + 3 * (1 - u) * u * u * (4 + 0.1 * 2 * 1) + 4 * u * u * u;
    EXPECT_NEAR(x_at({two, {0, 4}, {kUser, kUser}, {{3, -1}, {0, 0}}, {{0.8, 0.1}}}, at), value, 1e-5) << "weighted";
    // A smooth key between two: its tangent is half the chord of both sides and half the parabola's.
    const Keys smooth{{0, 1, 2}, {0, 1, 4}, {0x108, 0x108, 0x108}};
    EXPECT_NEAR(x_at(smooth, 1.5), 1 * 0.5 + 4 * 0.5 + (2 - 3) * 0.125, 1e-6) << "automatic: slopes 2 and 3";
}

TEST(FbxKeys, GoOnAsTheFileSays) {
    const auto x_at = [](std::int64_t letter, std::int64_t times, double seconds, bool is_text = false) {
        Walk walk;
        // The hand's curve lasts 1 s, from 10 to 13; the stack 2 s.
        walk.scene.animate(walk.base, walk.hand, "Lcl Translation",
                           {{"Y", Keys{{0, 1}, {10, 13}, {}, {}, {}, {{"Post-Extrapolation", {letter, times}}}}}});
        return place(walk.scene, "Hand", seconds, {7400, is_text}).y;
    };
    EXPECT_NEAR(x_at('C', -1, 1.25), 13, 1e-9) << "constant";
    EXPECT_NEAR(x_at('R', -1, 1.25), 10.75, 1e-9) << "repeats";
    EXPECT_NEAR(x_at('M', -1, 1.25), 12.25, 1e-9) << "mirrors";
    EXPECT_NEAR(x_at('A', -1, 1.25), 13.75, 1e-9) << "repeats and rises";
    EXPECT_NEAR(x_at('K', -1, 1.25), 13.75, 1e-9) << "goes on with its slope";
    EXPECT_NEAR(x_at('R', 0, 1.25), 13, 1e-9) << "repeats no time";
    EXPECT_NEAR(x_at('M', -1, 2, true), 10, 1e-9) << "text";
}

TEST(FbxKeys, OfOtherAxesStayWhereTheFileSays) {
    Walk walk({{"Lcl Translation", vector(1, 2, 3)}});
    expect_place(walk.hips_at(1), 2, 2, 3, "the node's own, where the curve node says nothing");
    Scene scene;
    const std::int64_t hips = scene.model("Hips", 0, {{"Lcl Translation", vector(1, 2, 3)}});
    scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Translation", {{"X", line(0, 4)}},
                  {{"d|X", scalar(9)}, {"d|Y", scalar(7)}, {"d|Z", scalar(8)}});
    expect_place(place(scene, "Hips", 1), 2, 7, 8, "the curve node's");
}

TEST(FbxKeys, ATimeInNewTicksIsKnown) {
    // 141,120,000 a second where TCDefinition says so.
    Scene scene = Walk().scene;
    std::vector<FbxWrite> records = scene.records();
    for (FbxWrite& object : records[2].inside) {
        if (object.name == "AnimationCurve") object.inside[0].values = {std::vector<std::int64_t>{0, 2 * 141'120'000}};
    }
    std::string text = fbx_bytes(records, {7700, true});
    const std::string header = "FBXHeaderVersion: 1003";
    text.replace(text.find(header), header.size(), "FBXHeaderVersion: 1004\nOtherFlags: {\nTCDefinition: 126\n}");
    EXPECT_NEAR(parse_fbx(text, "clip.fbx").motion(0, 0)->times().last, 2, 1e-12);
}

// ---- layers

TEST(FbxLayers, GoOverEachOther) {
    struct Case {
        const char* what;
        Properties layer;
        double right;
    };
    // The base is at 2 at 1 s, the layer at 10.
    const Case cases[] = {
        {"additive", {}, 12},
        {"additive at 50 %", {{"Weight", scalar(50)}}, 7},
        {"override", {{"BlendMode", choice(1)}}, 10},
        {"passthrough at 25 %", {{"BlendMode", choice(2)}, {"Weight", scalar(25)}}, 4},
        {"muted", {{"Mute", choice(1)}}, 2},
        {"of no weight", {{"Weight", scalar(0)}}, 2},
    };
    for (const Case& it : cases) {
        Walk walk;
        walk.scene.animate(walk.scene.layer(walk.stack, it.layer), walk.hips, "Lcl Translation", {{"X", line(0, 20)}});
        EXPECT_NEAR(walk.hips_at(1).x, it.right, 1e-9) << it.what;
        const bool is_muted = std::string_view(it.what) == "muted";
        EXPECT_EQ(parsed(walk.scene).motion(0, 0)->warnings().size(), is_muted ? 1u : 0u) << it.what;
    }
}

TEST(FbxLayers, ThreeOfThemWeighAsTheyMove) {
    Walk walk;
    walk.scene.animate(walk.scene.layer(walk.stack), walk.hips, "Lcl Translation", {{"X", line(1, 1)}});
    const std::int64_t top = walk.scene.layer(walk.stack, {{"BlendMode", choice(2)}});
    walk.scene.animate(top, walk.hips, "Lcl Translation", {{"X", line(11, 11)}});
    walk.scene.animate(top, top, "Weight", {{"Weight", line(0, 100)}});
    EXPECT_NEAR(walk.hips_at(0).x, 1, 1e-9);
    EXPECT_NEAR(walk.hips_at(0.5).x, 0.75 * 2 + 0.25 * 11, 1e-9);
    EXPECT_NEAR(walk.hips_at(2).x, 11, 1e-9);
}

TEST(FbxLayers, ASoloOneIsAlone) {
    Walk walk;
    walk.scene.animate(walk.scene.layer(walk.stack, {{"Solo", choice(1)}}), walk.hips, "Lcl Translation",
                       {{"X", line(7, 7)}});
    EXPECT_NEAR(walk.hips_at(1).x, 7, 1e-9);
    EXPECT_EQ(parsed(walk.scene).motion(0, 0)->warnings().size(), 1u);
}

TEST(FbxLayers, RotationsAndScalesComposeOrAdd) {
    const auto hand = [](const Properties& layer, const char* property, const Keys& x, const Keys& z) {
        Walk walk({}, {{"Lcl Translation", vector(1, 0, 0)}});
        // Over the base: about z by 90 degrees, or a scale of 2.
        const bool is_scale = property == std::string("Lcl Scaling");
        walk.scene.animate(walk.base, walk.hips, property,
                           {{is_scale ? "X" : "Z", is_scale ? line(2, 2) : line(90, 90)}});
        walk.scene.animate(walk.scene.layer(walk.stack, layer), walk.hips, property, {{"X", x}, {"Z", z}});
        return walk.hand_at(0) - walk.hips_at(0);
    };
    // About z by 90, then in those axes about x by 90 and z by 90 again: the hand turns twice about z.
    expect_place(hand({}, "Lcl Rotation", line(0, 0), line(90, 90)), -1, 0, 0, "composed, about one axis");
    // R = Rz(90) * (Rz(0) Rx(90)): x -> x -> y.
    expect_place(hand({}, "Lcl Rotation", line(90, 90), line(0, 0)), 0, 1, 0, "composed");
    expect_place(hand({{"RotationAccumulationMode", choice(1)}}, "Lcl Rotation", line(0, 0), line(45, 45)),
                 -std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2, 0, "angle by angle");
    expect_place(hand({{"Weight", scalar(50)}}, "Lcl Rotation", line(0, 0), line(90, 90)), -std::numbers::sqrt2 / 2,
                 std::numbers::sqrt2 / 2, 0, "half of a rotation");
    expect_place(hand({}, "Lcl Scaling", line(3, 3), line(1, 1)), 6, 0, 0, "scales multiply");
    expect_place(hand({{"ScaleAccumulationMode", choice(1)}}, "Lcl Scaling", line(3, 3), line(1, 1)), 5, 0, 0,
                 "scales add");
    expect_place(hand({{"Weight", scalar(50)}}, "Lcl Scaling", line(4, 4), line(1, 1)), 4, 0, 0, "the root of a scale");
}

TEST(FbxLayers, EachStackHasItsOwn) {
    Walk walk;
    const std::int64_t second = walk.scene.stack("Run");
    walk.scene.animate(walk.scene.layer(second), walk.hips, "Lcl Translation", {{"Z", line(0, 6, 3)}});
    walk.scene.layer(walk.scene.stack("empty"));
    const MotionFile file = parsed(walk.scene);
    EXPECT_EQ(file.animations, (std::vector<std::string>{"Take 001", "Run"})) << "an empty one is left out";
    std::vector<glm::dvec3> positions(2);
    file.motion(1, 0)->pose(1.5, positions);
    expect_place(positions[0], 0, 0, 3);
    EXPECT_EQ(file.motion(1, 0)->times().last, 3);
}

TEST(FbxLayers, AStackLastsAsLongAsItPlays) {
    const auto times = [](double start, double stop) {
        Scene scene;
        const std::int64_t hips = scene.model("Hips", 0);
        const auto ticks = [](double seconds) { return choice(std::llround(seconds * kTicks)); };
        const std::int64_t stack = scene.stack("t", {{"LocalStart", ticks(start)}, {"LocalStop", ticks(stop)}});
        scene.animate(scene.layer(stack), hips, "Lcl Translation", {{"X", Keys{{1, 2}, {0, 4}}}});
        const MotionTimes it = parsed(scene).motion(0, 0)->times();
        return std::pair(it.first, it.last);
    };
    EXPECT_EQ(times(0, 0), std::pair(1.0, 2.0)) << "it does not say";
    EXPECT_EQ(times(1, 2), std::pair(1.0, 2.0));
    EXPECT_EQ(times(0, 5), std::pair(0.0, 5.0)) << "a pose is held at both ends";
    EXPECT_EQ(times(1.5, 1.6), std::pair(1.0, 2.0)) << "no key is lost";
    EXPECT_EQ(times(5, 3), std::pair(1.0, 2.0));
}

// ---- nodes. Every matrix of the chain: fbx_transform_test.cpp.

TEST(FbxNodes, PivotsOffsetsAndRotationsMoveWhatHangsOnThem) {
    struct Case {
        const char* what;
        Properties hips;
        glm::dvec3 right;  ///< the hand from where the walk has the hips
    };
    const Case cases[] = {
        {"nothing", {}, {0, 0, 1}},
        {"rotation", {{"Lcl Rotation", vector(0, 90, 0)}}, {1, 0, 0}},
        {"rotation pivot", {{"Lcl Rotation", vector(0, 90, 0)}, {"RotationPivot", vector(0, 0, 3)}}, {-2, 0, 3}},
        {"rotation offset", {{"RotationOffset", vector(0, 5, 0)}}, {0, 5, 1}},
        {"scaling pivot", {{"Lcl Scaling", vector(1, 1, 2)}, {"ScalingPivot", vector(0, 0, 3)}}, {0, 0, -1}},
        {"scaling offset", {{"ScalingOffset", vector(7, 0, 0)}}, {7, 0, 1}},
        {"pre-rotation", {{"PreRotation", vector(90, 0, 0)}, {"RotationActive", choice(1)}}, {0, -1, 0}},
        {"post-rotation", {{"PostRotation", vector(90, 0, 0)}, {"RotationActive", choice(1)}}, {0, 1, 0}},
        {"inactive pre-rotation", {{"PreRotation", vector(90, 0, 0)}, {"RotationActive", choice(0)}}, {0, 0, 1}},
        {"inactive post-rotation", {{"PostRotation", vector(90, 0, 0)}, {"RotationActive", choice(0)}}, {0, 0, 1}},
        {"for limits alone",
         {{"PreRotation", vector(90, 0, 0)}, {"RotationActive", choice(1)}, {"RotationSpaceForLimitOnly", choice(1)}},
         {0, 0, 1}},
        {"order XYZ", {{"Lcl Rotation", vector(90, 90, 0)}}, {0, -1, 0}},
        {"order YXZ",
         {{"Lcl Rotation", vector(90, 90, 0)}, {"RotationOrder", choice(3)}, {"RotationActive", choice(1)}},
         {1, 0, 0}},
        {"geometric transform",
         {{"GeometricTranslation", vector(9, 9, 9)}, {"GeometricRotation", vector(9, 9, 9)}},
         {0, 0, 1}},
    };
    for (const Case& it : cases) {
        const Walk walk(it.hips);
        const glm::dvec3 hand = walk.hand_at(1);
        expect_place(hand, 2 + it.right.x, it.right.y, it.right.z, it.what);
    }
}

TEST(FbxNodes, TheSameIsTrueOfJointsBelow) {
    // Hips, spine with a pivot that turns, hand.
    for (const char* pivot : {"RotationPivot", "RotationOffset", "ScalingPivot", "ScalingOffset", "PreRotation"}) {
        Scene scene;
        const std::int64_t hips = scene.model("Hips", 0);
        const std::int64_t spine =
            scene.model("Spine", hips, {{"Lcl Translation", vector(0, 1, 0)}, {pivot, vector(0, 2, 0)}});
        scene.model("Hand", spine, {{"Lcl Translation", vector(1, 0, 0)}});
        const std::int64_t layer = scene.layer(scene.stack("t"));
        scene.animate(layer, hips, "Lcl Translation", {{"X", line(0, 4)}});
        scene.animate(layer, spine, "Lcl Rotation", {{"Z", line(0, 180)}});
        const glm::dvec3 hand = place(scene, "Hand", 1);
        const std::string which = pivot;
        // Turned by 90 degrees about z at 1 s.
        if (which == "RotationPivot") expect_place(hand, 2 + 2, 1 + 2 + 1, 0, pivot);
        if (which == "RotationOffset") expect_place(hand, 2, 1 + 2 + 1, 0, pivot);
        if (which == "ScalingPivot") expect_place(hand, 2, 1 + 1, 0, pivot);
        if (which == "ScalingOffset") expect_place(hand, 2 - 2, 1 + 1, 0, pivot);
        // About y by 2 degrees, after the turn.
        if (which == "PreRotation") expect_place(hand, 2, 2, 0, pivot);
    }
}

TEST(FbxNodes, ScaleIsInheritedAsTheTypeSays) {
    const auto foot = [](const Properties& shin_has) {
        Scene scene;
        const std::int64_t hips = scene.model("Hips", 0, {{"Lcl Scaling", vector(2, 1, 1)}});
        Properties shin_is{{"Lcl Translation", vector(1, 0, 0)}, {"Lcl Rotation", vector(0, 0, 90)}};
        shin_is.insert(shin_is.end(), shin_has.begin(), shin_has.end());
        const std::int64_t shin = scene.model("Shin", hips, shin_is);
        scene.model("Foot", shin, {{"Lcl Translation", vector(1, 1, 0)}});
        scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Translation", {{"Z", line(0, 4)}});
        return place(scene, "Foot", 0);
    };
    expect_place(foot({}), 2 - 2, 1, 0, "none said: with the parent's matrix");
    expect_place(foot({{"InheritType", choice(1)}}), 2 - 2, 1, 0, "RSrs");
    expect_place(foot({{"InheritType", choice(0)}}), 2 - 1, 2, 0, "RrSs");
    expect_place(foot({{"InheritType", choice(2)}}), 2 - 1, 1, 0, "Rrs");
    expect_place(foot({{"InheritType", choice(0)}, {"Lcl Scaling", vector(1, 3, 1)}}), 2 - 3, 2, 0, "RrSs, scaled");
}

TEST(FbxNodes, WhatTheTemplateSaysHoldsForAll) {
    Walk walk({{"PreRotation", vector(90, 0, 0)}}, {});
    walk.scene.model_template({{"RotationActive", choice(0)}, {"Lcl Translation", vector(0, 0, 1)}});
    expect_place(walk.hand_at(1), 2, 0, 1 + 1, "PreRotation does not count; the translation is the template's");
    Walk own({{"PreRotation", vector(90, 0, 0)}, {"RotationActive", choice(1)}}, {});
    own.scene.model_template({{"RotationActive", choice(0)}, {"Lcl Translation", vector(0, 0, 1)}});
    expect_place(own.hand_at(1), 2, -1, 1, "but for a node that says otherwise");
}

TEST(FbxNodes, UpAxesAndUnitsAreTheFiles) {
    const auto clip = [](const std::vector<std::int64_t>& axes, double unit, const Properties& to, bool has_mesh) {
        Scene scene;
        const char* const names[] = {"UpAxis",        "UpAxisSign", "FrontAxis",
                                     "FrontAxisSign", "CoordAxis",  "CoordAxisSign"};
        for (std::size_t i = 0; i < axes.size(); ++i) scene.setting(names[i], axes[i]);
        scene.setting("UnitScaleFactor", unit);
        const std::int64_t hips = scene.model("Hips", 0);
        if (has_mesh) {
            scene.model("Body", hips, {}, "Mesh");
            FbxWrite& mesh =
                scene.objects().add({"Geometry", {std::int64_t{77}, std::string("Geometry::"), std::string("Mesh")}});
            mesh.add({"Vertices", {std::vector<double>{0, 0, 0, 1, 1, 1, 2, 2, 2}}});
        }
        std::vector<std::pair<std::string, Keys>> keys;
        for (const auto& [axis, values] : to) keys.push_back({axis, line(0, std::get<double>(values[0]))});
        scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Translation", keys);
        const testing::TempFolder folder;
        return import_clips(folder.write("clip.fbx", scene.bytes()), {}).at(0);
    };
    const auto end = [&](const std::vector<std::int64_t>& axes, const Properties& to, double unit = 1,
                         bool mesh = false) {
        const mobb::Disk disk = clip(axes, unit, to, mesh).clip->samples().back();
        return glm::dvec3(disk.x, disk.y, 0);
    };
    const Properties flat{{"X", scalar(300)}, {"Y", scalar(50)}, {"Z", scalar(400)}};
    expect_place(end({}, flat), 3, -4, 0, "not said: y up");
    expect_place(end({1, 1, 2, 1, 0, 1}, flat), 3, -4, 0, "y up");
    for (const bool mesh : {false, true}) {
        expect_place(end({2, 1, 1, -1, 0, 1}, flat, 1, mesh), 3, 0.5, 0, "z up");
    }
    expect_place(end({2, 1}, flat), 3, 0.5, 0, "z up, and no other axis");
    // Up is x, the front z, the right y.
    expect_place(end({0, 1, 2, 1, 1, 1}, flat), 0.5, -4, 0, "x up");
    // Seen from below: up is -y and the right -x.
    expect_place(end({1, -1, 2, 1, 0, -1}, flat), -3, -4, 0, "-y up");
    expect_place(end({2, 1, 1, -1, 0, 1}, flat, 2.54), 3 * 2.54, 0.5 * 2.54, 0, "inches");
    expect_place(end({1, 1, 2, 1, 0, 1}, flat, 100), 300, -400, 0, "metres");
    EXPECT_EQ(clip({2, 1, 1, -1, 0, 1}, 1, flat, false).facts.up, "z");
}

// ---- several people

/// A body of seven joints of usual names below `parent`, which walks from `from` to `to` along x.
std::int64_t add_person(Scene& scene, std::int64_t layer, std::int64_t parent, double from, double to, double z) {
    const std::int64_t hips = scene.model("Hips", parent, {{"Lcl Translation", vector(from, 95, z)}});
    const std::int64_t spine = scene.model("Spine", hips, {{"Lcl Translation", vector(0, 30, 0)}});
    for (const char* name : {"Head", "LeftHand", "RightHand"})
        scene.model(name, spine, {{"Lcl Translation", vector(name[0] == 'L' ? 60 : -60, 20, 0)}});
    for (const char* name : {"LeftFoot", "RightFoot"})
        scene.model(name, hips, {{"Lcl Translation", vector(10, -90, 0)}});
    scene.animate(layer, hips, "Lcl Translation", {{"X", line(from, to)}}, {{"d|Y", scalar(95)}, {"d|Z", scalar(z)}});
    return hips;
}

void expect_ends(const ImportedClip& clip, double x0, double y0, double x1, double y1) {
    const auto samples = clip.clip->samples();
    EXPECT_NEAR(samples.front().x, x0, 1e-9) << clip.name;
    EXPECT_NEAR(samples.front().y, y0, 1e-9) << clip.name;
    EXPECT_NEAR(samples.back().x, x1, 1e-9) << clip.name;
    EXPECT_NEAR(samples.back().y, y1, 1e-9) << clip.name;
    EXPECT_NEAR(samples.front().r, 0.6, 1e-9) << clip.name;
}

TEST(FbxPeople, OfEqualJointNamesAreTwoClips) {
    for (const int way : {0, 1, 2, 3, 4}) {
        SCOPED_TRACE(way);
        Scene scene;
        const std::int64_t layer = scene.layer(scene.stack("Take 001"));
        std::int64_t above[2] = {0, 0};
        if (way == 1) above[0] = above[1] = scene.model("Scene", 0, {}, "Null");
        if (way == 2 || way == 3) {
            for (std::int64_t& group : above) group = scene.model("Armature", 0, {}, way == 2 ? "Null" : "Mesh");
        }
        add_person(scene, layer, above[0], 0, 400, 0);
        add_person(scene, layer, above[1], 0, -200, 300);
        if (way == 4) scene.model("Camera", 0, {}, "Camera");
        const testing::TempFolder folder;
        const auto file = folder.write("clip.fbx", scene.bytes());
        const std::vector<ImportedClip> clips = import_clips(file, {});
        ASSERT_EQ(clips.size(), 2u);
        EXPECT_EQ(clips[0].name, "Take 001 · Hips");
        EXPECT_EQ(clips[1].name, "Take 001 · Hips #2");
        expect_ends(clips[0], 0, 0, 4, 0);
        expect_ends(clips[1], 0, -3, -2, -3);
        ImportOptions second;
        second.root = "Hips #2";
        const std::vector<ImportedClip> chosen = import_clips(file, second);
        ASSERT_EQ(chosen.size(), 1u);
        expect_ends(chosen[0], 0, -3, -2, -3);
    }
}

TEST(FbxPeople, WhatCarriesOneOfThemMovesIt) {
    // Two groups that walk, with bodies that stand still in them.
    Scene scene;
    const std::int64_t layer = scene.layer(scene.stack("Take 001"));
    for (const double z : {0.0, 300.0}) {
        const std::int64_t group = scene.model("Reference", 0, {{"Lcl Translation", vector(0, 0, z)}}, "Null");
        scene.animate(layer, group, "Lcl Translation", {{"X", line(0, 100)}}, {{"d|Z", scalar(z)}});
        add_person(scene, layer, group, 0, 0, 0);
    }
    const testing::TempFolder folder;
    const std::vector<ImportedClip> clips = import_clips(folder.write("clip.fbx", scene.bytes()), {});
    ASSERT_EQ(clips.size(), 2u);
    expect_ends(clips[0], 0, 0, 1, 0);
    expect_ends(clips[1], 0, -3, 1, -3);
}

TEST(FbxPeople, OneWithPropsAndControlsIsOne) {
    Scene scene;
    const std::int64_t layer = scene.layer(scene.stack("Take 001"));
    const std::int64_t armature = scene.model("Armature", 0, {}, "Null");
    add_person(scene, layer, armature, 0, 400, 0);
    for (const char* name : {"ik_foot_l", "ik_foot_r"}) {
        const std::int64_t control = scene.model(name, armature);
        scene.animate(layer, control, "Lcl Translation", {{"X", line(0, 400)}});
    }
    scene.animate(layer, scene.model("Ball", 0, {}, "Mesh"), "Lcl Translation", {{"X", line(0, 100)}});
    const testing::TempFolder folder;
    EXPECT_EQ(import_clips(folder.write("clip.fbx", scene.bytes()), {}).size(), 1u);
}

// ---- files

TEST(FbxFiles, ThePublicOnesGiveTheirValues) {
    const std::filesystem::path folder = std::filesystem::path(MOBBSCOPE_SHARED_DATA) / "public";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no test data at " << folder;
    const auto clips = [&](const char* name) {
        return import_clips(folder / (std::string("fbx_") + name + ".fbx"), {});
    };
    const auto sample = [&](const ImportedClip& clip, double seconds) {
        return clip.clip->samples()[static_cast<std::size_t>(std::lround(seconds * 30))];
    };
    const auto length = [&](const ImportedClip& clip) {
        double sum = 0;
        const auto samples = clip.clip->samples();
        for (std::size_t i = 1; i < samples.size(); ++i)
            sum += std::hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y);
        return sum;
    };
    const ImportedClip pivot = clips("pivot_on_spine").at(0);
    EXPECT_NEAR(length(pivot), 4, 5e-4);
    EXPECT_NEAR(sample(pivot, 0).r, 0.6, 5e-4);
    EXPECT_NEAR(sample(pivot, 1.6).r, 0.3245, 5e-4);
    const ImportedClip cubic = clips("cubic_two_keys").at(0);
    for (const double t : {0.0, 0.633, 1.0, 1.567, 2.0}) {
        const double s = std::round(t * 30) / 60;
        EXPECT_NEAR(sample(cubic, t).x, 4 * (3 * s * s - 2 * s * s * s), 1e-5) << t;
    }
    const ImportedClip z_up = clips("z_up").at(0);
    EXPECT_NEAR(length(z_up), 5, 5e-4);
    EXPECT_NEAR(z_up.clip->samples().back().x, 3, 5e-4);
    EXPECT_NEAR(z_up.clip->samples().back().y, 4, 5e-4);
    EXPECT_NEAR(sample(z_up, 1).r, 0.6, 5e-4);
    EXPECT_NEAR(sample(clips("additive_layer").at(0), 2).x, 5, 5e-4);
    const ImportedClip post = clips("post_rotation").at(0);
    EXPECT_NEAR(length(post), 4, 5e-4);
    EXPECT_NEAR(sample(post, 1.633).r, 0.5169, 5e-4);
    const std::vector<ImportedClip> two = clips("two_people_same_joint_names");
    ASSERT_EQ(two.size(), 2u);
    EXPECT_NEAR(sample(two[0], 2).x, 4, 5e-4);
    EXPECT_NEAR(sample(two[1], 0).y, -3, 5e-4);
    EXPECT_NEAR(sample(two[1], 2).x, -2, 5e-4);
}

TEST(FbxFiles, AreToldByTheirContent) {
    const testing::TempFolder folder;
    const Scene scene = Walk().scene;
    for (const bool is_text : {false, true}) {
        EXPECT_EQ(import_clips(folder.write("walk", scene.bytes({7400, is_text})), {}).at(0).facts.format, "fbx");
    }
    EXPECT_TRUE(looks_like_fbx("; a comment\n\n; another\nFBXHeaderExtension:  {"));
    EXPECT_FALSE(looks_like_fbx("a,b\n1,FBXHeaderExtension\n"));
}

TEST(FbxFiles, DamagedRealOnesAreReadOrRefused) {
    const std::filesystem::path original = std::filesystem::path(MOBBSCOPE_SHARED_DATA) / "fbx/huesitos.fbx";
    if (!std::filesystem::exists(original)) GTEST_SKIP() << "no test data at " << original;
    const std::string bytes = testing::slurp(original);
    std::mt19937 random(20250305);
    for (int round = 0; round < 300; ++round) {
        try {
            parse_fbx(testing::mutated(bytes, random), "clip.fbx");
        } catch (const InputError& error) {
            EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace mobbscope
