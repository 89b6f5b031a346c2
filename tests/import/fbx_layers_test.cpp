// FBX animation stacks and their layers: how layers go over each other, and how long a stack lasts.
#include "fbx_scene.h"

#include <import/import.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

namespace mobbscope {
namespace {

using namespace testing::fbx;

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
    EXPECT_EQ(file.animations, (std::vector<std::string>{"Take 001", "Run", "empty"}));
    EXPECT_EQ(file.moved(2).nothing, "moves no node; give a clip that does");
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
    EXPECT_EQ(times(-1e7, 1e7), std::pair(1.0, 2.0)) << "programs write that for without end";
}

TEST(FbxLayers, APoseThatIsHeldForLongIsSaid) {
    const auto warnings = [](double stop) {
        Scene scene;
        const std::int64_t hips = scene.model("Hips", 0);
        const std::int64_t stack =
            scene.stack("t", {{"LocalStart", choice(0)}, {"LocalStop", choice(std::llround(stop * kTicks))}});
        scene.animate(scene.layer(stack), hips, "Lcl Translation", {{"X", line(0, 4)}});
        return parsed(scene).motion(0, 0)->warnings();
    };
    EXPECT_TRUE(warnings(2).empty());
    EXPECT_TRUE(warnings(2.4).empty());
    ASSERT_EQ(warnings(30).size(), 1u);
    EXPECT_EQ(
        warnings(30)[0],
        "it plays from 0 s to 30 s (LocalStart, LocalStop), but its keys are from 0 s to 2 s: a pose is held until "
        "there; trim it if that is not meant");
    ASSERT_EQ(warnings(1e8).size(), 1u);
    EXPECT_NE(warnings(1e8)[0].find("its keys alone count"), std::string::npos);
}

TEST(FbxLayers, EmptyStacksAreLeftOutAndKeepTheirNumbers) {
    Scene scene;
    scene.layer(scene.stack("mixamo.com"));
    for (int i = 0; i < 5; ++i) scene.layer(scene.stack("empty"));
    const std::int64_t hips = scene.model("Hips", 0);
    scene.animate(scene.layer(scene.stack("Walk")), hips, "Lcl Translation", {{"X", line(0, 4)}});
    const TempFolder folder;
    const auto file = folder.write("clip.fbx", scene.bytes());
    const std::vector<ImportedClip> clips = import_clips(file, {});
    ASSERT_EQ(clips.size(), 1u);
    EXPECT_EQ(clips[0].name, "Walk");
    std::vector<std::string> left_out;
    for (const ImportWarning& warning : clips[0].facts.warnings) {
        if (warning.text.find("left out") != std::string::npos) left_out.push_back(warning.text);
    }
    ASSERT_EQ(left_out.size(), 4u);
    EXPECT_EQ(left_out[0], "animation 'mixamo.com' is left out: it moves no node; give a clip that does");
    EXPECT_EQ(left_out[3], "3 more animations are left out");
    ImportOptions sixth;
    sixth.animation = "6";
    EXPECT_EQ(import_clips(file, sixth).at(0).name, "Walk");
    for (const OptionOffer& offer : parse_clip_file(file).offer({}).options)
        EXPECT_NE(offer.key, "animation") << "one choice";
}

TEST(FbxLayers, WhyNothingMovesIsSaid) {
    Scene scene;
    const std::int64_t hips = scene.model("Hips", 0);
    const std::int64_t base = scene.layer(scene.stack("Take 001"), {{"Mute", choice(1)}});
    scene.animate(base, hips, "Lcl Translation", {{"X", line(0, 4)}});
    EXPECT_EQ(input_error([&] { parsed(scene).motion(0, 0); }),
              "clip.fbx: animation 'Take 001': moves no node, as the layer 'over' is muted: it was left out; give a "
              "clip that does");
}

}  // namespace
}  // namespace mobbscope
