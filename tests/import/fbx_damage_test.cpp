// FBX files with absurd numbers: what they claim, how deep they are, what is connected with what.
#include "fbx_scene.h"

#include <base/error.h>
#include <import/import.h>
#include <support/temp_folder.h>

#include <chrono>
#include <limits>

namespace mobbscope {
namespace {

using namespace testing::fbx;

/// Imports bytes; what was said against them, one line, or nothing.
std::string said_against(const std::string& bytes) {
    const TempFolder folder;
    try {
        import_clips(folder.write("clip.fbx", bytes), {});
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), message.npos) << message;
        return message;
    }
    return "";
}

void expect_said(const std::string& bytes, const std::string& words) {
    const std::string message = said_against(bytes);
    EXPECT_NE(message.find("clip.fbx"), message.npos) << message;
    EXPECT_NE(message.find(words), message.npos) << message;
}

/// A number of 4 or 8 bytes, written over what is there.
std::string overwritten(std::string bytes, std::size_t at, std::uint64_t number, std::size_t width) {
    for (std::size_t i = 0; i < width; ++i) bytes[at + i] = static_cast<char>(number >> (8 * i) & 0xff);
    return bytes;
}

/// The walk with one part of its curve replaced.
Walk walk_with(std::size_t part, const FbxWritten& value) {
    Walk walk;
    for (FbxWrite& object : walk.scene.objects().inside) {
        if (object.name == "AnimationCurve") object.inside[part].values = {value};
    }
    return walk;
}

constexpr std::size_t kFirstRecord = 27;  // byte

TEST(FbxDamage, RecordsThatEndElsewhere) {
    for (const int version : {7400, 7500}) {
        const std::size_t width = version < 7500 ? 4 : 8;
        const std::string sound = Walk().scene.bytes({version});
        EXPECT_EQ(said_against(sound), "");
        for (const std::uint64_t end : {std::uint64_t{1}, std::uint64_t{kFirstRecord}, std::uint64_t{sound.size() + 1},
                                        std::uint64_t{0xffffffff}}) {
            expect_said(overwritten(sound, kFirstRecord, end, width), "byte 27: the record ends outside");
        }
        if (width == 8) {
            expect_said(overwritten(sound, kFirstRecord, ~std::uint64_t{0}, width), "byte 27: the record ends outside");
        }
        // More values than bytes, and more bytes of values than the record has.
        expect_said(overwritten(sound, kFirstRecord + width, 0xffffffff, width), "is cut off");
        expect_said(overwritten(sound, kFirstRecord + 2 * width, 0xffffffff, width), "the record ends outside");
    }
}

TEST(FbxDamage, RecordsInsideEachOther) {
    // 100,000 binary ones: 14 bytes each to begin, 13 to end.
    const auto begin = std::chrono::steady_clock::now();
    constexpr std::size_t kDepth = 100'000;
    constexpr std::size_t kHead = 14;
    constexpr std::size_t kEnd = 13;
    std::string bytes = testing::fbx_bytes({}).substr(0, kFirstRecord);
    for (std::size_t i = 0; i < kDepth; ++i) {
        std::string head(kHead, '\0');
        head[12] = 1;
        head[13] = 'a';
        bytes += overwritten(head, 0, kFirstRecord + kDepth * kHead + (kDepth - i) * kEnd, 4);
    }
    bytes.append((kDepth + 1) * kEnd, '\0');
    expect_said(bytes, "holds no animation");
    bytes.resize(bytes.size() / 2);
    expect_said(bytes, "the record ends outside");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(FbxDamage, ArraysThatClaimTooMuch) {
    const std::string text = Walk().scene.bytes({7400, true});
    const std::size_t at = text.find("KeyTime: *2");
    ASSERT_NE(at, text.npos);
    for (const char* count : {"2147483648", "9223372036854775807", "3", "0"}) {
        std::string claiming = text;
        claiming.replace(at, 11, std::string("KeyTime: *") + count);
        expect_said(claiming, std::string("claims ") + count + " numbers");
    }
    for (const char* count : {"-1", "x", "99999999999999999999"}) {
        std::string claiming = text;
        claiming.replace(at, 11, std::string("KeyTime: *") + count);
        EXPECT_NE(said_against(claiming), "") << count;
    }
    for (const FbxForm form : {FbxForm{7400}, FbxForm{7400, false, true}, FbxForm{7500}}) {
        const std::string binary = Walk().scene.bytes(form);
        const std::size_t count = binary.find("KeyTimel") + 8;
        EXPECT_NE(said_against(overwritten(binary, count, 0x80000000, 4)), "");
        EXPECT_NE(said_against(overwritten(binary, count + 4, 2, 4)), "") << "an unknown packing";
        EXPECT_NE(said_against(overwritten(binary, count + 8, 0xffffffff, 4)), "") << "bytes beyond the file";
    }
}

TEST(FbxDamage, NumbersThatNoClipHas) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double huge = std::numeric_limits<double>::infinity();
    for (const bool is_text : {false, true}) {
        for (const double value : {nan, huge, -huge, 1e300}) {
            const Walk walk = walk_with(1, std::vector<double>{0, value});
            EXPECT_NE(said_against(walk.scene.bytes({7400, is_text})), "") << value;
        }
        using Integers = std::vector<std::int64_t>;
        constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
        constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
        for (const Integers& times : {Integers{0, 1'000'000'000'000'000'000}, Integers{0, kMost}, Integers{kLeast, 0},
                                      Integers{kLeast, kMost}}) {
            EXPECT_NE(said_against(walk_with(0, times).scene.bytes({7400, is_text})), "") << times[1];
        }
        // Late, but short.
        EXPECT_EQ(said_against(walk_with(0, Integers{92'372'316'000'000, 92'372'316'000'002}).scene.bytes()), "");
    }
    // Handles without an end; the pose between the keys is what no clip can have.
    const Walk steep = walk_with(3, std::vector<std::uint32_t>{0x7f800000, 0x7fc00000, 0xffffffff, 0, 0, 0, 0, 0});
    EXPECT_EQ(said_against(steep.scene.bytes()), "") << "linear keys have no handles";
    Walk handles = steep;
    for (FbxWrite& object : handles.scene.objects().inside) {
        if (object.name == "AnimationCurve") object.inside[2].values = {std::vector<std::int64_t>{0x3000408, 0x408}};
    }
    EXPECT_NE(said_against(handles.scene.bytes()), "");
}

TEST(FbxDamage, CurvesWithoutKeysMoveNothing) {
    Walk walk;
    for (FbxWrite& object : walk.scene.objects().inside) {
        if (object.name != "AnimationCurve") continue;
        for (FbxWrite& part : object.inside) part.values = {std::vector<std::int64_t>{}};
    }
    for (const bool is_text : {false, true}) expect_said(walk.scene.bytes({7400, is_text}), "moves no node");
    Walk bare;
    for (FbxWrite& object : bare.scene.objects().inside) {
        if (object.name == "AnimationCurve") object.inside.clear();
    }
    expect_said(bare.scene.bytes(), "moves no node");
}

TEST(FbxDamage, ObjectsOfOneIdAreTheFirst) {
    Walk walk;
    FbxWrite& second =
        walk.scene.objects().add({"Model", {walk.hips, std::string("Model::Other"), std::string("Null")}});
    second.add(properties({{"Lcl Translation", vector(7, 7, 7)}}));
    expect_place(walk.hips_at(1), 2, 0, 0);
    expect_place(walk.hand_at(1), 2, 0, 1);
}

TEST(FbxDamage, ConnectionsThatMeanNothing) {
    Walk walk;
    walk.scene.connect(walk.hand, 987'654);
    walk.scene.connect(987'654, walk.hips);
    walk.scene.connect(987'654, walk.hips, "Lcl Rotation");
    walk.scene.connect(walk.base, walk.base);
    walk.scene.connect(walk.stack, walk.base);
    walk.scene.connect(walk.hips, walk.base, "Weight");
    walk.scene.connect(walk.hand, walk.hand, "Lcl Translation");
    walk.scene.connect(walk.base, walk.hips, "Lcl Scaling");
    expect_place(walk.hips_at(1), 2, 0, 0);
    expect_place(walk.hand_at(1), 2, 0, 1);
}

TEST(FbxDamage, OneCurveForManyAxesIsReadOnce) {
    // 2,000 keys, connected 20,000 times.
    const auto begin = std::chrono::steady_clock::now();
    Walk walk;
    Keys keys;
    for (int i = 0; i < 2'000; ++i) {
        keys.seconds.push_back(i / 1'000.0);
        keys.values.push_back(i);
    }
    const std::int64_t curve = walk.scene.curve(keys);
    walk.scene.animate(walk.base, walk.hand, "Lcl Rotation", {{"X", line(0, 90)}});
    const std::int64_t node = curve + 1;
    for (int i = 0; i < 20'000; ++i) walk.scene.connect(curve, node, "d|Y");
    EXPECT_EQ(said_against(walk.scene.bytes()), "");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(FbxDamage, SmallFilesTakeLittleMemory) {
    // Zeros pack to a thousandth, and each key takes some 140 bytes where it is stored as one or two.
    for (const std::size_t count : {std::size_t{1'000'000}, std::size_t{3'000'000}}) {
        Scene scene;
        const std::int64_t hips = scene.model("Hips", 0);
        scene.animate(scene.layer(scene.stack("t")), hips, "Lcl Translation", {{"X", line(0, 4)}});
        for (FbxWrite& object : scene.objects().inside) {
            if (object.name == "AnimationCurve") {
                object.inside[0].values = {std::vector<std::int64_t>(count, 0)};
                object.inside[1].values = {std::vector<double>(count, 0)};
                object.inside.resize(2);
            }
        }
        FbxForm packed{7400};
        packed.is_packed = true;
        expect_said(scene.bytes(packed), "too many for this file");
    }
}

TEST(FbxDamage, LayersAreWork) {
    // 2,000 layers over one node for nine hours: minutes, if each joint and sample counted once.
    Scene scene;
    const std::int64_t hips = scene.model("Hips", 0);
    const std::int64_t stack = scene.stack("t", {{"LocalStop", choice(std::llround(33'000 * kTicks))}});
    for (int i = 0; i < 2000; ++i) scene.animate(scene.layer(stack), hips, "Lcl Translation", {{"X", line(0, 4)}});
    expect_said(scene.bytes(), "needs 2000 joints and layers of curves for each of 990001 frames, which is too much");
}

TEST(FbxDamage, CurvesThatManyStacksShareAreBounded) {
    Scene scene;
    const std::int64_t hips = scene.model("Hips", 0);
    Keys keys;
    for (int i = 0; i < 20'000; ++i) {
        keys.seconds.push_back(i * 1e-3);
        keys.values.push_back(0);
    }
    const std::int64_t shared = scene.curve(keys);
    for (int i = 0; i < 600; ++i) {
        const std::int64_t stack = scene.stack("t");
        scene.connect(shared, scene.animate(scene.layer(stack), hips, "Lcl Translation", {}), "d|X");
    }
    expect_said(scene.bytes(), "its animation stacks share curves of too many keys");
}

}  // namespace
}  // namespace mobbscope
