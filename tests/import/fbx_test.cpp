// The FBX reader's process: what it sends, and what becomes of its crashes. Figures of real files:
// motion_data_test.cpp.
#include <base/error.h>
#include <import/nodes/node_files.h>
#include <import/nodes/node_scene.h>
#include <support/input_error.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <system_error>

namespace mobbscope {
namespace {

ChildResult shell(const std::string& script, double seconds = 10, std::size_t most = 1 << 20) {
    return run_child("/bin/sh", {"-c", script}, seconds, most);
}

TEST(ChildProcess, GivesOutputAndStatus) {
    const ChildResult result = shell("printf 'a b'; echo lost >&2; cat; exit 3");
    EXPECT_EQ(result.end, ChildEnd::exited);
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(result.output, "a b");
    EXPECT_EQ(shell("head -c 300000 /dev/zero").output, std::string(300'000, '\0'));
}

TEST(ChildProcess, TellsHowItEnded) {
    const ChildResult crashed = shell("kill -SEGV $$");
    EXPECT_EQ(crashed.end, ChildEnd::signalled);
    EXPECT_EQ(crashed.code, SIGSEGV);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(shell("exec sleep 20", 0.2).end, ChildEnd::timed_out);
    EXPECT_EQ(shell("exec cat /dev/zero", 10, 1000).end, ChildEnd::too_much_output);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    EXPECT_THROW(run_child("/no/such/program", {}, 1, 1), std::system_error);
}

NodeScene small_scene() {
    NodeScene scene;
    scene.unit = 0.01;
    scene.nodes.resize(2);
    scene.nodes[0].name = "Hips";
    scene.nodes[1].name = "Hand";
    scene.nodes[1].parent = 0;
    scene.nodes[1].matrix.offset = {30, 0, 0};
    NodeAnimation walk;
    walk.name = "Take 001";
    walk.times.last = 2;
    walk.channels.push_back({0, NodeProperty::translation, Interpolation::linear,
                             std::make_shared<std::vector<double>>(std::vector<double>{0, 1}),
                             std::make_shared<std::vector<double>>(std::vector<double>{0, 90, 0, 100, 90, 0})});
    walk.channels.push_back({0, NodeProperty::rotation, Interpolation::linear,
                             std::make_shared<std::vector<double>>(std::vector<double>{0}),
                             std::make_shared<std::vector<double>>(std::vector<double>{0, 0, 0, 1})});
    scene.animations.push_back(walk);
    return scene;
}

TEST(ScenePacket, ArrivesAsItWasSent) {
    const NodeScene scene = unpack(pack(small_scene()));
    EXPECT_EQ(scene.unit, 0.01);
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[1].name, "Hand");
    EXPECT_EQ(scene.nodes[1].matrix.offset.x, 30);
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.animations[0].times.last, 2);
    EXPECT_EQ(scene.animations[0].times.frames, 2);
    EXPECT_EQ(*scene.animations[0].channels[0].values, *small_scene().animations[0].channels[0].values);
}

TEST(ScenePacket, CarriesARefusal) {
    try {
        unpack(pack_error("no token"));
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "no token");
    }
}

TEST(ScenePacket, DamageIsNoticedOrHarmless) {
    const std::string packet = pack(small_scene());
    for (std::size_t length = 0; length < packet.size(); ++length) {
        EXPECT_THROW(unpack(std::string_view(packet).substr(0, length)), std::length_error);
    }
    std::mt19937 random(20250304);
    for (int round = 0; round < 20'000; ++round) {
        NodeScene scene;
        try {
            scene = unpack(testing::mutated(packet, random));
        } catch (const std::exception&) {
            continue;
        }
        if (scene.animations.empty() || scene.animations[0].channels.empty()) continue;
        const auto motion = node_motion_file(std::move(scene)).motion(0);
        std::vector<glm::dvec3> positions(motion->joints().size());
        motion->pose(0.5, positions);
    }
}

/// Lets another program play the reader for the time of a test.
class ReaderStandIn {
  public:
    explicit ReaderStandIn(const std::string& script) {
        const auto program = folder_.write("reader", "#!/bin/sh\n" + script + "\n");
        ::chmod(program.c_str(), 0700);
        ::setenv("MOBBSCOPE_FBX_READER", program.c_str(), 1);
    }
    ~ReaderStandIn() { ::unsetenv("MOBBSCOPE_FBX_READER"); }
    ReaderStandIn(const ReaderStandIn&) = delete;
    ReaderStandIn& operator=(const ReaderStandIn&) = delete;

    std::string message() const {
        const auto file = folder_.write("clip.fbx", "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n");
        return testing::input_error([&] { read_fbx(file); });
    }

  private:
    testing::TempFolder folder_;
};

TEST(Fbx, ACrashOfTheReaderIsOneClearLine) {
    const auto says = [](const std::string& script, const char* words) {
        const std::string message = ReaderStandIn(script).message();
        EXPECT_NE(message.find(words), std::string::npos) << message;
        EXPECT_NE(message.find("clip.fbx: "), std::string::npos) << message;
        EXPECT_NE(message.find("export it again"), std::string::npos) << message;
    };
    says("kill -SEGV $$", "crashed on it (signal 11)");
    says("kill -XCPU $$", "takes too long");
    says("exit 1", "gave up on it");
    says("printf nonsense", "holds numbers that no clip can have");
    says("printf 'MOBBERR1\\010\\0\\0\\0\\0\\0\\0\\0bad\\ntoken'", "cannot be read (bad toke)");
}

TEST(Fbx, WhatIsNoFbxIsRefusedBeforeAnythingRuns) {
    const testing::TempFolder folder;
    const auto says = [&](const std::filesystem::path& file, const char* words) {
        const std::string message = testing::input_error([&] { read_fbx(file); });
        EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    says(folder.path() / "none.fbx", "no such file");
    says(folder.write("empty.fbx", ""), "is neither binary nor text FBX");
    says(folder.write("text.fbx", "v 0 0 0\n"), "is neither binary nor text FBX");
    std::filesystem::create_directory(folder.path() / "dir.fbx");
    says(folder.path() / "dir.fbx", "is no regular file");
}

TEST(Fbx, DamagedFilesAreReadOrRefused) {
    const std::filesystem::path original = std::filesystem::path(MOBBSCOPE_SHARED_DATA) / "fbx/huesitos.fbx";
    if (!std::filesystem::exists(original)) GTEST_SKIP() << "no test data at " << original;
    const std::string bytes = testing::slurp(original);
    const testing::TempFolder folder;
    std::mt19937 random(20250305);
    for (int round = 0; round < 40; ++round) {
        const auto file = folder.write("fuzz.fbx", testing::mutated(bytes, random));
        try {
            read_fbx(file);
        } catch (const InputError& error) {
            EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace mobbscope
