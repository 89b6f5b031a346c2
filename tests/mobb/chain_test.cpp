#include <gtest/gtest.h>
#include <mobb/placed_chain.h>
#include <mobb/query.h>
#include <mobb/random_motion.h>

#include <cstdlib>
#include <vector>

namespace mobb {
namespace {

using test::Random;

static_assert(NodeSource<PlacedTree> && NodeSource<PlacedChain>);
static_assert(SampleSource<PlacedClip> && SampleSource<PlacedChain>);

/// How many random queries the suite asks; MOBBSCOPE_QUERIES gives longer or shorter runs.
int query_budget() {
    const char* text = std::getenv("MOBBSCOPE_QUERIES");
    return text ? std::atoi(text) : 1'000'000;
}

ChainPartPtr part_of(ClipPtr clip, const FitOptions& fit) {
    return std::make_shared<const ChainPart>(std::make_shared<const Tree>(std::move(clip), fit));
}

/// One to `most` links of random clips with one dt: each begins where the one before ends, or anywhere.
std::vector<ChainLink> random_links(Random& random, int most, double time_scale, int most_samples) {
    const bool linked = random.chance(0.7);
    const glm::dvec2 origin = random.chance(0.1) ? glm::dvec2{1e4, -1e5} : glm::dvec2{0};
    std::vector<ChainPartPtr> parts;
    std::vector<ChainLink> links;
    const int n = random.integer(1, most);
    for (int k = 0; k < n; ++k) {
        if (parts.empty() || random.chance(0.6)) {
            FitOptions fit = test::random_fit(random);
            fit.time_scale = time_scale;
            const double dt = parts.empty() ? 0 : parts.front()->clip().dt();
            parts.push_back(part_of(test::random_clip(random, most_samples, dt), fit));
        }
        const ChainPartPtr& part =
            parts[static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.size()) - 1))];
        ChainLink link{part, origin + glm::dvec2{random.real(-3, 3), random.real(-3, 3)}, test::random_angle(random)};
        if (linked && !links.empty()) {
            const ChainLink& before = links.back();
            const Disk end = placed(before.part->clip().samples().back(), Rotation::from_degrees(before.rotate_deg),
                                    before.translate);
            const Disk begin = placed(part->clip().samples().front(), Rotation::from_degrees(link.rotate_deg), {0, 0});
            link.translate = {end.x - begin.x, end.y - begin.y};
        }
        links.push_back(link);
    }
    return links;
}

double random_scale(Random& random) { return random.chance(0.3) ? std::pow(10, random.real(-3, 3)) : 1; }

TEST(Chain, EveryQueryGivesTheRebuiltTreesAnswerAndContact) {
    const int budget = query_budget();
    Random random(31);
    int asked = 0, hits = 0;
    while (asked < budget) {
        const double w = random_scale(random);
        const Chain a(random_links(random, 12, w, 300));
        const Chain b(random_links(random, 12, random.chance(0.9) ? w : 2 * w, 300));
        const auto flat_a = std::make_shared<const Clip>(flattened(a));
        const auto flat_b = std::make_shared<const Clip>(flattened(b));
        FitOptions fit = test::random_fit(random);
        fit.time_scale = w;
        const Tree tree_a(flat_a, fit), tree_b(flat_b, fit);
        for (int k = 0; k < 100; ++k) {
            Placement place_a, place_b;
            test::random_placements(random, *flat_a, *flat_b, place_a, place_b);
            const PlacedChain chain_a(a, place_a), chain_b(b, place_b);
            const PlacedTree rebuilt_a(tree_a, place_a), rebuilt_b(tree_b, place_b);
            const std::optional<Contact> expected = direct_search(rebuilt_a.placed_clip(), rebuilt_b.placed_clip());
            ASSERT_EQ(query(chain_a, chain_b), expected) << asked;
            ASSERT_EQ(query(chain_a, rebuilt_b), expected) << asked;
            ASSERT_EQ(query(rebuilt_a, chain_b), expected) << asked;
            asked += 3;
            hits += 3 * expected.has_value();
            if (k % 10 == 0) {
                ASSERT_EQ(direct_search(chain_a, chain_b), expected) << asked;
                ASSERT_EQ(contact_intervals(chain_a, chain_b), contact_intervals(rebuilt_a, rebuilt_b)) << asked;
                ASSERT_EQ(direct_contact_intervals(chain_a, rebuilt_b.placed_clip()),
                          contact_intervals(rebuilt_a, rebuilt_b));
            }
        }
    }
    EXPECT_GT(hits, asked / 10);
    EXPECT_LT(hits, asked * 9 / 10);
}

}  // namespace
}  // namespace mobb
