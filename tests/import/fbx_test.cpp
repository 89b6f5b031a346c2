// FBX documents: every form of one, damage, and the files of the shared data. More real files: motion_data_test.cpp.
#include "fbx_scene.h"

#include <base/error.h>
#include <import/fbx/fbx.h>
#include <import/import.h>
#include <support/folders.h>
#include <support/input_error.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <chrono>
#include <cmath>

namespace mobbscope {
namespace {

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
    for (const int version : {3000, 5800, 6000, 7000}) {
        for (const bool is_text : {false, true}) {
            const std::string message = refusal(Walk().scene.bytes({version, is_text}));
            EXPECT_NE(message.find("clip.fbx: is FBX " + std::to_string(version / 1000) + "."), message.npos)
                << message;
            EXPECT_NE(message.find("export it again as FBX 7.4"), message.npos) << message;
        }
    }
    EXPECT_NE(refusal("; FBX 6.0.0 project file\nFBXHeaderExtension: {\n}\n").find("is FBX 6.0"), std::string::npos);
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
                const MotionFile file = parse_fbx(mutated(bytes, random), "clip.fbx");
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
    EXPECT_NE(message_with(0, std::string("soon")).find("which is not a number"), std::string::npos);
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
    EXPECT_EQ(refusal(walk.scene.bytes()),
              "clip.fbx: Connections: 'Hips', one of 2 nodes, is its own ancestor; export the file again");
    Walk own;
    own.scene.connect(own.hips, own.hips);
    EXPECT_NE(refusal(own.scene.bytes()).find("'Hips', one of 2 nodes, is its own ancestor"), std::string::npos);
}

TEST(FbxDocuments, WithoutAnimationThereIsNoClip) {
    Scene scene;
    scene.model("Hips", 0);
    EXPECT_NE(refusal(scene.bytes()).find("holds no animation"), std::string::npos);
    scene.layer(scene.stack("Take 001"));
    const MotionFile still = parse_fbx(scene.bytes(), "clip.fbx");
    EXPECT_NE(input_error([&] { still.motion(0, 0); }).find("moves no node"), std::string::npos);
}

// ---- files

TEST(FbxFiles, ThePublicOnesGiveTheirValues) {
    const std::filesystem::path folder = kSharedData / "public";
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
    const TempFolder folder;
    const Scene scene = Walk().scene;
    for (const bool is_text : {false, true}) {
        EXPECT_EQ(import_clips(folder.write("walk", scene.bytes({7400, is_text})), {}).at(0).facts.format, "fbx");
    }
    EXPECT_TRUE(looks_like_fbx("; a comment\n\n; another\nFBXHeaderExtension:  {"));
    EXPECT_FALSE(looks_like_fbx("a,b\n1,FBXHeaderExtension\n"));
}

TEST(FbxFiles, DamagedRealOnesAreReadOrRefused) {
    const std::filesystem::path original = kSharedData / "fbx/huesitos.fbx";
    if (!std::filesystem::exists(original)) GTEST_SKIP() << "no test data at " << original;
    const std::string bytes = slurp(original);
    std::mt19937 random(20250305);
    for (int round = 0; round < 300; ++round) {
        try {
            parse_fbx(mutated(bytes, random), "clip.fbx");
        } catch (const InputError& error) {
            EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace mobbscope
