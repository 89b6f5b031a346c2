#include <gtest/gtest.h>
#include <mobb/blocks.h>
#include <mobb/chain_boxes.h>
#include <mobb/placed_chain.h>
#include <mobb/query.h>
#include <mobb/random_chain.h>
#include <mobb/random_motion.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mobb {
namespace {

using test::part_of;
using test::query_budget;
using test::Random;
using test::random_links;
using test::random_running_links;

static_assert(NodeSource<PlacedTree> && NodeSource<PlacedChain>);
static_assert(SampleSource<PlacedClip> && SampleSource<PlacedChain>);

/// Walks of one to four seconds, each beginning where the one before ends and up to so many degrees to its side.
std::vector<ChainLink> walking_links(Random& random, int count, double turning) {
    std::vector<ChainLink> links;
    glm::dvec2 end{0};
    double heading = random.real(0, 360);
    for (int k = 0; k < count; ++k) {
        const double speed = random.real(0.6, 1.6), bend = random.chance(0.5) ? 0 : random.real(-0.5, 0.5);
        std::vector<Disk> path;
        double x = 0, y = 0, angle = 0;
        const int n = random.integer(30, 120);
        for (int i = 0; i < n; ++i) {
            path.push_back({x, y + 0.03 * std::sin(0.2 * i), 0.42 + 0.06 * std::sin(0.37 * i)});
            angle += bend / 30;
            x += speed / 30 * std::cos(angle), y += speed / 30 * std::sin(angle);
        }
        heading += random.real(-turning, turning);
        links.push_back({part_of(std::make_shared<const Clip>(1.0 / 30, path), {}), end, heading});
        end += Rotation::from_degrees(heading)({x, y});
        if (turning > 0) heading += angle * 57.3;
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

/// Of all pairs of samples of two chains, the one that collides first.
std::optional<Contact> earliest_of_chains(const PlacedChain& a, const PlacedChain& b) {
    for (int i = a.first(); i < a.end(); ++i) {
        for (int j = b.first(); j < b.end(); ++j) {
            if (!overlap_in_time(a.time(i), a.time(i + 1), b.time(j), b.time(j + 1))) continue;
            if (approach_of(a, i, b, j).collides()) return contact_of(a, i, b, j);
        }
    }
    return std::nullopt;
}

ChainPartPtr part_of_motion(Motion motion, std::vector<Disk> samples) {
    return part_of(std::make_shared<const Clip>(0.5, std::move(samples), motion), {.leaf = 1});
}

TEST(Chain, LinearLinksRunOnToTheNext) {
    const ChainPartPtr part = part_of_motion(Motion::linear, {{0, 0, 0.1}, {1, 0, 0.3}});
    const Chain chain(std::vector<ChainLink>{{part, {0, 0}, 0}, {part, {5, 0}, 0}});
    EXPECT_TRUE(chain.is_linear());
    EXPECT_EQ(chain.disk_at_end(0).x, 1);
    EXPECT_EQ(chain.disk_at_end(1).x, 5) << "in the joint";
    EXPECT_EQ(chain.disk_at_end(1).r, 0.1);
    EXPECT_EQ(chain.disk_at_end(2).x, 6);
    EXPECT_EQ(chain.duration(), 1.5) << "it ends at its last sample";
    EXPECT_EQ(chain.until_next(), 2);
    const Clip flat = flattened(chain);
    EXPECT_EQ(flat.motion(), Motion::linear);
    EXPECT_EQ(flat.count(), 4);
    EXPECT_EQ(flat.duration(), 1.5);
}

TEST(Chain, BeforeAHeldLinkTheLastSampleOfALinearOneStays) {
    const ChainPartPtr runs = part_of_motion(Motion::linear, {{0, 0, 0.1}, {1, 0, 0.3}});
    const ChainPartPtr stays = part_of_motion(Motion::held, {{5, 0, 0.1}});
    const Chain chain(std::vector<ChainLink>{{runs, {0, 0}, 0}, {stays, {0, 0}, 0}, {runs, {7, 0}, 0}});
    EXPECT_EQ(chain.disk_at_end(1).x, 1);
    EXPECT_EQ(chain.disk_at_end(2).x, 5) << "a held one does not run on";
    EXPECT_EQ(chain.duration(), 2);
    EXPECT_THROW(flattened(chain), std::invalid_argument);
    // Somebody who stands there from 0.5 to 1 s is met all that time.
    const Tree post(std::make_shared<const Clip>(0.5, std::vector<Disk>{{1, 0, 0.1}}), {});
    const PlacedChain placed(chain, {});
    const std::vector<Interval> met = contact_intervals(placed, PlacedTree(post, {.start = 0.5}));
    ASSERT_EQ(met.size(), 1u);
    EXPECT_EQ(met[0], (Interval{0.5, 1}));
}

TEST(Chain, ALastClipOfOneSampleTakesTimeUnlessALinearOneRunsToIt) {
    const ChainPartPtr runs = part_of_motion(Motion::linear, {{0, 0, 0.1}, {1, 0, 0.3}});
    const ChainPartPtr point = part_of_motion(Motion::linear, {{2, 0, 0.1}});
    const ChainPartPtr stays = part_of_motion(Motion::held, {{5, 0, 0.1}});
    const auto seconds = [](std::vector<ChainLink> links) { return Chain(links).duration(); };
    EXPECT_EQ(seconds({{point}}), 0.5);
    EXPECT_EQ(seconds({{runs}, {point}}), 1);
    EXPECT_EQ(seconds({{stays}, {point}}), 1);
    EXPECT_EQ(seconds({{point}, {point}}), 0.5);
    EXPECT_EQ(seconds({{stays}, {point}, {stays}}), 1.5);
    EXPECT_EQ(seconds({{runs}, {stays}}), 1.5);
    // What was run to has been, also once what ran is dropped.
    Chain chain(std::vector<ChainLink>{{runs}, {point}});
    chain.drop_before(1);
    EXPECT_EQ(chain.links(), 1);
    EXPECT_EQ(chain.duration(), 1);
    EXPECT_THROW(flattened(chain), std::invalid_argument);
    chain.append({runs});
    EXPECT_EQ(chain.disk_at_end(2).x, 0) << "and runs on";
}

/// 20 points of a path at 10 Hz past a post, and the same in two halves: the public report behind this.
TEST(Chain, OfAPathsHalvesHitsThePostThatThePathHits) {
    std::vector<Disk> path;
    for (int i = 0; i < 20; ++i) path.push_back({0.4 * i, 0, 0.05});
    const auto clip = [&](int first, int end) {
        return std::make_shared<const Clip>(0.1, std::vector<Disk>(path.begin() + first, path.begin() + end),
                                            Motion::linear);
    };
    const Tree whole(clip(0, 20), {});
    const Chain halves(std::vector<ChainLink>{{part_of(clip(0, 10), {})}, {part_of(clip(10, 20), {})}});
    // Between the last sample of the first half and the first one of the second.
    const Tree post(std::make_shared<const Clip>(10, std::vector<Disk>{{3.8, 0, 0.05}}), {});
    const auto expected = query(PlacedTree(whole, {}), PlacedTree(post, {}));
    ASSERT_TRUE(expected);
    EXPECT_EQ(query(PlacedChain(halves, {}), PlacedTree(post, {})), expected);
    EXPECT_EQ(contact_intervals(PlacedChain(halves, {}), PlacedTree(post, {})),
              contact_intervals(PlacedTree(whole, {}), PlacedTree(post, {})));
}

bool has_one_motion(const Chain& chain) {
    for (int k = 1; k < chain.links(); ++k) {
        if (chain.part(k).clip().motion() != chain.part(0).clip().motion()) return false;
    }
    return true;
}

TEST(Chain, OfLinearAndHeldClipsGivesTheDirectSearchsAnswer) {
    const int budget = query_budget() / 10;
    Random random(41);
    int asked = 0, hits = 0, asked_of_flat = 0;
    while (asked < budget) {
        const double w = random_scale(random);
        // Of blocks, too.
        const auto kind = [&] { return random.chance(0.2) ? std::optional(TreeKind::blocks) : std::nullopt; };
        const double linear = random.chance(0.3) ? 1 : 0.5;
        const Chain a(random_running_links(random, 12, w, 300, kind(), linear));
        const Chain b(random_running_links(random, 12, w, 300, kind()));
        const std::optional<Clip> flat = has_one_motion(a) ? std::optional(flattened(a)) : std::nullopt;
        const ClipPtr clip = test::random_motion(random, test::random_clip(random, 300));
        FitOptions fit = test::random_fit(random);
        fit.time_scale = w;
        const Tree tree(clip, fit);
        for (int k = 0; k < 20; ++k) {
            Placement place_a, place_b, place_c;
            // Of the first links alone, as that is all that placing asks for.
            test::random_placements(random, a.part(0).clip(), b.part(0).clip(), place_a, place_b);
            test::random_placements(random, a.part(0).clip(), *clip, place_a, place_c);
            const PlacedChain chain_a(a, place_a), chain_b(b, place_b);
            const PlacedTree placed(tree, place_c);
            const std::optional<Contact> expected = direct_search(chain_a, chain_b);
            ASSERT_EQ(query(chain_a, chain_b), expected) << asked;
            ASSERT_EQ(query(chain_a, placed), direct_search(chain_a, placed.placed_clip())) << asked;
            ASSERT_EQ(contact_intervals(chain_a, chain_b), direct_contact_intervals(chain_a, chain_b)) << asked;
            if (k == 0 && a.end() < 300 && b.end() < 300) {
                const std::optional<Contact> first = earliest_of_chains(chain_a, chain_b);
                ASSERT_EQ(first.has_value(), expected.has_value());
            }
            if (flat) {
                const PlacedClip placed_flat(*flat, place_a);
                ASSERT_EQ(direct_search(placed_flat, chain_b), expected) << asked;
                ASSERT_EQ(direct_contact_intervals(placed_flat, chain_b), contact_intervals(chain_a, chain_b)) << asked;
                ++asked_of_flat;
            }
            asked += 2;
            hits += expected.has_value();
        }
    }
    EXPECT_GT(hits, asked / 100);
    EXPECT_GT(asked_of_flat, asked / 10);
}

TEST(Chain, BoxesAreAboutAsTightAsARebuiltTreesAtEqualCount) {
    Random random(35);
    for (const int links : {2, 8, 60, 500}) {
        for (const double turning : {0.0, 5.0, 30.0, 180.0}) {
            double composed = 0, rebuilt = 0;
            for (int round = 0; round < (links < 100 ? 40 : 4); ++round) {
                const Chain chain(walking_links(random, links, turning));
                const test::Boxes boxes = test::boxes_of(chain);
                composed += boxes.volume;
                rebuilt += test::rebuilt_volume(std::make_shared<const Clip>(flattened(chain)), boxes.count);
            }
            EXPECT_LT(composed / rebuilt, 1.05) << links << " links that turn by up to " << turning << " degrees";
            EXPECT_GT(composed / rebuilt, 0.95) << links << " links that turn by up to " << turning << " degrees";
        }
    }
}

/// Calls visit(node, box) for a node and all below it; returns how many leaves there are.
template <class Visit>
int for_all_nodes(const Chain& chain, int id, Visit visit) {
    const ChainNode node = chain.node(id);
    visit(node, chain.box(node));
    if (node.is_leaf()) return 1;
    const ChainNode first = chain.node(node.children[0]), last = chain.node(node.children[1]);
    EXPECT_EQ(first.first, node.first);
    EXPECT_EQ(first.until, last.first);
    EXPECT_EQ(last.until, node.until);
    EXPECT_EQ(last.end(), node.end());
    return for_all_nodes(chain, node.children[0], visit) + for_all_nodes(chain, node.children[1], visit);
}

TEST(Chain, EveryBoxContainsTheCylindersItBounds) {
    Random random(32);
    for (int round = 0; round < 300; ++round) {
        const Chain chain(random_running_links(random, 40, random_scale(random), 100, {}, random.integer(0, 2) / 2.0));
        const double w = chain.time_scale();
        const double slack = 1e-9 * (1 + chain.reach() + w * chain.duration()) / 100;
        EXPECT_EQ(chain.node(0).first, 0);
        EXPECT_EQ(chain.node(0).end(), chain.end());
        EXPECT_EQ(chain.node(0).until, chain.until());
        for_all_nodes(chain, 0, [&](const ChainNode& node, const Box& box) {
            for (int i = node.first; i < node.until; ++i) {
                const Disk begins = chain.disk(i), ends = chain.disk_at_end(i);
                ASSERT_LE(std::abs(begins.x) + std::abs(begins.y) + begins.r, chain.reach());
                for (const auto& [t, d] : {std::pair(i * chain.dt(), begins), std::pair((i + 1) * chain.dt(), ends)}) {
                    ASSERT_LE(test::overhang(box, {d.x, d.y, w * t}, d.r), slack)
                        << round << " node of link " << node.link;
                }
            }
        });
    }
}

TEST(Chain, IsOneSequenceOfSamplesInTheWorld) {
    const auto clip = std::make_shared<const Clip>(0.5, std::vector<Disk>{{0, 0, 1}, {1, 0, 2}});
    const ChainPartPtr part = part_of(clip, {});
    const std::vector<ChainLink> links{{part, {0, 0}, 0}, {part, {2, 0}, 90}};
    const Chain chain(links);
    EXPECT_EQ(chain.links(), 2);
    EXPECT_EQ(chain.end(), 4);
    EXPECT_EQ(chain.first_sample(1), 2);
    EXPECT_EQ(chain.duration(), 2);
    const PlacedChain placed(chain, {.translate = {10, 0}, .rotate_deg = 90, .start = 7});
    EXPECT_EQ(placed.disk(3).x, 9);
    EXPECT_EQ(placed.disk(3).y, 2);
    EXPECT_EQ(placed.disk(3).r, 2);
    EXPECT_EQ(placed.time(3), 8.5);
    EXPECT_EQ(flattened(chain).count(), 4);
    EXPECT_EQ(flattened(chain).samples()[3].y, 1);
}

/// Two chains with the same boxes, node by node.
void expect_same(const Chain& a, const Chain& b, int id_a = 0, int id_b = 0) {
    const ChainNode node_a = a.node(id_a), node_b = b.node(id_b);
    ASSERT_EQ(node_a.first, node_b.first);
    ASSERT_EQ(node_a.count, node_b.count);
    ASSERT_EQ(node_a.until, node_b.until);
    ASSERT_EQ(node_a.is_leaf(), node_b.is_leaf());
    const Box box_a = a.box(node_a), box_b = b.box(node_b);
    // They differ by what is added for rounding, which grows with the chain.
    ASSERT_NEAR(glm::distance(box_a.center, box_b.center), 0, 1e-9);
    ASSERT_NEAR(glm::distance(box_a.half, box_b.half), 0, 1e-11 * (1 + a.reach()));
    if (node_a.is_leaf()) return;
    for (std::size_t k = 0; k < 2; ++k) expect_same(a, b, node_a.children[k], node_b.children[k]);
}

TEST(Chain, AppendingEqualsComposingAtOnce) {
    Random random(33);
    for (int round = 0; round < 200; ++round) {
        const std::vector<ChainLink> links = random_running_links(random, 40, 1, 50, {}, random.integer(0, 2) / 2.0);
        const Chain whole(links);
        const std::span<const ChainLink> all(links);
        const auto begun = static_cast<std::size_t>(random.integer(1, static_cast<int>(links.size())));
        Chain grown(all.first(begun));
        for (const ChainLink& link : all.subspan(begun)) grown.append(link);
        ASSERT_EQ(grown.end(), whole.end());
        ASSERT_EQ(grown.reach(), whole.reach());
        expect_same(grown, whole);
    }
}

TEST(Chain, DroppingThePastChangesNoLaterAnswer) {
    Random random(34);
    int hits = 0;
    for (int round = 0; round < 2000; ++round) {
        const double linear = random.integer(0, 2) / 2.0;
        const Chain whole(random_running_links(random, 20, 1, 60, {}, linear));
        const Chain other(random_running_links(random, 5, 1, 60, {}, linear));
        const double now = random.real(-0.1, 1.1) * whole.duration();
        Chain rest = whole;
        rest.drop_before(now);
        // Every link that goes is over; the first that stays is not, unless it is the last.
        const int dropped = whole.links() - rest.links();
        EXPECT_EQ(rest.first(), whole.first_sample(dropped));
        EXPECT_EQ(rest.end(), whole.end());
        if (dropped > 0) {
            EXPECT_LE(rest.first() * rest.dt(), now);
        }
        if (rest.links() > 1) {
            EXPECT_GT(rest.first_sample(1) * rest.dt(), now);
        }
        EXPECT_EQ(rest.duration(), whole.duration());
        if (has_one_motion(rest) && rest.until() > rest.first()) {
            EXPECT_EQ(flattened(rest).count(), rest.end() - rest.first());
        }

        // Who begins once the past is over meets the same samples at the same time.
        const Placement place{.translate = {random.real(-2, 2), random.real(-2, 2)}, .start = random.real(-9, 9)};
        const PlacedChain placed_whole(whole, place), placed_rest(rest, place);
        const PlacedChain placed_other(
            other, {.translate = place.translate, .start = placed_rest.time(rest.first()) + random.real(0, 1)});
        const std::optional<Contact> expected = query(placed_whole, placed_other);
        ASSERT_EQ(query(placed_rest, placed_other), expected) << round;
        ASSERT_EQ(direct_search(placed_rest, placed_other), expected) << round;
        hits += expected.has_value();
        // And it goes on as a chain.
        rest.append({std::make_shared<const ChainPart>(whole.part(0)), {1, 1}, 10});
        EXPECT_EQ(rest.end(), whole.end() + whole.part(0).clip().count());
        for_all_nodes(rest, 0, [](const ChainNode&, const Box&) {});
    }
    EXPECT_GT(hits, 200);
}

TEST(Chain, FarAndExtremeChainsKeepTheirAnswers) {
    Random random(36);
    int hits = 0;
    for (int round = 0; round < 4000; ++round) {
        const double size = std::pow(10, random.real(-6, 6)), dt = std::pow(10, random.real(-4, 3));
        std::vector<Disk> path;
        const int n = random.integer(1, 20);
        for (int i = 0; i < n; ++i) path.push_back({size * i, size * random.real(0, 0.1), size});
        const ChainPartPtr part = part_of(std::make_shared<const Clip>(dt, path), {.leaf = random.integer(1, 5)});
        std::vector<ChainLink> links;
        const double heading = test::random_angle(random);
        const int count = random.integer(1, 9);
        for (int k = 0; k < count; ++k) {
            links.push_back({part, Rotation::from_degrees(heading)({size * n * k, 0}), heading});
        }
        const Chain chain(links);
        const auto flat = std::make_shared<const Clip>(flattened(chain));
        const Tree tree(flat, {});
        // Side by side, apart by all but a hair.
        const Placement place_a{.rotate_deg = test::random_angle(random),
                                .start = random.chance(0.5) ? std::pow(10, random.real(0, 9)) : 0};
        Placement place_b = place_a;
        place_b.translate =
            Rotation::from_degrees(place_a.rotate_deg + heading)({0, 2 * size * (1 - random.integer(0, 3) * 1e-16)});
        const PlacedChain a(chain, place_a), b(chain, place_b);
        const PlacedTree flat_a(tree, place_a), flat_b(tree, place_b);
        const std::optional<Contact> expected = direct_search(flat_a.placed_clip(), flat_b.placed_clip());
        ASSERT_EQ(query(a, b), expected) << round;
        ASSERT_EQ(query(flat_a, b), expected) << round;
        hits += expected.has_value();
    }
    EXPECT_GT(hits, 1000);
}

/// What the chain says against a link.
std::string refusal(const std::vector<ChainLink>& links) {
    try {
        const Chain chain(links);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "taken";
}

TEST(Chain, RefusesLinksThatDoNotFit) {
    const auto clip = [](double dt, double x = 0) {
        return std::make_shared<const Clip>(dt, std::vector<Disk>(3, Disk{x, 0, 1}));
    };
    const ChainPartPtr part = part_of(clip(0.1), {});
    EXPECT_EQ(refusal({{part}}), "taken");
    EXPECT_EQ(refusal({}), "a chain needs at least one link");
    EXPECT_EQ(refusal({{part}, {nullptr}}), "link 1: it has no part");
    EXPECT_EQ(refusal({{part}, {part_of(clip(0.2), {})}}), "link 1: its dt must be that of the chain's other clips");
    EXPECT_EQ(refusal({{part}, {part_of(clip(0.1), {.time_scale = 2})}}),
              "link 1: its time_scale must be that of the chain's other trees");
    constexpr auto kPlacement = "link 0: its placement must be finite and keep the clip within 1e9 m";
    EXPECT_EQ(refusal({{part, {std::nan(""), 0}}}), kPlacement);
    EXPECT_EQ(refusal({{part, {0, 0}, 1e300}}), kPlacement);
    EXPECT_EQ(refusal({{part, {1e9, 0}}}), kPlacement);
    EXPECT_EQ(refusal({{part_of(clip(4e11 / 3), {})}, {part_of(clip(4e11 / 3), {})}, {part_of(clip(4e11 / 3), {})}}),
              "link 2: with it the chain lasts longer than 1e12 s");
    EXPECT_THROW(ChainPart(nullptr), std::invalid_argument);

    // A long clip and many links have more nodes than can be numbered, even if most links are short.
    const ChainPartPtr many =
        part_of(std::make_shared<const Clip>(0.1, std::vector<Disk>(100'000, Disk{})), {.leaf = 1});
    std::vector<ChainLink> links(8192, ChainLink{part});
    links.push_back({many});
    EXPECT_EQ(refusal(links), "the chain has too many nodes: use fewer links, or trees with larger leaves");
}

TEST(Chain, IsAsItWasAfterARefusal) {
    Random random(37);
    const std::vector<ChainLink> links = random_links(random, 9, 1, 50);
    Chain chain(links);
    EXPECT_THROW(chain.append(std::vector<ChainLink>{links[0], {nullptr}}), std::invalid_argument);
    EXPECT_EQ(chain.links(), static_cast<int>(links.size()));
    expect_same(chain, Chain(links));
}

TEST(Chain, ThreadsShareChainsAndBlocks) {
    Random random(41);
    const Chain chain(random_links(random, 12, 1, 60));
    const ClipPtr walks = test::random_clip(random, 300), stands = test::random_clip(random, 40);
    const Tree tree(stands, {});
    const Blocks of_walks(walks), of_stands(stands);
    const auto answers = [&] {
        std::vector<std::optional<Contact>> contacts;
        std::vector<bool> meet;
        for (int i = 0; i < 500; ++i) {
            const Placement place{{0.05 * i - 12, 0.3 * (i % 20) - 3}, 7.0 * i, 0.01 * i};
            contacts.push_back(query(PlacedChain(chain, {}), PlacedTree(tree, place)));
            meet.push_back(intersects(PlacedBlocks(of_walks, {}), PlacedBlocks(of_stands, place)));
        }
        return std::pair(contacts, meet);
    };
    const auto expected = answers();
    std::vector<int> same(4, 0);
    std::vector<std::thread> threads;
    for (int& mine : same) threads.emplace_back([&] { mine = answers() == expected ? 1 : 0; });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(same, std::vector<int>(4, 1));
}

}  // namespace
}  // namespace mobb
