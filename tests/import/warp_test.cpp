// Parts of motions, warped so that they begin and end in given poses.
#include <import/import.h>
#include <import/skeleton/disk_sampler.h>
#include <import/skeleton/warp.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

namespace mobbscope {
namespace {

constexpr double kFrame = 1.0 / 30;

bool same_disk(const mobb::Disk& a, const mobb::Disk& b) { return a.x == b.x && a.y == b.y && a.r == b.r; }

class Warp : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        const std::filesystem::path file = kClips / "wander.glb";
        ImportOptions options;
        options.trim = {5, 8};
        part_ = std::make_unique<ImportedClip>(import_clips(file, options).front());
        options.trim = {40, 41};
        other_ = std::make_unique<ImportedClip>(import_clips(file, options).front());
    }
    static void TearDownTestSuite() {
        part_.reset();
        other_.reset();
    }
    static WarpEnd end_of(const ImportedClip& from, int frame, double heading_deg) {
        return {"P", std::make_shared<const MovingPose>(moving_pose(*from.clip, *from.skeleton, frame, 0)),
                heading_deg};
    }
    /// Joints of a pose that faces a heading, from the root, as positions say.
    static std::vector<glm::dvec3> joints_at(const ImportedClip& from, int frame, double heading_deg) {
        std::vector<glm::dvec3> out;
        const glm::dquat turn = about_up(mobb::Rotation::from_degrees(heading_deg));
        for (const glm::vec3& p : from.skeleton->at(frame)) out.push_back(turn * glm::dvec3(p));
        return out;
    }
    static double farthest_apart(const std::vector<glm::dvec3>& expected, std::span<const glm::vec3> got) {
        double most = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            most = std::max(most, glm::distance(expected[i], glm::dvec3(got[i])));
        return most;
    }
    static glm::dvec3 root(const WarpedClip& clip, int frame) {
        const mobb::Disk& disk = clip.clip->samples()[static_cast<std::size_t>(frame)];
        return {disk.x, disk.y, clip.skeleton->at(frame)[static_cast<std::size_t>(clip.skeleton->root)].z};
    }

    static std::unique_ptr<ImportedClip> part_;   ///< 91 samples
    static std::unique_ptr<ImportedClip> other_;  ///< of the same skeleton, in other poses
};

std::unique_ptr<ImportedClip> Warp::part_;
std::unique_ptr<ImportedClip> Warp::other_;

TEST_F(Warp, BeginsInThePoseWithItsVelocity) {
    const ClipWarp warp{0.3, end_of(*other_, 10, 50), end_of(*other_, 20, -120)};
    const WarpedClip made = warped(*part_->clip, *part_->skeleton, warp, false);
    ASSERT_EQ(made.clip->count(), part_->clip->count() - 1);
    EXPECT_GT(farthest_apart(joints_at(*other_, 10, 50), part_->skeleton->at(0)), 0.1) << "it is not there already";
    EXPECT_LT(farthest_apart(joints_at(*other_, 10, 50), made.skeleton->at(0)), 1e-5);
    EXPECT_EQ(made.clip->samples()[0].x, part_->clip->samples()[0].x);
    EXPECT_EQ(made.clip->samples()[0].y, part_->clip->samples()[0].y);
    const glm::dvec3 velocity = about_up(mobb::Rotation::from_degrees(50)) * warp.begin.pose->velocity;
    for (int frame = 0; frame < 2; ++frame) {
        const glm::dvec3 step = root(made, frame + 1) - root(made, frame);
        EXPECT_LT(glm::distance(step, velocity * kFrame), 1e-6) << frame;
    }
}

TEST_F(Warp, EndsSoThatTheNextFrameIsInThePose) {
    const ClipWarp warp{0.3, end_of(*other_, 10, 50), end_of(*other_, 20, -120)};
    const WarpedClip made = warped(*part_->clip, *part_->skeleton, warp, false);
    const int last = made.clip->count() - 1;
    const glm::dvec3 velocity = about_up(mobb::Rotation::from_degrees(-120)) * warp.end.pose->velocity;
    const mobb::Disk& exit = part_->clip->samples().back();
    const glm::dvec3 end(exit.x, exit.y, warp.end.pose->height);
    EXPECT_LT(glm::distance(root(made, last), end - velocity * kFrame), 1e-6);
    EXPECT_LT(glm::distance(root(made, last - 1), end - 2.0 * velocity * kFrame), 1e-6);
    // The pose a frame before, but for what joints accelerate by.
    EXPECT_LT(farthest_apart(joints_at(*other_, 19, -120), made.skeleton->at(last)), 0.02);
}

TEST_F(Warp, LeavesWhatIsFarFromTheEnds) {
    const ClipWarp warp{0.3, end_of(*other_, 10, 50), end_of(*other_, 20, -120)};
    const WarpedClip made = warped(*part_->clip, *part_->skeleton, warp, false);
    int changed = 0;
    for (int frame = 0; frame < made.clip->count(); ++frame) {
        const auto i = static_cast<std::size_t>(frame);
        const bool same = same_disk(made.clip->samples()[i], part_->clip->samples()[i]) &&
                          std::ranges::equal(made.skeleton->at(frame), part_->skeleton->at(frame)) &&
                          std::ranges::equal(made.skeleton->rotations_at(frame), part_->skeleton->rotations_at(frame));
        changed += !same;
        EXPECT_EQ(same, frame >= 9 && frame <= 81) << frame;
    }
    EXPECT_EQ(changed, 9 + 8);
}

TEST_F(Warp, DisksReachTheFarthestJointUnlessTheyAreGiven) {
    const ClipWarp warp{0.3, end_of(*other_, 10, 50), end_of(*other_, 20, -120)};
    const WarpedClip made = warped(*part_->clip, *part_->skeleton, warp, false);
    const std::vector<bool> below = subtree(made.skeleton->joints, made.skeleton->root);
    for (int frame = 0; frame < made.clip->count(); ++frame) {
        double reach = 0;
        const auto pose = made.skeleton->at(frame);
        for (std::size_t i = 0; i < pose.size(); ++i) {
            if (below[i]) reach = std::max(reach, std::hypot(double{pose[i].x}, double{pose[i].y}));
        }
        EXPECT_NEAR(made.clip->samples()[static_cast<std::size_t>(frame)].r, reach, 1e-6) << frame;
    }
    const WarpedClip kept = warped(*part_->clip, *part_->skeleton, warp, true);
    for (std::size_t i = 0; i < kept.clip->samples().size(); ++i)
        EXPECT_EQ(kept.clip->samples()[i].r, part_->clip->samples()[i].r) << i;
}

TEST_F(Warp, BonesKeepTheirLengths) {
    const ClipWarp warp{0.3, end_of(*other_, 10, 50), end_of(*other_, 20, -120)};
    const WarpedClip made = warped(*part_->clip, *part_->skeleton, warp, false);
    const std::vector<bool> below = subtree(made.skeleton->joints, made.skeleton->root);
    for (int frame = 0; frame < made.clip->count(); ++frame) {
        for (std::size_t i = 0; i < below.size(); ++i) {
            const int parent = made.skeleton->joints[i].parent;
            if (!below[i] || parent < 0 || static_cast<int>(i) == made.skeleton->root) continue;
            const auto on = static_cast<std::size_t>(parent);
            EXPECT_NEAR(glm::distance(made.skeleton->at(frame)[i], made.skeleton->at(frame)[on]),
                        glm::distance(part_->skeleton->at(frame)[i], part_->skeleton->at(frame)[on]), 1e-5);
        }
    }
}

TEST_F(Warp, OfWhatIsThereAlreadyChangesLittle) {
    // The clip goes on as recorded, so the pose at its end is the recording's.
    const double seconds = 0.3;
    ImportedClip inner = *part_;
    const auto samples = part_->clip->samples().subspan(1, 81);
    inner.clip = std::make_shared<const mobb::Clip>(kFrame, std::vector<mobb::Disk>(samples.begin(), samples.end()));
    auto skeleton = std::make_shared<Skeleton>(*part_->skeleton);
    const auto joints = static_cast<std::ptrdiff_t>(skeleton->joints.size());
    skeleton->positions.erase(skeleton->positions.begin(), skeleton->positions.begin() + joints);
    skeleton->rotations.erase(skeleton->rotations.begin(), skeleton->rotations.begin() + joints);
    const ClipWarp warp{seconds, end_of(*part_, 1, 0), end_of(*part_, 81, 0)};
    const WarpedClip made = warped(*inner.clip, *skeleton, warp, false);
    for (int frame = 0; frame < made.clip->count(); ++frame) {
        const mobb::Disk& was = inner.clip->samples()[static_cast<std::size_t>(frame)];
        const mobb::Disk& is = made.clip->samples()[static_cast<std::size_t>(frame)];
        EXPECT_LT(std::hypot(is.x - was.x, is.y - was.y), 0.01) << frame;
        std::vector<glm::dvec3> expected;
        for (const glm::vec3& p : skeleton->at(frame)) expected.emplace_back(p);
        EXPECT_LT(farthest_apart(expected, made.skeleton->at(frame)), 0.05) << frame;
    }
}

TEST_F(Warp, OfFewFramesIsStillAMotion) {
    for (const int count : {2, 3, 4, 5, 7}) {
        const auto samples = part_->clip->samples().first(static_cast<std::size_t>(count));
        const mobb::Clip few(kFrame, std::vector<mobb::Disk>(samples.begin(), samples.end()));
        const ClipWarp warp{0.3, end_of(*other_, 10, 50), end_of(*other_, 20, -120)};
        const WarpedClip made = warped(few, *part_->skeleton, warp, false);
        ASSERT_EQ(made.clip->count(), count - 1);
        EXPECT_LT(farthest_apart(joints_at(*other_, 10, 50), made.skeleton->at(0)), 1e-5) << count;
        for (const mobb::Disk& disk : made.clip->samples()) {
            EXPECT_LT(std::hypot(disk.x - samples[0].x, disk.y - samples[0].y), 1) << count;
            EXPECT_LT(disk.r, 1.5) << count;
        }
    }
}

TEST_F(Warp, RefusesAPoseOfAnotherBody) {
    auto pose = std::make_shared<MovingPose>(moving_pose(*other_->clip, *other_->skeleton, 10, 0));
    pose->joints.pop_back();
    const ClipWarp warp{0.3, {"P", pose, 0}, end_of(*other_, 20, 0)};
    EXPECT_THROW(warped(*part_->clip, *part_->skeleton, warp, false), std::invalid_argument);

    const ClipWarp suits{0.3, end_of(*other_, 10, 0), end_of(*other_, 20, 0)};
    EXPECT_NO_THROW(warped(*part_->clip, *part_->skeleton, suits, false));
    Skeleton by_spine = *part_->skeleton;
    by_spine.root += 1;
    EXPECT_THROW(warped(*part_->clip, by_spine, suits, false), std::invalid_argument) << "joints hang on another root";
}

TEST_F(Warp, AMeanPoseIsAmongThem) {
    const MovingPose one = moving_pose(*other_->clip, *other_->skeleton, 10, 30);
    MovingPose negative = one;
    for (HangingJoint& joint : negative.joints) joint.rotation = -joint.rotation;  // the same rotations
    const std::vector<MovingPose> same{one, negative};
    const MovingPose of_same = mean(same);
    for (std::size_t i = 0; i < one.joints.size(); ++i)
        EXPECT_NEAR(std::abs(glm::dot(of_same.joints[i].rotation, one.joints[i].rotation)), 1, 1e-12);
    EXPECT_NEAR(of_same.height, one.height, 1e-12);

    MovingPose turned = one;
    turned.joints[0].rotation = about_up(mobb::Rotation::from_degrees(20)) * turned.joints[0].rotation;
    turned.height += 0.2;
    const std::vector<MovingPose> both{one, turned};
    const glm::dquat half = about_up(mobb::Rotation::from_degrees(10)) * one.joints[0].rotation;
    EXPECT_NEAR(std::abs(glm::dot(mean(both).joints[0].rotation, half)), 1, 1e-9);
    EXPECT_NEAR(mean(both).height, one.height + 0.1, 1e-12);
}

}  // namespace
}  // namespace mobbscope
