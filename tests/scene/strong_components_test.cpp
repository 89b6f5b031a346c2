// Which nodes lead to each other.
#include <scene/motion_graph.h>

#include <gtest/gtest.h>

#include <random>

namespace mobbscope {
namespace {

TEST(StrongComponents, AreThoseOfReachability) {
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        const int nodes = 1 + static_cast<int>(random() % 12);
        const auto pick = [&] { return static_cast<int>(random() % static_cast<unsigned>(nodes)); };
        std::vector<std::pair<int, int>> edges;
        for (auto e = random() % 25; e > 0; --e) {
            edges.emplace_back(pick(), pick());
        }
        std::vector<std::vector<bool>> leads(12, std::vector<bool>(12, false));
        for (std::size_t i = 0; i < 12; ++i) leads[i][i] = true;
        for (const auto& [from, to] : edges) leads[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)] = true;
        for (std::size_t k = 0; k < 12; ++k) {
            for (std::size_t i = 0; i < 12; ++i) {
                for (std::size_t j = 0; j < 12; ++j) leads[i][j] = leads[i][j] || (leads[i][k] && leads[k][j]);
            }
        }
        const std::vector<int> found = strong_components(nodes, edges);
        int next = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_LE(found[i], next);  // counted in the order of their first nodes
            next = std::max(next, found[i] + 1);
            for (std::size_t j = 0; j < found.size(); ++j) {
                EXPECT_EQ(found[i] == found[j], leads[i][j] && leads[j][i]) << i << ' ' << j;
            }
        }
    }
}

TEST(StrongComponents, ALongChainIsNoDepthOfCalls) {
    std::vector<std::pair<int, int>> edges;
    for (int i = 0; i + 1 < 300'000; ++i) edges.emplace_back(i, i + 1);
    EXPECT_EQ(strong_components(300'000, edges).back(), 299'999);
    edges.emplace_back(299'999, 0);
    EXPECT_EQ(strong_components(300'000, edges).back(), 0);
}

}  // namespace
}  // namespace mobbscope
