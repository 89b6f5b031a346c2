// FBX nodes against poses worked out by hand: the whole transform chain, what is inherited, axes and unit of the file.
#include "fbx_scene.h"

#include <import/import.h>
#include <support/temp_folder.h>

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numbers>

namespace mobbscope {
namespace {

using namespace testing::fbx;

TEST(FbxChains, RotateInEachOrder) {
    // Quarter turns about all three axes; (1, 2, 3) turned by hand, axis by axis.
    const std::array<glm::dvec3, 6> right{{{3, 2, -1}, {2, 1, -3}, {-2, 1, 3}, {-1, 3, 2}, {1, -3, 2}, {3, -2, 1}}};
    for (std::size_t order = 0; order < right.size(); ++order) {
        const Walk walk({{"Lcl Rotation", vector(90, 90, 90)},
                         {"RotationOrder", choice(static_cast<std::int64_t>(order))},
                         {"RotationActive", choice(1)}},
                        {{"Lcl Translation", vector(1, 2, 3)}});
        expect_place(walk.hand_at(0), right[order].x, right[order].y, right[order].z, "order " + std::to_string(order));
        const Walk inactive({{"Lcl Rotation", vector(90, 90, 90)},
                             {"RotationOrder", choice(static_cast<std::int64_t>(order))},
                             {"RotationActive", choice(0)}},
                            {{"Lcl Translation", vector(1, 2, 3)}});
        expect_place(inactive.hand_at(0), right[0].x, right[0].y, right[0].z, "inactive " + std::to_string(order));
    }
}

TEST(FbxChains, ScaleSkipsTheParentAlone) {
    // The scene is scaled by 2 in x, the hips by 2 in y; the arm hangs 10 to the side, is turned by 90 degrees and
    // scaled by 3 in y.
    const auto tip = [](std::int64_t hips_inherit, std::int64_t arm_inherit) {
        Scene scene;
        const std::int64_t top = scene.model("Armature", 0, {{"Lcl Scaling", vector(2, 1, 1)}}, "Null");
        const std::int64_t hips =
            scene.model("Hips", top, {{"Lcl Scaling", vector(1, 2, 1)}, {"InheritType", choice(hips_inherit)}});
        const std::int64_t arm = scene.model("Arm", hips,
                                             {{"Lcl Translation", vector(10, 0, 0)},
                                              {"Lcl Rotation", vector(0, 0, 90)},
                                              {"Lcl Scaling", vector(1, 3, 1)},
                                              {"InheritType", choice(arm_inherit)}});
        scene.model("Tip", arm, {{"Lcl Translation", vector(1, 1, 0)}});
        scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Translation", {{"Z", line(0, 4)}});
        return place(scene, "Tip", 0);
    };
    // By its own scale the tip is at (1, 3), turned at (-3, 1).
    expect_place(tip(1, 1), 2 * (10 - 3), 2 * 1, 0, "all matrices");
    expect_place(tip(1, 2), 2 * (10 - 3), 1, 0, "but for that of the hips");
    // Along the axes: hips (2, 2), arm (2, 6), the tip at (2, 6), turned at (-6, 2).
    expect_place(tip(0, 0), 20 - 6, 2, 0, "all scales along axes");
    // The arm has the armature's scale, not that of the hips: (2, 3), so (-3, 2).
    expect_place(tip(0, 2), 20 - 3, 2, 0, "but for that of the hips, along axes");
}

TEST(FbxChains, ScaleThatMovesIsInheritedInTime) {
    for (const std::int64_t inherit : {0, 1, 2}) {
        Scene scene;
        const std::int64_t hips = scene.model("Hips", 0);
        const std::int64_t shin = scene.model("Shin", hips,
                                              {{"Lcl Translation", vector(1, 0, 0)},
                                               {"Lcl Rotation", vector(0, 0, 90)},
                                               {"InheritType", choice(inherit)}});
        scene.model("Foot", shin, {{"Lcl Translation", vector(1, 1, 0)}});
        scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Scaling", {{"X", line(1, 3)}},
                      {{"d|Y", scalar(1)}, {"d|Z", scalar(1)}});
        expect_place(place(scene, "Foot", 0), 0, 1, 0, "unscaled");
        // A scale of 2 in x: before the turn of the shin, after it, or not of the foot.
        const std::array<glm::dvec3, 3> right{{{2 - 1, 2, 0}, {2 - 2, 1, 0}, {2 - 1, 1, 0}}};
        const glm::dvec3& it = right[static_cast<std::size_t>(inherit)];
        expect_place(place(scene, "Foot", 1), it.x, it.y, it.z, "InheritType " + std::to_string(inherit));
    }
}

TEST(FbxChains, PivotsCountAboveTheHips) {
    // Turned by 90 degrees about y round (0, 0, 5): from (2, 0, 0) to (-5, 0, 3).
    const auto hips = [](const Properties& above) {
        Scene scene;
        const std::int64_t top = scene.model("Armature", 0, above, "Null");
        const std::int64_t body = scene.model("Hips", top);
        scene.animate(scene.layer(scene.stack("t")), body, "Lcl Translation", {{"X", line(0, 4)}});
        return place(scene, "Hips", 1);
    };
    const auto turn = vector(0, 90, 0);
    expect_place(hips({{"Lcl Rotation", turn}, {"RotationPivot", vector(0, 0, 5)}}), -5, 0, 3, "pivot");
    expect_place(hips({{"Lcl Rotation", turn}, {"RotationOffset", vector(0, 0, 5)}}), 0, 0, 3, "offset");
    expect_place(hips({{"PreRotation", turn}, {"RotationActive", choice(1)}}), 0, 0, -2, "pre-rotation");
    expect_place(hips({{"PostRotation", turn}, {"RotationActive", choice(1)}}), 0, 0, 2, "post-rotation");
    expect_place(hips({{"Lcl Scaling", vector(3, 1, 1)}, {"ScalingPivot", vector(1, 0, 0)}}), 4, 0, 0, "scaling");
    expect_place(hips({{"GeometricTranslation", vector(0, 0, 5)}, {"GeometricRotation", turn}}), 2, 0, 0, "geometric");
}

TEST(FbxChains, PivotsMayMove) {
    // Half a turn about z round a pivot p carries a node to 2 p. The pivot moves as fast as the hips.
    Walk walk({{"Lcl Rotation", vector(0, 0, 180)}});
    walk.scene.animate(walk.base, walk.hips, "RotationPivot", {{"X", line(0, 4)}});
    expect_place(walk.hips_at(1), 2 + 2 * 2, 0, 0, "pivot");
    Walk offset;
    offset.scene.animate(offset.base, offset.hips, "RotationOffset", {{"Y", line(0, 8)}});
    expect_place(offset.hips_at(1), 2, 4, 0, "offset");
    Walk before({{"RotationActive", choice(1)}});
    before.scene.animate(before.base, before.hips, "PreRotation", {{"X", line(0, 180)}});
    expect_place(before.hand_at(1), 2, -1, 0, "pre-rotation");
}

TEST(FbxChains, WhatIsLeftOutOfALayerIsWhereTheNodeIs) {
    // The lowest layer is muted: the next one is added to what the node says.
    Scene scene;
    const std::int64_t hips = scene.model("Hips", 0, {{"Lcl Translation", vector(1, 5, 0)}});
    const std::int64_t stack = scene.stack("t");
    scene.animate(scene.layer(stack, {{"Mute", choice(1)}}), hips, "Lcl Translation", {{"X", line(0, 4)}});
    scene.animate(scene.layer(stack), hips, "Lcl Translation", {{"X", line(0, 20)}});
    expect_place(place(scene, "Hips", 1), 1 + 10, 5, 0);
    EXPECT_EQ(parsed(scene).motion(0, 0)->warnings().size(), 1u);
}

TEST(FbxChains, LayersOfRotationsComposeOrAdd) {
    // The base turns by 90 degrees about x, the layer about z. Composed, the layer is first: (0, 1, 0) to (-1, 0, 0),
    // which x leaves; angle by angle x is first: to (0, 0, 1), which z leaves.
    const auto hand = [](const Properties& layer) {
        Walk walk({}, {{"Lcl Translation", vector(0, 1, 0)}});
        walk.scene.animate(walk.base, walk.hips, "Lcl Rotation", {{"X", line(90, 90)}});
        walk.scene.animate(walk.scene.layer(walk.stack, layer), walk.hips, "Lcl Rotation", {{"Z", line(90, 90)}});
        return walk.hand_at(0);
    };
    const double half = std::numbers::sqrt2 / 2;
    expect_place(hand({}), -1, 0, 0, "composed");
    expect_place(hand({{"RotationAccumulationMode", choice(0)}}), -1, 0, 0, "composed");
    expect_place(hand({{"RotationAccumulationMode", choice(1)}}), 0, 0, 1, "added");
    // (0, 1, 0) turned by 45 degrees about z, then by 90 about x.
    expect_place(hand({{"Weight", scalar(50)}}), -half, 0, half, "half of it composed");
    // Angles (45, 0, 45): about x to (0, 1, 1) / sqrt 2, then about z.
    expect_place(hand({{"BlendMode", choice(2)}, {"Weight", scalar(50)}, {"RotationAccumulationMode", choice(1)}}),
                 -0.5, 0.5, half, "halfway, angle by angle");
    expect_place(hand({{"BlendMode", choice(1)}}), -1, 0, 0, "over it");
}

TEST(FbxChains, WeightsStayBetweenNoneAndAll) {
    const auto hips = [](const Keys& percent, double seconds) {
        Walk walk;
        const std::int64_t top = walk.scene.layer(walk.stack, {{"BlendMode", choice(2)}});
        walk.scene.animate(top, walk.hips, "Lcl Translation", {{"X", line(10, 10)}});
        walk.scene.animate(top, top, "Weight", {{"Weight", percent}});
        return walk.hips_at(seconds).x;
    };
    EXPECT_NEAR(hips(line(0, 400), 1), 10, 1e-9);
    EXPECT_NEAR(hips(line(-400, 0), 1), 2, 1e-9);
    EXPECT_NEAR(hips(Keys{{0, 2}, {0, 100}, {kStepped, 0}}, 1), 2, 1e-9);
    EXPECT_NEAR(hips(Keys{{0, 2}, {0, 100}, {kUser, kUser}}, 0.5), 0.84375 * 1 + 0.15625 * 10, 1e-6);
}

TEST(FbxChains, EveryAxisMayPointUp) {
    struct Case {
        const char* what;
        std::array<std::int64_t, 6> axes;  ///< up, front and right, each with its sign
        double x, y;                       ///< of (300, 50, 400) cm, in m
    };
    const Case cases[] = {
        {"y", {1, 1, 2, 1, 0, 1}, 3, -4},
        {"z", {2, 1, 1, -1, 0, 1}, 3, 0.5},
        {"x", {0, 1, 2, 1, 1, -1}, -0.5, -4},
        {"-x", {0, -1, 2, 1, 1, 1}, 0.5, -4},
        {"-z", {2, -1, 1, 1, 0, 1}, 3, -0.5},
        {"y, seen from the side", {1, 1, 0, 1, 2, -1}, -4, -3},
        {"z, left-handed", {2, 1, 1, 1, 0, 1}, 3, -0.5},
        {"y, left-handed", {1, 1, 2, -1, 0, 1}, 3, 4},
        {"y, with two axes that are one", {1, 1, 1, 1, 0, 1}, 3, -4},
        {"y, with an axis that is none", {1, 1, 7, 1, 0, 1}, 3, -4},
    };
    for (const Case& it : cases) {
        Scene scene;
        const char* const names[] = {"UpAxis",        "UpAxisSign", "FrontAxis",
                                     "FrontAxisSign", "CoordAxis",  "CoordAxisSign"};
        for (std::size_t i = 0; i < it.axes.size(); ++i) scene.setting(names[i], it.axes[i]);
        const std::int64_t hips = scene.model("Hips", 0);
        scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Translation",
                      {{"X", line(0, 300)}, {"Y", line(0, 50)}, {"Z", line(0, 400)}});
        const TempFolder folder;
        const ImportedClip clip = import_clips(folder.write("clip.fbx", scene.bytes()), {}).at(0);
        EXPECT_NEAR(clip.clip->samples().back().x, it.x, 1e-6) << it.what;
        EXPECT_NEAR(clip.clip->samples().back().y, it.y, 1e-6) << it.what;
    }
}

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
        const TempFolder folder;
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

TEST(FbxNodes, AxesThatAreNoneAreSaid) {
    const auto read = [](const std::vector<std::pair<std::string, std::int64_t>>& axes) {
        Walk walk;
        for (const auto& [name, value] : axes) walk.scene.setting(name, value);
        const TempFolder folder;
        return import_clips(folder.write("clip.fbx", walk.scene.bytes()), {}).at(0);
    };
    const auto doubt = [](const ImportedClip& clip) {
        for (const ImportWarning& warning : clip.facts.warnings) {
            if (warning.option == "up") return warning.text;
        }
        return std::string();
    };
    const ImportedClip silent = read({});
    EXPECT_EQ(silent.facts.up, "y");
    EXPECT_EQ(silent.facts.up_why, "as in most files");
    EXPECT_EQ(doubt(silent), "");
    for (const std::int64_t none : {-1, 3, 7}) {
        const ImportedClip wrong = read({{"UpAxis", none}});
        EXPECT_EQ(wrong.facts.up, "y");
        EXPECT_EQ(doubt(wrong),
                  "GlobalSettings says UpAxis " + std::to_string(none) +
                      ", FrontAxis as usual and CoordAxis as usual, which are not three axes: y was taken "
                      "as up");
    }
    const ImportedClip twice = read({{"UpAxis", 2}, {"UpAxisSign", -1}, {"FrontAxis", 2}, {"CoordAxis", 0}});
    EXPECT_EQ(twice.facts.up, "-z");
    EXPECT_EQ(
        doubt(twice),
        "GlobalSettings says UpAxis 2, FrontAxis 2 and CoordAxis 0, which are not three axes: the first was used");
    EXPECT_EQ(doubt(read({{"UpAxis", 2}, {"FrontAxis", 1}})), "") << "the third follows";
}

TEST(FbxNodes, WhatAFileLeavesOutMakesItsAxesRightHanded) {
    for (const std::int64_t up : {0, 1, 2}) {
        for (const std::int64_t sign : {1, -1}) {
            Walk walk;
            walk.scene.setting("UpAxis", up);
            walk.scene.setting("UpAxisSign", sign);
            const glm::dmat3 bare = parsed(walk.scene).ground.value();
            EXPECT_EQ(glm::determinant(bare), 1) << up << ' ' << sign;
            EXPECT_EQ(bare[static_cast<int>(up)].z, static_cast<double>(sign));
            walk.scene.setting("FrontAxis", (up + 1) % 3);
            const glm::dmat3 fronted = parsed(walk.scene).ground.value();
            EXPECT_EQ(glm::determinant(fronted), 1) << up << ' ' << sign;
            EXPECT_EQ(fronted[static_cast<int>((up + 1) % 3)].y, -1);
        }
    }
}

TEST(FbxNodes, UnitsThatAreNoneAreGuessedAndSaid) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const FbxWritten& unit : {FbxWritten{0.0}, FbxWritten{-2.54}, FbxWritten{nan}, FbxWritten{1e300},
                                   FbxWritten{1e-300}, FbxWritten{std::string("cm")}}) {
        for (const bool is_text : {false, true}) {
            Walk walk;
            walk.scene.setting("UnitScaleFactor", unit);
            const TempFolder folder;
            const auto file = folder.write("clip.fbx", walk.scene.bytes({7400, is_text}));
            const ImportedClip clip = import_clips(file, {}).at(0);
            EXPECT_TRUE(clip.facts.guessed_from_height);
            const auto of_unit = std::ranges::find(clip.facts.warnings, "unit", &ImportWarning::option);
            ASSERT_NE(of_unit, clip.facts.warnings.end());
            EXPECT_NE(of_unit->text.find("which is not a unit"), std::string::npos) << of_unit->text;
            ImportOptions given;
            given.unit = "m";
            EXPECT_EQ(import_clips(file, given).at(0).facts.unit, 1);
        }
    }
}

TEST(FbxNodes, OrdersThatAreNoneOfThreeAxesAreSaid) {
    Scene scene;
    const std::int64_t hips = scene.model("Hips", 0, {{"RotationOrder", choice(6)}});
    scene.model("Spine", hips, {{"RotationOrder", choice(9)}});
    scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Translation", {{"X", line(0, 4)}});
    const std::vector<std::string> warnings = parsed(scene).motion(0, 0)->warnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "RotationOrder of 'Hips' and 1 more node is not an order of three axes: read as XYZ");
}

}  // namespace
}  // namespace mobbscope
