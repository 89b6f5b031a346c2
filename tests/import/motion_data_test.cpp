// The motion files of the shared data set, where it is: real ones against their true numbers, broken ones.
#include "expected_csv.h"

#include <base/error.h>
#include <import/import.h>
#include <support/bytes_read.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

// Bytes that may be read beside a file, to look at what it is.
constexpr std::uint64_t kAround = 16'384;

#define SKIP_WITHOUT(path) \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test data at " << (path)

double path_length(const mobb::Clip& clip) {
    double sum = 0;
    for (std::size_t i = 1; i < clip.samples().size(); ++i) {
        const mobb::Disk& a = clip.samples()[i - 1];
        const mobb::Disk& b = clip.samples()[i];
        sum += std::hypot(b.x - a.x, b.y - a.y);
    }
    return sum;
}

double mean_radius(const mobb::Clip& clip) {
    double sum = 0;
    for (const mobb::Disk& disk : clip.samples()) sum += disk.r;
    return sum / clip.count();
}

double max_radius(const mobb::Clip& clip) {
    double most = 0;
    for (const mobb::Disk& disk : clip.samples()) most = std::max(most, disk.r);
    return most;
}

/// The clip that a row of expected.csv speaks of.
ImportedClip data_clip(const Row& row, Importer& importer) {
    ImportOptions options;
    options.unit = row.at("unit_to_m");
    if (!row.at("clip").empty()) options.animation = row.at("clip");
    return importer.clips(kSharedData / row.at("file"), options).at(0);
}

TEST(MotionData, EveryFigureOfExpectedCsv) {
    const auto table = kSharedData / "expected.csv";
    SKIP_WITHOUT(table);
    Importer importer;
    std::map<std::string, int> checked;
    for (const Row& row : read_rows(table)) {
        if (row.at("frames").empty()) continue;
        const std::string& file = row.at("file");
        SCOPED_TRACE(file + " " + row.at("clip"));
        const bool is_fbx = file.ends_with(".fbx");
        const ImportedClip it = data_clip(row, importer);
        EXPECT_EQ(it.facts.root, row.at("root_used"));
        EXPECT_EQ(it.facts.joints, std::stoi(row.at("joints")));
        EXPECT_EQ(it.clip->count(), std::stoi(row.at("frames_30hz")));
        const auto number = [&](const char* first, const char* second) {
            return std::stod(row.at(row.at(first).empty() ? second : first));
        };
        // Figures have four decimals.
        constexpr double kRounding = 1e-4;
        const double length = number("path_length_30hz_m", "path_length_30hz_m");
        EXPECT_NEAR(path_length(*it.clip), length, (is_fbx ? 0.02 : 0.006) * length + kRounding);
        const double mean = number("mean_radius_endsites_m", "mean_radius_30hz_m");
        EXPECT_NEAR(mean_radius(*it.clip), mean, is_fbx ? 0.02 * mean : 0.006);
        const double most = number("max_radius_endsites_m", "max_radius_30hz_m");
        EXPECT_NEAR(max_radius(*it.clip), most, (is_fbx ? 0.02 : 0.03) * most + kRounding);
        ++checked[is_fbx ? "fbx" : it.facts.format];
    }
    EXPECT_EQ(checked["bvh"], 74);
    EXPECT_EQ(checked["gltf"], 93);
    EXPECT_EQ(checked["fbx"], 3);
}

TEST(MotionData, OneWalkInFiveEncodingsIsOnePath) {
    const auto folder = kSharedData / "gltf";
    SKIP_WITHOUT(folder);
    const ImportedClip first = import_clips(folder / "derived_cmu_07_05_m.glb", {}).at(0);
    for (const char* other : {"cm", "zup", "late", "noibm"}) {
        const ImportedClip it = import_clips(folder / ("derived_cmu_07_05_" + std::string(other) + ".glb"), {}).at(0);
        ASSERT_EQ(it.clip->count(), first.clip->count()) << other;
        for (std::size_t i = 0; i < first.clip->samples().size(); ++i) {
            EXPECT_NEAR(it.clip->samples()[i].x, first.clip->samples()[i].x, 1e-3) << other << " sample " << i;
            EXPECT_NEAR(it.clip->samples()[i].y, first.clip->samples()[i].y, 1e-3) << other << " sample " << i;
            EXPECT_NEAR(it.clip->samples()[i].r, first.clip->samples()[i].r, 1e-3) << other << " sample " << i;
        }
    }
}

TEST(MotionData, TheUnitOfBvhIsGuessed) {
    const auto table = kSharedData / "expected.csv";
    SKIP_WITHOUT(table);
    for (const Row& row : read_rows(table)) {
        const std::string& file = row.at("file");
        if (!file.ends_with(".bvh")) continue;
        const SourceFacts facts = import_clips(kSharedData / file, {}).at(0).facts;
        // Four joints made by hand, 35 units tall: "unknown, taken as cm".
        const bool is_no_body = file.ends_with("rotation_first_root.bvh");
        EXPECT_EQ(facts.unit == std::stod(row.at("unit_to_m")), !is_no_body) << file << ' ' << facts.unit;
    }
}

TEST(MotionData, TurnsGoTheWayThatTheirNamesSay) {
    const auto folder = kSharedData / "bvh/short";
    SKIP_WITHOUT(folder);
    // From the heading of the first 0.4 s to that of the last: a mirrored ground plane would turn the other way.
    const auto turn = [&](const std::string& name) {
        const mobb::ClipPtr clip = import_clips(folder / ("bn2_walk-turn-" + name + ".bvh"), {}).at(0).clip;
        const auto samples = clip->samples();
        const mobb::Disk &a = samples[0], &b = samples[12], &c = samples[samples.size() - 13], &d = samples.back();
        const glm::dvec2 before(b.x - a.x, b.y - a.y);
        const glm::dvec2 after(d.x - c.x, d.y - c.y);
        return before.x * after.y - before.y * after.x;
    };
    for (const char* left : {"left_active_003", "left_exhausted_003", "left_youthful_003"}) EXPECT_GT(turn(left), 0);
    for (const char* right : {"right_active_006", "right_normal_003"}) EXPECT_LT(turn(right), 0);
}

TEST(MotionData, WarningsAreGivenWhereTheDataIsOddAndNowhereElse) {
    const auto table = kSharedData / "expected.csv";
    SKIP_WITHOUT(table);
    for (const Row& row : read_rows(table)) {
        const std::string& file = row.at("file");
        if (!file.ends_with(".bvh") || file.ends_with("rotation_first_root.bvh")) continue;
        const std::vector<ImportWarning> warnings = import_clips(kSharedData / file, {}).at(0).facts.warnings;
        const auto warned = [&](const char* of) {
            return std::count_if(warnings.begin(), warnings.end(),
                                 [of](const ImportWarning& w) { return w.text.find(of) != std::string::npos; });
        };
        const std::string& note = row.at("note");
        const bool is_upside_down = file.find("broken_retarget") != std::string::npos;
        EXPECT_EQ(warned("T-pose") == 1, note.find("T-pose") != std::string::npos) << file;
        EXPECT_EQ(warned("jumps") == 1, note.find("jump") != std::string::npos) << file;
        EXPECT_EQ(warned("below the floor") == 1, is_upside_down) << file;
        EXPECT_LE(warned("disks are held"), warned("jumps")) << file;
        EXPECT_EQ(static_cast<long>(warnings.size()),
                  warned("T-pose") + warned("jumps") + warned("below the floor") + warned("disks are held"))
            << file;
    }
}

TEST(MotionData, EveryBrokenFileEndsAsExpected) {
    const auto table = kSharedData / "invalid/EXPECTED.csv";
    SKIP_WITHOUT(table);
    int checked = 0;
    for (const Row& row : read_rows(table)) {
        const std::string& file = row.at("file");
        if (file.starts_with("csv/")) continue;
        const std::uint64_t before = bytes_read();
        std::string message;
        int samples = 0;
        try {
            for (const ImportedClip& clip : import_clips(kSharedData / "invalid" / file, {}))
                samples += clip.clip->count();
        } catch (const InputError& error) {
            message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            EXPECT_NE(message.find(std::filesystem::path(file).filename()), std::string::npos) << message;
        }
        // Damage makes no more work than a sound file of its size.
        const std::uint64_t size = std::filesystem::file_size(kSharedData / "invalid" / file);
        EXPECT_LE(bytes_read() - before, 2 * size + kAround) << file;
        EXPECT_LE(samples, static_cast<int>(size / 100)) << file;
        if (row.at("expected") == "accept") {
            EXPECT_EQ(message, "") << file;
        } else if (row.at("expected") == "reject") {
            EXPECT_NE(message, "") << file;
        }
        ++checked;
    }
    EXPECT_EQ(checked, 237);
}

TEST(MotionData, AFolderOfShortClipsIsReadOnce) {
    const auto folder = kSharedData / "bvh/short";
    SKIP_WITHOUT(folder);
    const std::uint64_t before = bytes_read();
    int count = 0;
    std::uint64_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        count += static_cast<int>(import_clips(entry.path(), {}).size());
        bytes += entry.file_size() + kAround;
    }
    EXPECT_EQ(count, 51);
    EXPECT_LE(bytes_read() - before, bytes);
}

}  // namespace
}  // namespace mobbscope
