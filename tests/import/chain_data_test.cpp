// Chains of the real clips of the shared data set, where it is.
#include <import/import.h>
#include <mobb/chain_boxes.h>
#include <mobb/random_motion.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

TEST(ChainData, BoxesAreAboutAsTightAsARebuiltTreesAtEqualCount) {
    const auto folder = kSharedData / "bvh/short";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no test data at " << folder;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<mobb::ChainPartPtr> parts;
    Importer importer;
    for (const auto& file : files) {
        ImportOptions options;
        options.fps = 30;
        for (const ImportedClip& clip : importer.clips(file, options)) {
            if (!parts.empty() && clip.clip->dt() != parts.front()->clip().dt()) continue;
            parts.push_back(std::make_shared<const mobb::ChainPart>(
                std::make_shared<const mobb::Tree>(clip.clip, mobb::FitOptions{})));
        }
    }
    ASSERT_GT(parts.size(), 40u);

    mobb::test::Random random(41);
    for (const int links : {2, 8, 60, 1000}) {
        // Each clip begins where the one before ends: going on in its direction but for a little, or anywhere.
        for (const double turning : {15.0, 180.0}) {
            double composed = 0, rebuilt = 0;
            for (int round = 0; round < (links < 100 ? 20 : 1); ++round) {
                std::vector<mobb::ChainLink> chain_links;
                glm::dvec2 end{0};
                double heading = 0;
                for (int k = 0; k < links; ++k) {
                    const auto& part =
                        parts[static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.size()) - 1))];
                    const mobb::Disk first = part->clip().samples().front(), last = part->clip().samples().back();
                    heading += random.real(-turning, turning);
                    const double own = std::atan2(last.y - first.y, last.x - first.x) * 180 / std::numbers::pi;
                    const mobb::Rotation rotation = mobb::Rotation::from_degrees(heading - own);
                    chain_links.push_back({part, end - rotation({first.x, first.y}), heading - own});
                    end += rotation({last.x - first.x, last.y - first.y});
                }
                const mobb::Chain chain(chain_links);
                const mobb::test::Boxes boxes = mobb::test::boxes_of(chain);
                composed += boxes.volume;
                rebuilt +=
                    mobb::test::rebuilt_volume(std::make_shared<const mobb::Clip>(flattened(chain)), boxes.count);
            }
            EXPECT_LT(composed / rebuilt, 1.1) << links << " links that turn by up to " << turning << " degrees";
            RecordProperty("ratio_" + std::to_string(links) + "_" + std::to_string(static_cast<int>(turning)),
                           std::to_string(composed / rebuilt));
        }
    }
}

}  // namespace
}  // namespace mobbscope
