// FBX curves: how keys are joined, tangents that their modes work out, runs of attributes, what lies beyond the keys.
#include "fbx_scene.h"

#include <array>
#include <bit>

namespace mobbscope {
namespace {

using namespace testing::fbx;

constexpr std::int64_t kTcb = 0x208;
constexpr std::int64_t kAuto = 0x108;
constexpr std::int64_t kClamped = 0x1000;
constexpr std::int64_t kTimeIndependent = 0x2000;
constexpr std::int64_t kProgressive = 0x4000;

/// x of hips with one curve, after `change` of its record.
template <class Change>
double changed_x(const Keys& keys, double seconds, const Change& change) {
    Scene scene;
    const std::int64_t hips = scene.model("Hips", 0);
    scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Translation", {{"X", keys}});
    change(scene.objects().inside.back());
    return place(scene, "Hips", seconds).x;
}

double keyed_x(const Keys& keys, double seconds) {
    return changed_x(keys, seconds, [](FbxWrite&) {});
}

TEST(FbxTangents, OfTensionContinuityAndBias) {
    // Chords of 0 and 8 about the middle key; the last one has 8. Between keys 1 s apart the middle is the mean of the
    // values, and an eighth of the difference of the slopes.
    const auto at = [](double tension, double continuity, float bias, double seconds) {
        const Keys keys{{0, 1, 2}, {0, 0, 8}, {kTcb, kTcb, kTcb}, {{0, 0}, {tension, continuity}, {0, 0}}};
        return changed_x(keys, seconds, [bias](FbxWrite& curve) {
            auto& data = std::get<std::vector<std::uint32_t>>(curve.inside[3].values[0]);
            data[4 + 2] = std::bit_cast<std::uint32_t>(bias);
        });
    };
    EXPECT_NEAR(at(0, 0, 0, 0.5), 0 + (0.0 - 4) / 8, 1e-6) << "half of both chords";
    EXPECT_NEAR(at(0, 0, 0, 1.5), 4 + (4.0 - 8) / 8, 1e-6);
    EXPECT_NEAR(at(1, 0, 0, 0.5), 0, 1e-6) << "no slope where the tension is 1";
    EXPECT_NEAR(at(1, 0, 0, 1.5), 4 - 8.0 / 8, 1e-6);
    EXPECT_NEAR(at(0, 1, 0, 0.5), 0 - 8.0 / 8, 1e-6) << "each side has the chord of the other";
    EXPECT_NEAR(at(0, 1, 0, 1.5), 4 - 8.0 / 8, 1e-6);
    EXPECT_NEAR(at(0, -1, 0, 0.5), 0, 1e-6) << "each side has its own chord";
    EXPECT_NEAR(at(0, -1, 0, 1.5), 4, 1e-6);
    EXPECT_NEAR(at(0, 0, 1, 0.5), 0, 1e-6) << "both have the chord before";
    EXPECT_NEAR(at(0, 0, 1, 1.5), 4 - 8.0 / 8, 1e-6);
    EXPECT_NEAR(at(0, 0, -1, 0.5), 0 - 8.0 / 8, 1e-6) << "both have the chord after";
    EXPECT_NEAR(at(0, 0, -1, 1.5), 4, 1e-6);
}

TEST(FbxTangents, OfAutomaticKeys) {
    const auto all = [](std::int64_t flags) { return std::vector<std::int64_t>(3, flags); };
    // Chords 1 and 4, over both keys 13 / 4; a quarter of the time lies before the middle key.
    const std::vector<double> times{0, 1, 4};
    const std::vector<double> values{0, 1, 13};
    const double smooth = (13.0 / 4 + (0.75 * 1 + 0.25 * 4)) / 2;
    EXPECT_NEAR(keyed_x({times, values, all(kAuto)}, 0.5), 0.5 + (1 - smooth) / 8, 1e-6);
    EXPECT_NEAR(keyed_x({times, values, all(kAuto)}, 2.5), 7 + 3 * (smooth - 4) / 8, 1e-6);
    EXPECT_NEAR(keyed_x({times, values, all(kAuto | kTimeIndependent)}, 0.5), 0.5 + (1 - 13.0 / 4) / 8, 1e-6);
    EXPECT_NEAR(keyed_x({times, values, all(kAuto | kTimeIndependent)}, 2.5), 7 + 3 * (13.0 / 4 - 4) / 8, 1e-6);
    // A bias of 50 % lies halfway to the chord after the key; of -50 % to the one before.
    const auto biased = [&](double percent) {
        return keyed_x({times, values, all(kAuto), {{0, -percent}, {percent, 0}, {0, 0}}}, 0.5);
    };
    EXPECT_NEAR(biased(50), 0.5 + (1 - (smooth + 4) / 2) / 8, 1e-6);
    EXPECT_NEAR(biased(-50), 0.5 + (1 - (smooth + 1) / 2) / 8, 1e-6);
}

TEST(FbxTangents, OfClampedKeysDoNotOvershoot) {
    const auto all = [](std::int64_t flags) { return std::vector<std::int64_t>(3, flags); };
    // Equal neighbours: slopes 0 and 2 if not clamped.
    EXPECT_NEAR(keyed_x({{0, 1, 2}, {5, 5, 9}, all(kAuto)}, 0.5), 5 - 2.0 / 8, 1e-6);
    EXPECT_NEAR(keyed_x({{0, 1, 2}, {5, 5, 9}, all(kAuto | kClamped)}, 0.5), 5, 1e-6);
    EXPECT_NEAR(keyed_x({{0, 1, 2}, {5, 6, 9}, all(kAuto | kClamped)}, 0.5), 5.5 + (1 - 2.0) / 8, 1e-6);
    // The middle key would have a slope of 6.5; a handle of a third of a second reaches the value before with 3.
    EXPECT_NEAR(keyed_x({{0, 1, 2}, {0, 1, 13}, all(kAuto | kProgressive)}, 0.5), 0.5 - 3.0 / 8, 1e-5);
    // A peak is flat, and so are the ends.
    EXPECT_NEAR(keyed_x({{0, 1, 2}, {0, 8, 0}, all(kAuto | kProgressive)}, 0.5), 4, 1e-6);
    for (double t = 0; t <= 2; t += 0.05) {
        EXPECT_LE(keyed_x({{0, 1, 2}, {0, 8, 6}, all(kAuto | kProgressive)}, t), 8 + 1e-6) << t;
    }
}

TEST(FbxTangents, MayBeWeightedOnOneSide) {
    // Handles of 0.8 and a third, or of a third and 0.1: with flat tangents the parameter 1/2 is half of the values.
    const Keys keys{{0, 2}, {0, 4}, {kUser, kUser}, {{0, 0}, {0, 0}}, {{0.8, 0.1}}};
    const auto at = [&](std::int64_t flag, double seconds) {
        return changed_x(keys, seconds, [flag](FbxWrite& curve) {
            std::get<std::vector<std::int64_t>>(curve.inside[2].values[0])[0] = kUser | flag;
        });
    };
    const auto time_of_half = [](double after, double before) {
        return 2 * (3.0 / 8 * after + 3.0 / 8 * (1 - before) + 1.0 / 8);
    };
    EXPECT_NEAR(at(0x1000000, time_of_half(0.8, 1.0 / 3)), 2, 1e-5);
    EXPECT_NEAR(at(0x2000000, time_of_half(1.0 / 3, 0.1)), 2, 1e-5);
    EXPECT_NEAR(at(0x3000000, time_of_half(0.8, 0.1)), 2, 1e-5);
    EXPECT_NEAR(at(0, 1), 2, 1e-5);
}

TEST(FbxKeys, ShareTheirAttributesInRuns) {
    // Two linear keys, three stepped ones, a linear one.
    const Keys keys{{0, 1, 2, 3, 4, 5}, {0, 10, 20, 30, 40, 50}};
    const auto at = [&](double seconds) {
        return changed_x(keys, seconds, [](FbxWrite& curve) {
            curve.inside[2].values = {std::vector<std::int64_t>{kLinear, kStepped, kLinear}};
            curve.inside[3].values = {std::vector<std::uint32_t>(12, 0)};
            curve.inside[4].values = {std::vector<std::int64_t>{2, 3, 1}};
        });
    };
    const std::array<double, 5> right{5, 15, 20, 30, 40};
    for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(at(static_cast<double>(i) + 0.5), right[i], 1e-9) << i;
}

TEST(FbxKeys, OfOneTimeCountFromTheLastOn) {
    const Keys keys{{0, 1, 1, 2}, {0, 2, 10, 12}};
    EXPECT_NEAR(keyed_x(keys, 0.5), 1, 1e-9);
    EXPECT_NEAR(keyed_x(keys, 1), 10, 1e-9);
    EXPECT_NEAR(keyed_x(keys, 1.5), 11, 1e-9);
    EXPECT_NEAR(keyed_x({{0, 1, 1, 1, 2}, {0, 2, -9, 10, 12}, {kUser, kUser, kUser, kUser, kUser}}, 1.5), 11, 1e-6);
}

TEST(FbxKeys, GoBackAsTheFileSays) {
    // The hand's curve rises from 10 to 13 from 1 s to 2 s; the walk begins at 0.
    const auto y_at = [](std::int64_t letter, std::int64_t times, double seconds) {
        Walk walk;
        walk.scene.animate(walk.base, walk.hand, "Lcl Translation",
                           {{"Y", Keys{{1, 2}, {10, 13}, {}, {}, {}, {{"Pre-Extrapolation", {letter, times}}}}}});
        return place(walk.scene, "Hand", seconds).y;
    };
    EXPECT_NEAR(y_at('C', -1, 0.75), 10, 1e-9) << "constant";
    EXPECT_NEAR(y_at('R', -1, 0.75), 12.25, 1e-9) << "repeats";
    EXPECT_NEAR(y_at('M', -1, 0.75), 10.75, 1e-9) << "mirrors";
    EXPECT_NEAR(y_at('A', -1, 0.75), 9.25, 1e-9) << "repeats and rises";
    EXPECT_NEAR(y_at('K', -1, 0.75), 9.25, 1e-9) << "goes on with its slope";
    EXPECT_NEAR(y_at('Q', -1, 0.75), 10, 1e-9) << "an unknown rule is constant";
}

TEST(FbxKeys, MayMoveSeveralNodes) {
    Scene scene;
    const std::int64_t hips = scene.model("Hips", 0);
    const std::int64_t hand = scene.model("Hand", hips);
    const std::int64_t layer = scene.layer(scene.stack("t"));
    scene.animate(layer, hips, "Lcl Translation", {{"X", line(0, 4)}});
    const std::int64_t curve = scene.curve(line(0, 6));
    scene.animate(layer, hand, "Lcl Translation", {});
    // The curve node of the hand is the last object; the curve and it are joined for two axes.
    const auto node = std::get<std::int64_t>(scene.objects().inside.back().values[0]);
    scene.connect(curve, node, "d|Y");
    scene.connect(curve, node, "d|Z");
    expect_place(place(scene, "Hand", 1), 2, 3, 3);
}

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

}  // namespace
}  // namespace mobbscope
