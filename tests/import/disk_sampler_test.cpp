// Times of samples against times of keys, where any time has its pose.
#include <import/skeleton/disk_sampler.h>

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace mobbscope {
namespace {

/// One joint that stands at x = the number of keys so far: stepped keys.
class SteppedMotion : public Motion {
  public:
    explicit SteppedMotion(std::vector<double> keys) {
        times_.first = keys.front();
        times_.last = keys.back();
        times_.keys = std::make_shared<const std::vector<double>>(std::move(keys));
    }
    std::span<const Joint> joints() const override { return joints_; }
    int topmost() const override { return 0; }
    const MotionTimes& times() const override { return times_; }
    void pose(double seconds, std::span<glm::dvec3> positions, std::span<glm::dquat> rotations) const override {
        positions[0] = {0, 0, 0};
        for (const double key : *times_.keys) positions[0].x += key <= seconds ? 1 : 0;
        if (!rotations.empty()) rotations[0] = {1, 0, 0, 0};
    }

  private:
    std::vector<Joint> joints_{{"Hips", -1, false}};
    MotionTimes times_;
};

double keys_so_far(const std::vector<double>& keys, double t, double step = 1.0 / 30) {
    const SteppedMotion motion(keys);
    const GroundedMotion grounded(motion, kYUp);
    PosedDisk out;
    DiskSampler(grounded, 0, step).sample(t, out);
    return out.disk.x;
}

TEST(DiskSampler, ATimeBesideAKeyIsOnTheKey) {
    // As floats hold them: a little after the samples.
    const std::vector<double> keys{0, double{1 / 30.0F}, double{2 / 30.0F}, double{0.1F}};
    for (int i = 0; i < 4; ++i) EXPECT_EQ(keys_so_far(keys, i / 30.0), i + 1) << i;
    EXPECT_EQ(keys_so_far({0, 1}, 1 - 0.019 / 30), 2);
    EXPECT_EQ(keys_so_far({0, 1}, 1 - 0.021 / 30), 1) << "beyond 0.02 frames";
    EXPECT_EQ(keys_so_far({0, 1}, 1 - 0.019 / 30, 1.0 / 120), 1) << "a frame is as long as the step";
    EXPECT_EQ(keys_so_far({0, 0.999, 1}, 1 - 0.019 / 30), 2) << "or as the gap between keys";
    EXPECT_EQ(keys_so_far({0, 0.01}, 0.01 + 1e-6), 2) << "after the last";
}

}  // namespace
}  // namespace mobbscope
