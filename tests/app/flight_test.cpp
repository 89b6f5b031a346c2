// A camera that flies starts where it was, ends where it should, and does not turn back on the way.
#include <app/viewport/flight.h>

#include <gtest/gtest.h>

namespace mobbscope::app {
namespace {

Camera camera(double yaw, double distance) {
    Camera out;
    out.preset = CameraPreset::free;
    out.yaw_deg = yaw;
    out.pitch_deg = 20;
    out.target = glm::dvec3(1, 2, 3);
    out.distance = distance;
    return out;
}

TEST(Flight, GoesFromOneCameraToTheOther) {
    const Flight flight(camera(10, 5), camera(70, 20), 100);
    EXPECT_NEAR(flight.at(100).yaw_deg, 10, 1e-9);
    EXPECT_NEAR(flight.at(100).distance, 5, 1e-9);
    EXPECT_FALSE(flight.over(100));
    double yaw = 10;
    double now = 100;
    for (; !flight.over(now); now += 0.01) {
        EXPECT_GE(flight.at(now).yaw_deg, yaw);
        yaw = flight.at(now).yaw_deg;
        ASSERT_LT(now, 102) << "a flight takes no longer than patience does";
    }
    EXPECT_NEAR(flight.at(now).yaw_deg, 70, 1e-9);
    EXPECT_NEAR(flight.at(now).distance, 20, 1e-9);
}

TEST(Flight, IsSlowAtBothEnds) {
    const Flight flight(camera(0, 5), camera(60, 5), 0);
    double end = 0;
    while (!flight.over(end)) end += 0.001;
    const auto turned = [&](double from, double to) {
        return flight.at(to * end).yaw_deg - flight.at(from * end).yaw_deg;
    };
    EXPECT_LT(turned(0, 0.1), 0.5 * turned(0.45, 0.55));
    EXPECT_LT(turned(0.9, 1), 0.5 * turned(0.45, 0.55));
}

}  // namespace
}  // namespace mobbscope::app
