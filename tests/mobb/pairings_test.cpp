// Everything that can be placed, against everything: one answer, whatever asks.
#include <gtest/gtest.h>
#include <mobb/placed_chain.h>
#include <mobb/query.h>
#include <mobb/random_chain.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace mobb {
namespace {

using test::query_budget;
using test::Random;

/// One motion as all that can be asked.
class Sources {
  public:
    /// Of a chain: of one link, or of several, held or linear.
    Sources(Random& random, int most_samples)
        : chain_(random.chance(0.5) ? test::random_links(random, 4, 1, most_samples, kind(random))
                                    : test::random_running_links(random, 4, 1, most_samples, kind(random), 1)),
          clip_(std::make_shared<const Clip>(flattened(chain_))),
          tree_(clip_, test::random_any_fit(random)),
          blocks_(clip_) {}

    const Clip& clip() const { return *clip_; }
    PlacedClip placed_clip(const Placement& at) const { return {*clip_, at}; }
    std::tuple<PlacedTree, PlacedBlocks, PlacedChain, PlacedClip> placed(const Placement& at) const {
        return {PlacedTree(tree_, at), PlacedBlocks(blocks_, at), PlacedChain(chain_, at), PlacedClip(*clip_, at)};
    }

  private:
    static std::optional<TreeKind> kind(Random& random) {
        return random.chance(0.4) ? std::optional(TreeKind::blocks) : std::nullopt;
    }

    Chain chain_;
    ClipPtr clip_;
    Tree tree_;
    Blocks blocks_;
};

TEST(Pairings, EachAsksAsTheDirectSearchDoes) {
    constexpr int kNames = 4;
    constexpr std::array<const char*, kNames> kNamed{"tree", "blocks", "chain", "clip"};
    Random random(1);
    int hits = 0, asked = 0;
    const int queries = query_budget() / 10;
    while (asked < queries) {
        const Sources a(random, random.chance(0.1) ? 600 : 60), b(random, random.chance(0.1) ? 600 : 60);
        for (int k = 0; k < 40 && asked < queries; ++k, ++asked) {
            Placement at_a, at_b;
            test::random_placements(random, a.clip(), b.clip(), at_a, at_b);
            const PlacedClip clip_a = a.placed_clip(at_a), clip_b = b.placed_clip(at_b);
            const std::optional<Contact> contact = direct_search(clip_a, clip_b);
            const std::vector<Interval> intervals = direct_contact_intervals(clip_a, clip_b);
            hits += contact ? 1 : 0;
            const auto placed_a = a.placed(at_a);
            const auto placed_b = b.placed(at_b);
            const auto ask = [&]<std::size_t i, std::size_t j>() {
                const auto& one = std::get<i>(placed_a);
                const auto& other = std::get<j>(placed_b);
                ASSERT_EQ(intersects(one, other), contact.has_value()) << kNamed[i] << " and " << kNamed[j];
                ASSERT_EQ(query(one, other), contact) << kNamed[i] << " and " << kNamed[j];
                ASSERT_EQ(contact_intervals(one, other), intervals) << kNamed[i] << " and " << kNamed[j];
            };
            [&]<std::size_t... pair>(std::index_sequence<pair...>) {
                (ask.template operator()<pair / kNames, pair % kNames>(), ...);
            }
            (std::make_index_sequence<kNames * kNames>());
            if (HasFatalFailure()) FAIL() << "query " << asked;
        }
    }
    EXPECT_GT(hits, asked / 10);
    EXPECT_LT(hits, asked * 9 / 10);
}

}  // namespace
}  // namespace mobb
