// What an agent played, exported, read again and measured here by itself: where its moves join it keeps the bound that
// is promised, and the program tells the same figures.
#include "run_program.h"

#include <import/import.h>
#include <import/skeleton/motion.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// Every frame of a motion file, in the world.
struct ReadMotion {
    double dt = 0;
    std::vector<std::vector<glm::dvec3>> joints;
    std::vector<glm::dquat> root;
    std::vector<glm::dvec2> centre;

    explicit ReadMotion(const std::string& file) {
        const ImportedClip clip = import_clips(file, {}).front();
        dt = clip.clip->dt();
        for (int i = 0; i < clip.clip->count(); ++i) {
            const mobb::Disk& disk = clip.clip->samples()[static_cast<std::size_t>(i)];
            centre.emplace_back(disk.x, disk.y);
            joints.emplace_back();
            for (const glm::vec3& p : clip.skeleton->at(i)) joints.back().emplace_back(p.x + disk.x, p.y + disk.y, p.z);
            root.emplace_back(clip.skeleton->rotations_at(i)[static_cast<std::size_t>(clip.skeleton->root)]);
        }
    }

    double step(std::size_t to, std::size_t joint) const {
        return glm::distance(joints[to - 1][joint], joints[to][joint]);
    }
    /// Degrees about the vertical.
    double turn(std::size_t to) const {
        const glm::dmat3 m = glm::mat3_cast(glm::normalize(root[to] * glm::inverse(root[to - 1])));
        return std::abs(std::atan2(m[0].y - m[1].x, m[0].x + m[1].y)) * 180 / 3.14159265358979;
    }
    /// Of the root's velocity between the steps before and after a frame, metres per second.
    double bend(std::size_t middle) const {
        return glm::length(centre[middle + 1] - 2.0 * centre[middle] + centre[middle - 1]) / dt;
    }
};

/// The frames of one play: [begin, end).
struct PlayedFrames {
    std::size_t begin;
    std::size_t end;
    bool forced;
};

/// Largest ratios at the joins of an agent's plays.
struct JoinRatios {
    double step = 0;
    double turn = 0;
    double bend = 0;
    int joins = 0;
};

template <class Value>
double largest_within(const PlayedFrames& a, const PlayedFrames& b, std::size_t skip_first, std::size_t skip_last,
                      Value value) {
    double out = 0;
    for (const PlayedFrames& play : {a, b}) {
        for (std::size_t i = play.begin + skip_first; i + skip_last < play.end; ++i) out = std::max(out, value(i));
    }
    return out;
}

// What the format rounds: five digits of a metre, and of a degree.
constexpr double kRoundedStep = 5e-5;
constexpr double kRoundedTurn = 1e-2;
constexpr double kRoundedBend = 5e-3;

JoinRatios ratios_of(const ReadMotion& motion, const std::vector<PlayedFrames>& plays) {
    JoinRatios out;
    const auto raise = [](double& largest, double across, double rounding, double inside) {
        largest = std::max(largest, (across - rounding) / inside);
    };
    for (std::size_t p = 1; p < plays.size(); ++p) {
        if (plays[p].forced) continue;
        const PlayedFrames& a = plays[p - 1];
        const PlayedFrames& b = plays[p];
        const std::size_t first = b.begin;
        ++out.joins;
        for (std::size_t joint = 0; joint < motion.joints.front().size(); ++joint) {
            const auto step = [&](std::size_t i) { return motion.step(i, joint); };
            raise(out.step, step(first), kRoundedStep, std::max(0.002, largest_within(a, b, 1, 0, step)));
        }
        const auto turn = [&](std::size_t i) { return motion.turn(i); };
        raise(out.turn, turn(first), kRoundedTurn, std::max(0.2, largest_within(a, b, 1, 0, turn)));
        const auto bend = [&](std::size_t i) { return motion.bend(i); };
        const double across = std::max(bend(first - 1), bend(first));
        raise(out.bend, across, kRoundedBend, std::max(0.02, largest_within(a, b, 1, 1, bend)));
    }
    return out;
}

std::vector<PlayedFrames> frames_of(const Scene& scene, const CrowdAgent& agent) {
    std::vector<PlayedFrames> out;
    std::size_t frame = 0;
    for (const Play& play : agent.plays) {
        const int clip = scene.graph->moves[static_cast<std::size_t>(play.move)].clip;
        const auto count = static_cast<std::size_t>(scene.clips[static_cast<std::size_t>(clip)].clip->count());
        out.push_back({frame, frame + count, play.kind == PlayKind::forced});
        frame += count;
    }
    return out;
}

class PlayedJoins : public ::testing::Test {
  protected:
    void SetUp() override { ASSERT_EQ(run_program({"graph", "build", kClips, "-o", graph}).status, 0); }

    /// Lets a crowd play; gives the summary.
    nlohmann::json simulate(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"simulate", graph,       "-o", run,     "--area",
                                           "15x15",    "--seconds", "40", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Result result = run_program(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return nlohmann::json::parse(result.out);
    }

    /// Of what an agent of the run played, written to a file and read again.
    JoinRatios exported(const Scene& scene, std::size_t agent, const std::string& extension) const {
        const CrowdAgent& of = scene.crowd->agents[agent];
        const std::string file = folder.path() / (of.name + extension);
        EXPECT_EQ(run_program({"convert", run, "--agent", of.name, "-o", file}).status, 0);
        const ReadMotion motion(file);
        const std::vector<PlayedFrames> plays = frames_of(scene, of);
        EXPECT_EQ(motion.root.size(), plays.back().end);
        return ratios_of(motion, plays);
    }

    TempFolder folder;
    const std::string graph = folder.path() / "graph.json";
    const std::string run = folder.path() / "run.json";
};

TEST_F(PlayedJoins, HaveTheFiguresThatSimulateTells) {
    for (const char* seed : {"1", "2"}) {
        const nlohmann::json told = simulate({"--agents", "1", "--seed", seed})["continuity"];
        ASSERT_GE(told["measured"], 5);
        const JoinRatios found = exported(load_scene(run), 0, ".bvh");
        EXPECT_EQ(found.joins, told["measured"]);
        const auto expect_same = [](double measured, const nlohmann::json& change) {
            const double ratio = change["ratio"];
            EXPECT_NEAR(measured, ratio, 0.03 + 0.01 * ratio);  // a file has nine digits
        };
        expect_same(found.step, told["joint_position"]);
        expect_same(found.turn, told["heading"]);
        expect_same(found.bend, told["root_velocity"]);
    }
}

TEST_F(PlayedJoins, KeepTheBoundInTheExportedMotion) {
    const nlohmann::json continuity = simulate({"--agents", "20"})["continuity"];
    ASSERT_FALSE(continuity["bound"].is_null()) << "the graph's moves are warped, so they promise a bound";
    const double bound = continuity["bound"];
    const Scene scene = load_scene(run);
    for (const std::size_t agent : {std::size_t{2}, std::size_t{16}}) {
        for (const char* extension : {".bvh", ".glb"}) {
            const JoinRatios found = exported(scene, agent, extension);
            EXPECT_GE(found.joins, 5);
            EXPECT_LE(found.step, bound) << "agent " << agent << extension;
            EXPECT_LE(found.turn, bound) << "agent " << agent << extension;
            EXPECT_LE(found.bend, bound) << "agent " << agent << extension;
        }
    }
}

}  // namespace
}  // namespace mobbscope
