// What trim takes of tracks: all that happens in that time, and as it happens.
#include <conflicts/conflicts.h>
#include <mobb/random_motion.h>
#include <scene/scene.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

using Times = std::map<std::pair<std::string, std::string>, std::vector<mobb::Interval>>;

/// When pairs collide within a time.
Times times_within(const std::filesystem::path& file, const ImportOptions& options, double from, double to) {
    constexpr double kMoment = 1e-7;
    Times out;
    for (const SceneConflict& conflict : conflicts_in(load_scene(file, options))) {
        for (const mobb::Interval& of : conflict.facts.intervals) {
            const mobb::Interval part{std::max(of.t0, from), std::min(of.t1, to)};
            if (part.t1 - part.t0 > kMoment) out[{conflict.a.name, conflict.b.name}].push_back(part);
        }
    }
    return out;
}

TEST(TrimmedConflicts, AreThoseOfTheWholeInThatTime) {
    mobb::test::Random random(7);
    std::string text = "id,t,x,y\n";
    for (int id = 0; id < 80; ++id) {
        // Some are out of step with the others, or lack points, or have one.
        const double step = id % 3 == 0 ? 0.3 : 0.4, begin = 0.1 * std::floor(random.real(0, 60));
        const double x = random.real(0, 6), y = random.real(0, 6), vx = random.real(-1.5, 1.5), vy = random.real(-1, 1);
        for (int k = 0; k < (id % 20 == 0 ? 1 : 9); ++k) {
            if (id % 7 == 0 && (k == 3 || k == 4)) continue;
            const double t = k * step;
            text += std::to_string(id) + ',' + std::to_string(begin + t) + ',' + std::to_string(x + t * vx) + ',' +
                    std::to_string(y + t * vy) + '\n';
        }
    }
    const TempFolder folder;
    const auto file = folder.write("crowd.csv", text);
    for (const mobb::Motion motion : {mobb::Motion::linear, mobb::Motion::held}) {
        std::size_t found = 0;
        for (const auto& [from, to] :
             std::vector<std::pair<double, double>>{{2, 4}, {2.05, 3.97}, {3, 3.1}, {3.33, 3.34}, {0, 1.7}, {5.1, 9}}) {
            ImportOptions options;
            options.motion = motion;
            const Times whole = times_within(file, options, from, to);
            options.trim = {from, to};
            const Times trimmed = times_within(file, options, from, to);
            found += whole.size();
            ASSERT_EQ(trimmed.size(), whole.size()) << from << ' ' << to;
            for (const auto& [pair, times] : whole) {
                ASSERT_TRUE(trimmed.contains(pair)) << pair.first << ' ' << pair.second;
                const std::vector<mobb::Interval>& others = trimmed.at(pair);
                ASSERT_EQ(others.size(), times.size()) << pair.first << ' ' << pair.second;
                for (std::size_t i = 0; i < times.size(); ++i) {
                    EXPECT_NEAR(others[i].t0, times[i].t0, 1e-9);
                    EXPECT_NEAR(others[i].t1, times[i].t1, 1e-9);
                }
            }
        }
        EXPECT_GT(found, 30u);
    }
}

}  // namespace
}  // namespace mobbscope
