// Real crowds of the shared data set, where it is, against the numbers of an independent reader.
#include <import/import.h>
#include <support/folders.h>

#include "expected_csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {
namespace {

/// What the table says of a file, from its clips.
struct Figures {
    int samples = 0;
    double total_path = 0, max_path = 0, agent_seconds = 0, end = 0;
    double x_min = 1e9, x_max = -1e9, y_min = 1e9, y_max = -1e9;
};

Figures figures_of(const std::vector<ImportedClip>& clips) {
    Figures out;
    for (const ImportedClip& clip : clips) {
        const auto samples = clip.clip->samples();
        double path = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (i > 0) path += std::hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y);
            out.x_min = std::min(out.x_min, samples[i].x);
            out.x_max = std::max(out.x_max, samples[i].x);
            out.y_min = std::min(out.y_min, samples[i].y);
            out.y_max = std::max(out.y_max, samples[i].y);
        }
        out.samples += clip.facts.frames;
        out.total_path += path;
        out.max_path = std::max(out.max_path, path);
        out.agent_seconds += clip.facts.duration;
        out.end = std::max(out.end, clip.start + clip.facts.duration);
    }
    return out;
}

TEST(TrajectoryData, EveryFileHasTheExpectedNumbers) {
    const auto table = kSharedData / "expected_trajectories.csv";
    if (!std::filesystem::exists(table)) GTEST_SKIP() << "no test data at " << table;
    int files = 0;
    for (Row& row : read_rows(table)) {
        const auto number = [&row](const char* column) { return std::stod(row[column]); };
        const std::filesystem::path file = kSharedData / row["file"];
        SCOPED_TRACE(file.filename());
        const auto clips = import_clips(file, {});
        EXPECT_EQ(static_cast<double>(clips.size()), number("agents"));
        const Figures found = figures_of(clips);
        EXPECT_EQ(found.samples, number("samples"));
        EXPECT_NEAR(found.total_path, number("total_path"), 1e-3 * number("total_path"));
        EXPECT_NEAR(found.max_path, number("max_path"), 1e-3 * number("max_path"));
        EXPECT_NEAR(found.end, number("span_s"), 1e-3);
        EXPECT_NEAR(found.agent_seconds, number("agent_seconds"), 1e-3);
        EXPECT_NEAR(found.total_path / found.agent_seconds, number("mean_speed"), 1e-3 * number("mean_speed"));
        EXPECT_NEAR(found.x_min, number("x_min"), 1e-4);
        EXPECT_NEAR(found.x_max, number("x_max"), 1e-4);
        EXPECT_NEAR(found.y_min, number("y_min"), 1e-4);
        EXPECT_NEAR(found.y_max, number("y_max"), 1e-4);
        EXPECT_EQ(clips.front().facts.unit, number("unit_factor"));
        EXPECT_NEAR(clips.front().clip->dt(), number("frame_step") / number("frame_rate"), 1e-6);
        ++files;
    }
    EXPECT_EQ(files, 13);
}

TEST(TrajectoryData, TheSameCrowdInTwoFormatsIsTheSame) {
    const auto obsmat = kSharedData / "trajectories/ucy_zara01_obsmat.txt";
    if (!std::filesystem::exists(obsmat)) GTEST_SKIP() << "no test data at " << obsmat;
    const auto a = import_clips(obsmat, {});
    const auto b = import_clips(kSharedData / "trajectories/trajnetpp_zara01.ndjson", {});
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].name, b[i].name);
        EXPECT_EQ(a[i].start, b[i].start);
        EXPECT_EQ(a[i].clip->count(), b[i].clip->count());
    }
}

}  // namespace
}  // namespace mobbscope
