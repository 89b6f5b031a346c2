// The block query: the direct search's answers on every set of instructions, and bounds that hold.
#include <gtest/gtest.h>
#include <mobb/blocks.h>
#include <mobb/placed_chain.h>
#include <mobb/query.h>
#include <mobb/random_chain.h>
#include <mobb/random_motion.h>
#include <mobb/trace.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobb {
namespace {

using test::Random;

/// Half of them under 64 samples, now and then linear.
ClipPtr nasty_clip(Random& random, double dt = 0) {
    return test::random_motion(random, test::random_clip(random, random.chance(0.5) ? 63 : 2000, dt));
}

/// Sets of instructions in turn; the fastest again at the end.
class EachInstructionSet {
  public:
    EachInstructionSet() = default;
    EachInstructionSet(const EachInstructionSet&) = delete;
    EachInstructionSet& operator=(const EachInstructionSet&) = delete;
    ~EachInstructionSet() { use_instruction_set(names_.front()); }

    const std::vector<std::string_view>& names() const { return names_; }

  private:
    std::vector<std::string_view> names_ = instruction_sets();
};

TEST(Blocks, GivesTheDirectSearchsAnswersOnEveryInstructionSet) {
    const EachInstructionSet sets;
    Random random(71);
    int hits = 0;
    for (int query_count = test::query_budget() / 10; query_count > 0;) {
        const ClipPtr clip_a = nasty_clip(random);
        const ClipPtr clip_b = nasty_clip(random, random.chance(0.6) ? clip_a->dt() : 0);
        const Blocks blocks_a(clip_a), blocks_b(clip_b);
        for (int i = 0; i < 10; ++i, --query_count) {
            Placement place_a, place_b;
            test::random_placements(random, *clip_a, *clip_b, place_a, place_b);
            const std::optional<Contact> expected =
                direct_search(PlacedClip(*clip_a, place_a), PlacedClip(*clip_b, place_b));
            hits += expected ? 1 : 0;
            const PlacedBlocks a(blocks_a, place_a), b(blocks_b, place_b);
            for (const std::string_view set : sets.names()) {
                ASSERT_TRUE(use_instruction_set(set));
                ASSERT_EQ(query(a, b), expected) << set << ", " << query_count << " queries before the end";
                ASSERT_EQ(intersects(b, a), expected.has_value()) << set;
            }
        }
    }
    EXPECT_GT(hits, test::query_budget() / 100);
}

/// A walk that turns at will, at some metres a sample: of long ones few come near each other.
ClipPtr long_walk(Random& random, int samples, double step, double dt) {
    std::vector<Disk> walk;
    double x = random.real(-1, 1), y = random.real(-1, 1), heading = random.real(0, 7);
    for (int i = 0; i < samples; ++i) {
        walk.push_back({x, y, random.real(0.2, 0.5)});
        heading += random.real(-0.3, 0.3);
        x += step * std::cos(heading), y += step * std::sin(heading);
    }
    return std::make_shared<const Clip>(dt, walk, random.chance(0.2) ? Motion::linear : Motion::held);
}

TEST(Blocks, GivesTheDirectSearchsAnswersOnClipsOfSeveralLevels) {
    const EachInstructionSet sets;
    Random random(80);
    int hits = 0, levels = 0;
    for (int round = 0; round < 40; ++round) {
        const auto length = [&] { return static_cast<int>(std::pow(10, random.real(3.4, 4.7))); };
        const double step = random.real(0.005, 0.05);
        const Blocks blocks_a(long_walk(random, length(), step, 0.04));
        // Each pair of units that clips of different dt are tested by.
        constexpr std::array kRatios{1.0, 1.0, 1.0, 1.25, 1 / 1.25, 7.0, 1 / 7.0, 40.0, 1 / 40.0};
        const double ratio = kRatios[static_cast<std::size_t>(random.integer(0, int{kRatios.size()} - 1))];
        const Blocks blocks_b(long_walk(random, length(), step * ratio, 0.04 * ratio));
        levels = std::max(levels, std::min(blocks_a.levels(), blocks_b.levels()));
        for (int i = 0; i < 20; ++i) {
            Placement place_a, place_b;
            test::random_placements(random, blocks_a.clip(), blocks_b.clip(), place_a, place_b);
            if (random.chance(0.5)) place_b.translate *= 0.2 * std::sqrt(blocks_a.count());
            const PlacedBlocks a(blocks_a, place_a), b(blocks_b, place_b);
            const PlacedClip clip_a(blocks_a.clip(), place_a), clip_b(blocks_b.clip(), place_b);
            const std::optional<Contact> expected = direct_search(clip_a, clip_b);
            hits += expected ? 1 : 0;
            for (const std::string_view set : sets.names()) {
                ASSERT_TRUE(use_instruction_set(set));
                ASSERT_EQ(query(a, b), expected) << set;
                ASSERT_EQ(intersects(b, a), expected.has_value()) << set;
            }
            if (i == 0) {
                EXPECT_EQ(contact_intervals(a, b), direct_contact_intervals(clip_a, clip_b));
            }
        }
    }
    EXPECT_GE(levels, 3);
    EXPECT_GT(hits, 100);
    EXPECT_LT(hits, 700);
}

/// Of a chain whose first link's clip is to be placed so.
Placement of_chain(const Placement& clip, const ChainLink& first) {
    Placement out = clip;
    out.rotate_deg = out.rotate_deg - first.rotate_deg;
    out.translate -= Rotation::from_degrees(out.rotate_deg)(first.translate);
    return out;
}

TEST(Blocks, OfChainsGivesTheDirectSearchsAnswersOnEveryInstructionSet) {
    const EachInstructionSet sets;
    Random random(84);
    int hits = 0, asked = 0;
    while (asked < test::query_budget() / 50) {
        const auto links = [&] { return test::random_running_links(random, 5, 1, 400, TreeKind::blocks); };
        const std::vector<ChainLink> links_a = links(), links_b = links();
        const Chain a(links_a), b(links_b);
        const ClipPtr clip = nasty_clip(random, random.chance(0.6) ? a.dt() : 0);
        const Tree tree(clip, {.tree = TreeKind::blocks});
        for (int k = 0; k < 10; ++k) {
            Placement place_a, place_b, place_c;
            test::random_placements(random, a.part(0).clip(), b.part(0).clip(), place_a, place_b);
            const double late = random.chance(0.3) ? std::pow(10, random.real(5, 11)) : 0;
            place_a.start += late, place_b.start += late;
            const PlacedChain chain_a(a, of_chain(place_a, links_a[0])), chain_b(b, of_chain(place_b, links_b[0]));
            test::random_placements(random, a.part(0).clip(), *clip, place_a, place_c);
            if (late > 0) {
                // In step, but for rounding.
                place_c.start = place_a.start + a.dt() * random.integer(-50, 50);
                place_a.start += late, place_c.start += late;
            }
            const PlacedChain other_a(a, of_chain(place_a, links_a[0]));
            const PlacedTree placed(tree, place_c);
            const std::optional<Contact> expected = direct_search(chain_a, chain_b);
            const std::optional<Contact> with_clip = direct_search(placed.placed_clip(), other_a);
            for (const std::string_view set : sets.names()) {
                ASSERT_TRUE(use_instruction_set(set));
                ASSERT_EQ(query(chain_a, chain_b), expected) << set << ", " << asked;
                ASSERT_EQ(query(placed, other_a), with_clip) << set << ", " << asked;
            }
            if (k == 0) {
                ASSERT_EQ(contact_intervals(chain_a, chain_b), direct_contact_intervals(chain_a, chain_b)) << asked;
            }
            hits += (expected ? 1 : 0) + (with_clip ? 1 : 0);
            asked += 2;
        }
    }
    EXPECT_GT(hits, asked / 10);
}

TEST(Blocks, FindsAllIntervalsOfContact) {
    const EachInstructionSet sets;
    Random random(72);
    for (int round = 0; round < 3000; ++round) {
        const ClipPtr clip_a = nasty_clip(random);
        const ClipPtr clip_b = nasty_clip(random, random.chance(0.6) ? clip_a->dt() : 0);
        const Blocks blocks_a(clip_a), blocks_b(clip_b);
        Placement place_a, place_b;
        test::random_placements(random, *clip_a, *clip_b, place_a, place_b);
        ASSERT_TRUE(use_instruction_set(sets.names()[static_cast<std::size_t>(round) % sets.names().size()]));
        EXPECT_EQ(contact_intervals(PlacedBlocks(blocks_a, place_a), PlacedBlocks(blocks_b, place_b)),
                  direct_contact_intervals(PlacedClip(*clip_a, place_a), PlacedClip(*clip_b, place_b)));
    }
}

TEST(Blocks, DoesNotDependOnHowFarAwayOrHowLateOrHowUnlikeTwoClipsAre) {
    const EachInstructionSet sets;
    Random random(73);
    int hits = 0;
    const int rounds = test::query_budget() / 200;
    for (int round = 0; round < rounds; ++round) {
        // One has up to 300 samples to each of the other's, which last up to hours.
        const double dt = random.chance(0.7) ? random.real(0.01, 0.1) : std::pow(10, random.real(-4, 2.4));
        const ClipPtr clip_a = nasty_clip(random, dt);
        const ClipPtr clip_b = nasty_clip(random, random.chance(0.5) ? dt : dt * std::pow(10, random.real(0, 2.5)));
        const Blocks blocks_a(clip_a), blocks_b(clip_b);
        Placement place_a, place_b;
        test::random_placements(random, *clip_a, *clip_b, place_a, place_b);
        // Times of which a double holds a tenth of a microsecond to a tenth of a millisecond, and places likewise.
        const double latest = std::min(clip_a->most_start(), clip_b->most_start()) / 2;
        const double later = random.chance(0.5) ? std::min(std::pow(10, random.real(5, 12)), latest) : 0;
        const double away = random.chance(0.3) ? std::pow(10, random.real(4, 8.9)) : 0;
        for (Placement* place : {&place_a, &place_b}) {
            place->start += later;
            place->translate += glm::dvec2(away, -away);
        }
        const PlacedClip disks_a(*clip_a, place_a), disks_b(*clip_b, place_b);
        const PlacedBlocks a(blocks_a, place_a), b(blocks_b, place_b);
        const auto expected = direct_search(disks_a, disks_b);
        for (const std::string_view set : sets.names()) {
            ASSERT_TRUE(use_instruction_set(set));
            ASSERT_EQ(query(a, b), expected) << set << ", " << round;
            ASSERT_EQ(intersects(b, a), expected.has_value()) << set << ", " << round;
            std::array<bool, 2> answers{};
            intersects_each(std::array<BlocksPair, 2>{{{&a, &b}, {&b, &a}}}, answers);
            ASSERT_EQ(answers, (std::array{expected.has_value(), expected.has_value()})) << set << ", " << round;
        }
        ASSERT_EQ(contact_intervals(a, b), direct_contact_intervals(disks_a, disks_b)) << round;
        hits += expected ? 1 : 0;
    }
    EXPECT_GT(hits, rounds / 10);
}

TEST(Blocks, OfTwoSideBySideGivesTheDirectSearchsAnswersOnEveryInstructionSet) {
    const EachInstructionSet sets;
    Random random(86);
    int hits = 0;
    const int rounds = test::query_budget() / 2000;
    for (int round = 0; round < rounds; ++round) {
        // A path, and one to its left, less than a step and down to hairs away from it.
        const int samples = random.integer(2, 3000);
        const double step = random.real(0.01, 0.2), dt = random.chance(0.3) ? 2.5 : 1.0 / 30;
        const double clearance = random.chance(0.1) ? -1e-3 : std::pow(10, random.real(-10, -1));
        std::vector<Disk> walk, beside;
        double x = 0, y = 0, heading = random.real(0, 7);
        for (int i = 0; i < samples; ++i) {
            const double r = random.real(0.3, 0.5), far = r + 0.4 + clearance;
            walk.push_back({x, y, 0.4});
            beside.push_back({x - far * std::sin(heading), y + far * std::cos(heading), r});
            x += step * std::cos(heading), y += step * std::sin(heading);
            heading += random.real(-0.01, 0.01);
        }
        const Motion motion = random.chance(0.3) ? Motion::linear : Motion::held;
        const Blocks blocks_a(std::make_shared<const Clip>(dt, walk, motion));
        const Blocks blocks_b(std::make_shared<const Clip>(dt, beside, random.chance(0.7) ? motion : Motion::held));
        // In step, or one somewhat behind the other.
        const double start = random.chance(0.5) ? 0 : 1.7e9;
        const double later = random.chance(0.4) ? dt * random.integer(-1, 1) : dt * random.real(-1, 1);
        const Placement place_a{.start = start}, place_b{.start = start + later};
        const PlacedClip disks_a(blocks_a.clip(), place_a), disks_b(blocks_b.clip(), place_b);
        const PlacedBlocks a(blocks_a, place_a), b(blocks_b, place_b);
        const std::optional<Contact> expected = direct_search(disks_a, disks_b);
        hits += expected ? 1 : 0;
        for (const std::string_view set : sets.names()) {
            ASSERT_TRUE(use_instruction_set(set));
            ASSERT_EQ(query(a, b), expected) << set << ", " << round;
            ASSERT_EQ(intersects(a, b), expected.has_value()) << set << ", " << round;
            ASSERT_EQ(intersects(b, a), expected.has_value()) << set << ", " << round;
        }
    }
    EXPECT_GT(hits, rounds / 10);
    EXPECT_LT(hits, rounds / 2);
}

TEST(Blocks, TellsHowLongSamplesShareAsTheDirectSearchDoes) {
    // Two samples that overlap, and nothing else that comes near: they share about what they must at least.
    const EachInstructionSet sets;
    Random random(83);
    int hits = 0, queries = 0;
    for (const double dt : {1.0 / 30, 0.1, 0.5, 1.9, 2.1, 2.5, 100.0, 3600.0}) {
        // Some are by a hair those at which the units change that clips are tested by.
        constexpr double kHair = 1 + 1e-7;
        for (const double ratio : {1.0, kHair, 1 / kHair, 1.7, 1 / 1.7, 9.0, 1 / 9.0, 16 * kHair, 1 / 16.0 / kHair,
                                   16 / kHair, kHair / 16, 50.0, 1 / 50.0}) {
            // The pair is at the edge of blocks, or of clips.
            for (const auto& [sample_a, sample_b] :
                 {std::pair{16, 15}, {16, 16}, {32, 31}, {31, 32}, {16, 0}, {16, 39}, {0, 39}, {39, 0}}) {
                const double dt_b = dt * ratio;
                std::vector<Disk> disks_a(40, {100, 0, 0.5}), disks_b(40, {-100, 0, 0.5});
                disks_a[static_cast<std::size_t>(sample_a)] = {0, 0, 0.5};
                disks_b[static_cast<std::size_t>(sample_b)] = {0, 0, 0.5};
                const auto clip_a = std::make_shared<const Clip>(dt, disks_a),
                           clip_b = std::make_shared<const Clip>(dt_b, disks_b);
                const Blocks blocks_a(clip_a), blocks_b(clip_b);
                const FitOptions of_blocks{.tree = TreeKind::blocks};
                const Tree tree_a(clip_a, of_blocks), tree_b(clip_b, of_blocks);
                for (int i = 0; i < 100; ++i, ++queries) {
                    // Late ones share a few times what times are rounded to, or less than nothing.
                    const bool late = i % 2 != 0;
                    const double start = late ? std::pow(10, random.real(4.5, 10)) : random.real(0, 10);
                    const double share =
                        random.real(0.7e-9, 1.3e-9) + (late ? start * random.integer(-3, 3) * 0x1p-53 : 0);
                    const Placement place_a{.start = start};
                    // B's sample begins before A's ends, or ends after A's begins.
                    const double later = random.chance(0.5) ? dt - share : share - dt_b;
                    const Placement place_b{.start = start + sample_a * dt + later - sample_b * dt_b};
                    const PlacedBlocks a(blocks_a, place_a), b(blocks_b, place_b);
                    const std::optional<Contact> expected =
                        direct_search(PlacedClip(*clip_a, place_a), PlacedClip(*clip_b, place_b));
                    hits += expected ? 1 : 0;
                    ASSERT_TRUE(use_instruction_set(sets.names()[static_cast<std::size_t>(i) % sets.names().size()]));
                    ASSERT_EQ(query(a, b), expected) << dt << " " << dt_b << " " << share;
                    ASSERT_EQ(intersects(a, b), expected.has_value()) << dt << " " << dt_b << " " << share;
                    std::array<bool, 1> answer{};
                    intersects_each(std::array{BlocksPair{&a, &b}}, answer);
                    ASSERT_EQ(answer[0], expected.has_value()) << dt << " " << dt_b << " " << share;
                    TraceRecorder recorder;
                    ASSERT_EQ(query(PlacedTree(tree_a, place_a), PlacedTree(tree_b, place_b), recorder), expected)
                        << dt << " " << dt_b << " " << share;
                }
            }
        }
    }
    EXPECT_GT(hits, queries / 4);
    EXPECT_LT(hits, queries * 3 / 4);
}

/// What is said of a place by whatever is placed; empty: nothing.
template <class Make>
std::string said_of(const Make& make) {
    try {
        make();
        return {};
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

TEST(Placed, EachRefusesWhatIsNoPlaceOrStart) {
    const auto clip = std::make_shared<const Clip>(0.1, std::vector<Disk>{{0, 0, 1}, {1, 0, 1}});
    const Blocks blocks(clip);
    const auto tree = std::make_shared<const Tree>(clip, FitOptions{});
    const Chain chain(std::vector<ChainLink>{{.part = std::make_shared<const ChainPart>(tree)}});
    const auto expect = [&](const Placement& place, const std::string& said) {
        EXPECT_EQ(said_of([&] { PlacedClip(*clip, place); }), said);
        EXPECT_EQ(said_of([&] { PlacedTree(*tree, place); }), said);
        EXPECT_EQ(said_of([&] { PlacedChain(chain, place); }), said);
        EXPECT_EQ(said_of([&] { PlacedBlocks(blocks, place); }), said);
    };
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), kInfinity, -kInfinity, 1.1e12, -1.1e12}) {
        expect({.translate = {bad, 0}}, "translate must be finite and within 1e9 m");
        expect({.translate = {0, bad}}, "translate must be finite and within 1e9 m");
        expect({.rotate_deg = bad}, "rotate_deg must be finite and within 1e9 degrees");
        expect({.start = bad}, "start must be finite and within 1e12 s");
    }
    expect({.translate = {kMaxLength, -kMaxLength}, .start = -kMaxTime}, "");
    expect({.rotate_deg = -kMaxDegrees}, "");
    for (const Rotation rotation :
         {Rotation{std::nan(""), 0}, {0, std::nan("")}, {kInfinity, 0}, {0, -kInfinity}, {0, 0}, {1, 1e-2}})
        EXPECT_EQ(said_of([&] { Turn::by(rotation.c, rotation.s); }),
                  "a rotation's cosine and sine must have squares that add up to 1");
    Chain shorter = chain;
    EXPECT_EQ(said_of([&] { shorter.drop_before(std::nan("")); }), "the chain time to drop before must not be NaN");
    for (const double seconds : {-kInfinity, kInfinity}) shorter.drop_before(seconds);
}

TEST(Placed, BlocksTakeTheirPlaceInBraces) {
    const Blocks blocks(std::make_shared<const Clip>(0.1, std::vector<Disk>{{0, 0, 1}, {1, 0, 1}}));
    const PlacedBlocks here(blocks, {});
    EXPECT_EQ(here.disk(1).x, 1);
    EXPECT_EQ(here.begin_time(), 0);
    const PlacedBlocks there(blocks, {.translate = {3, 4}});
    EXPECT_EQ(there.disk(1).x, 4);
    EXPECT_EQ(there.disk(1).y, 4);
    const PlacedBlocks turned(blocks, {.translate = {3, 4}, .rotate_deg = 90, .start = 5});
    EXPECT_EQ(turned.disk(1).x, 3);
    EXPECT_EQ(turned.disk(1).y, 5);
    EXPECT_EQ(turned.begin_time(), 5);
    const PlacedBlocks by_place(blocks, {{3, 4}, 90, 5});
    EXPECT_EQ(by_place.disk(1).y, 5);
}

TEST(Blocks, TheOnlyOneThatCollidesIsFoundAtAnyPlaceOfAnyNumber) {
    const EachInstructionSet sets;
    const auto walk = [](int samples, double dt) {
        std::vector<Disk> disks;
        for (int i = 0; i < samples; ++i) disks.push_back({dt * i, 0, 0.4});
        return std::make_shared<const Clip>(dt, disks);
    };
    // The others last as long, are of another dt, or have so many blocks that no first look is had.
    const Blocks blocks(walk(60, 0.04)), other_dt(walk(70, 0.03)), longer(walk(5000, 0.04));
    const PlacedBlocks a(blocks, {});
    std::vector<PlacedBlocks> misses, hits;
    for (const Blocks* other : {&blocks, &other_dt, &longer}) {
        misses.emplace_back(*other, Placement{.start = 1000});                             // apart in time
        misses.emplace_back(*other, Placement{.translate = {50, 400}});                    // their roots are
        misses.emplace_back(*other, Placement{.translate = {0, 0.8 + 1e-7}});              // by a hair, side by side
        misses.emplace_back(*other, Placement{.translate = {1.2, -3}, .rotate_deg = 90});  // crosses behind
        hits.emplace_back(*other, Placement{});
        hits.emplace_back(*other, Placement{.translate = {0, 0.8 - 1e-7}});
        hits.emplace_back(*other, Placement{.translate = {2.4, 0}, .start = 2.39});  // the last sample alone
    }
    for (const PlacedBlocks& miss : misses) ASSERT_FALSE(direct_search(a, miss));
    for (const PlacedBlocks& hit : hits) ASSERT_TRUE(direct_search(a, hit));
    // Of all sorts, and of one that no first look decides.
    std::vector<PlacedBlocks> undecided{misses[2]};
    for (const std::string_view set : sets.names()) {
        ASSERT_TRUE(use_instruction_set(set));
        for (const std::size_t count : {1U, 2U, 63U, 64U, 65U, 127U, 128U, 129U, 150U, 192U, 200U, 1000U}) {
            for (const std::vector<PlacedBlocks>* missing : {&misses, &undecided}) {
                std::vector<const PlacedBlocks*> others;
                for (std::size_t i = 0; i < count; ++i) others.push_back(&(*missing)[i * 7 % missing->size()]);
                const auto expect = [&](std::optional<std::size_t> first, std::optional<std::size_t> second) {
                    ASSERT_EQ(intersects_any(a, others), first) << set << ", of " << count;
                    std::vector<BlocksPair> pairs;
                    for (const PlacedBlocks* other : others) pairs.push_back({other, &a});
                    const auto answers = std::make_unique<bool[]>(count);
                    for (std::size_t i = 0; i < count; ++i) answers[i] = first != i;
                    intersects_each(pairs, {answers.get(), count});
                    for (std::size_t i = 0; i < count; ++i)
                        ASSERT_EQ(answers[i], first == i || second == i) << set << ", " << i << " of " << count;
                };
                expect({}, {});
                for (const std::size_t place :
                     {std::size_t{0}, std::size_t{1}, std::size_t{31}, std::size_t{62}, std::size_t{63},
                      std::size_t{64}, std::size_t{65}, std::size_t{126}, std::size_t{127}, std::size_t{128},
                      std::size_t{129}, std::size_t{191}, std::size_t{192}, std::size_t{640}, count - 2, count - 1}) {
                    if (place >= count) continue;
                    const PlacedBlocks* const miss = others[place];
                    for (std::size_t k = 0; k<hits.size(); k += count> 200 ? 4 : 1) {
                        others[place] = &hits[k];
                        expect(place, {});
                    }
                    // A second one changes nothing for the first.
                    for (const PlacedBlocks& hit : {hits[0], hits[1]}) {
                        others[place] = &hit;
                        const PlacedBlocks* const last = std::exchange(others[count - 1], &hits[0]);
                        expect(place, count - 1);
                        others[count - 1] = last;
                    }
                    others[place] = miss;
                }
            }
        }
    }
}

TEST(Blocks, EachPairMustHaveItsAnswer) {
    std::array<bool, 2> answers{};
    EXPECT_THROW(intersects_each(std::array<BlocksPair, 3>{}, answers), std::invalid_argument);
    EXPECT_THROW(intersects_each(std::array<BlocksPair, 1>{}, answers), std::invalid_argument);
}

TEST(Blocks, RootsThatMoveMeetWhereLateDisksDo) {
    Random random(87);
    int hits = 0, queries = 0;
    for (; queries < 20'000; ++queries) {
        // Straight ahead, so that roots are as large as disks, and past each other by what times are rounded to.
        const double start = std::pow(10, random.real(10, 12)), dt = 0.01;
        const glm::dvec2 a(random.real(-20, 20), random.real(-20, 20)), b(random.real(-20, 20), random.real(-20, 20));
        const auto clip_of = [&](glm::dvec2 velocity) {
            std::vector<Disk> disks;
            for (int i = -5; i <= 5; ++i) disks.push_back({velocity.x * dt * i, velocity.y * dt * i, 0.5});
            return std::make_shared<const Clip>(dt, disks, Motion::linear);
        };
        const Blocks blocks_a(clip_of(a)), blocks_b(clip_of(b));
        const glm::dvec2 aside = glm::dvec2(a.y - b.y, b.x - a.x) / std::hypot(a.x - b.x, a.y - b.y);
        const double far = 1 + random.real(-1, 1) * 20 * start * 0x1p-53;
        const double later = random.real(-0.05, 0.05);
        const Placement place_a{.start = start};
        const Placement place_b{.translate = far * aside + (start + later - start) * b, .start = start + later};
        const bool expected =
            direct_search(PlacedClip(blocks_a.clip(), place_a), PlacedClip(blocks_b.clip(), place_b)).has_value();
        hits += expected ? 1 : 0;
        ASSERT_EQ(intersects(PlacedBlocks(blocks_a, place_a), PlacedBlocks(blocks_b, place_b)), expected) << queries;
    }
    EXPECT_GT(hits, queries / 4);
    EXPECT_LT(hits, queries * 3 / 4);
}

TEST(Blocks, RootsThatMoveMeetHoweverSlowly) {
    for (const double dt : {1e-3, 1.0, 1e5, 1e10}) {
        std::vector<Disk> walk;
        for (int i = -25; i <= 25; ++i) walk.push_back({2e-5 * i, 0, 1e-6});
        const Blocks walks(std::make_shared<const Clip>(dt, walk, Motion::linear));
        const Blocks stands(std::make_shared<const Clip>(dt, std::vector<Disk>(51, {0, 1e-6, 1e-6})));
        EXPECT_TRUE(intersects(PlacedBlocks(walks, {}), PlacedBlocks(stands, {}))) << dt;
        EXPECT_TRUE(intersects(PlacedBlocks(stands, {}), PlacedBlocks(walks, {}))) << dt;
    }
}

TEST(Blocks, TheFirstThatCollidesIsFoundAmongMany) {
    Random random(74);
    for (int round = 0; round < 300; ++round) {
        const ClipPtr clip = nasty_clip(random);
        const Blocks blocks(clip);
        const PlacedBlocks a(blocks, Placement{});
        std::vector<PlacedBlocks> others;
        std::optional<std::size_t> expected;
        for (std::size_t i = 0; i < 12; ++i) {
            Placement mine, place;
            test::random_placements(random, *clip, *clip, mine, place);
            others.emplace_back(blocks, place);
            if (!expected && direct_search(a, others.back())) expected = i;
        }
        std::vector<const PlacedBlocks*> pointers;
        for (const PlacedBlocks& other : others) pointers.push_back(&other);
        EXPECT_EQ(intersects_any(a, pointers), expected);
        std::vector<BlocksPair> pairs;
        for (const PlacedBlocks& other : others) pairs.push_back({&other, &a});
        std::array<bool, 12> answers{};
        intersects_each(pairs, answers);
        for (std::size_t i = 0; i < others.size(); ++i)
            EXPECT_EQ(answers[i], direct_search(others[i], a).has_value()) << i;
    }
}

/// How far a disk reaches out of a bound, metres.
double beyond(const Disk& disk, glm::dvec2 center, double radius) {
    return std::hypot(disk.x - center.x, disk.y - center.y) + disk.r - radius;
}

TEST(Blocks, BoundsHoldEveryDiskAndNoMore) {
    Random random(75);
    for (int round = 0; round < 400; ++round) {
        const ClipPtr clip = nasty_clip(random);
        const bool linear = clip->motion() == Motion::linear;
        const Blocks blocks(clip);
        const Placement place;
        const PlacedClip samples(*clip, place);
        for (int i = 0; i < blocks.node_count(); ++i) {
            const Blocks::Node node = blocks.node(i);
            double most = -1e300;
            const int steps = std::min(node.first + node.count, clip->steps()) - node.first;
            for (int k = 0; k < node.count; ++k) {
                const auto center = [&](int at) {
                    return node.bound.from + node.bound.drift * (double(std::min(at, steps)) / std::max(steps, 1));
                };
                most = std::max(most, beyond(samples.disk(node.first + k), center(k), node.bound.radius));
                most = std::max(most, beyond(samples.disk_at_end(node.first + k), center(k + 1), node.bound.radius));
            }
            EXPECT_LE(most, 1e-9 * (1 + clip->reach() * 1e-3)) << i << (linear ? " linear" : " held");
            EXPECT_GE(most, -1e-6 * (1 + 2 * blocks.radius())) << i;
        }
    }
}

TEST(Blocks, WindowsHoldTheirSamples) {
    Random random(77);
    for (int round = 0; round < 400; ++round) {
        const ClipPtr clip = nasty_clip(random);
        const Blocks blocks(clip);
        const int n = blocks.count();
        const double rounding = 1e-6 * (1 + 2 * blocks.radius());
        const Blocks::Rings samples = blocks.samples();
        const auto sample = [&](int i) { return Disk{samples.x[i], samples.y[i], samples.inner[i]}; };
        // How far the samples [first, last] that there are reach out of a disk, and whether there are any.
        const auto reach_out = [&](int first, int last, glm::dvec2 center, double radius) {
            double most = -1e300;
            for (int i = std::max(first, 0); i <= std::min(last, n - 1); ++i)
                most = std::max(most, beyond(sample(i), center, radius));
            return most;
        };
        const PlacedClip placed(*clip, Placement{});
        for (int i = 0; i < n; ++i) {
            const glm::dvec2 center = blocks.origin() + glm::dvec2(sample(i).x, sample(i).y);
            EXPECT_NEAR(std::max(beyond(placed.disk(i), center, sample(i).r),
                                 beyond(placed.disk_at_end(i), center, sample(i).r)),
                        0, rounding);
            EXPECT_NEAR(reach_out(i, i + 1, {sample(i).x, sample(i).y}, samples.outer[i]), 0, rounding);
        }
        EXPECT_NEAR(reach_out(0, 0, {samples.x[-1], samples.y[-1]}, samples.outer[-1]), 0, rounding);
        constexpr int kHalf = Blocks::kRun / 2;
        for (int number = 0; number < static_cast<int>(Blocks::kPhases.size()); ++number) {
            const Blocks::Rings windows = blocks.windows(number);
            const int phase = Blocks::kPhases[static_cast<std::size_t>(number)];
            for (int place = 0, j = phase - kHalf; j < n + kHalf; ++place, j += Blocks::kRun) {
                const int nearest = std::clamp(j, 0, n - 1);
                const glm::dvec2 center(windows.x[place], windows.y[place]);
                EXPECT_EQ(center, glm::dvec2(sample(nearest).x, sample(nearest).y)) << j;
                EXPECT_EQ(windows.inner[place], j == nearest ? samples.inner[j] : -Blocks::kNever) << j;
                EXPECT_NEAR(reach_out(j - kHalf, j + kHalf, center, windows.outer[place]), 0, rounding)
                    << j << " of " << n;
            }
        }
    }
}

TEST(Blocks, WindowsOfHigherLevelsHoldTheirSamples) {
    Random random(81);
    for (const int count : {2049, 5000, 20'000}) {
        const Blocks blocks(long_walk(random, count, 0.03, 0.04));
        const Blocks::Rings samples = blocks.samples();
        ASSERT_GT(blocks.levels(), 1);
        for (int level = 1; level < blocks.levels(); ++level) {
            const int unit = Blocks::span(level - 1), half = Blocks::span(level) / 2,
                      last = (count - 1 + half + unit / 2) / unit;
            for (int number = -half / unit; number <= last; ++number) {
                const Blocks::Rings windows = blocks.windows(level, number);
                const int place = Blocks::place_of_number(number), middle = number * unit;
                const int nearest = std::clamp(middle, 0, count - 1);
                EXPECT_EQ(windows.x[place], samples.x[nearest]);
                EXPECT_EQ(windows.y[place], samples.y[nearest]);
                double most = -1;
                for (int i = std::max(0, middle - half - unit / 2); i < std::min(count, middle + half + unit / 2); ++i)
                    most = std::max(most, beyond({samples.x[i], samples.y[i], samples.inner[i]},
                                                 {windows.x[place], windows.y[place]}, windows.outer[place]));
                EXPECT_LT(most, 1e-4) << level << ", " << number << " of " << count;
            }
        }
    }
}

TEST(Blocks, RootsThatMoveHoldTheClip) {
    Random random(79);
    int moving = 0;
    for (int round = 0; round < 2000; ++round) {
        const ClipPtr clip = test::random_motion(random, test::random_clip(random, 150));
        const Blocks blocks(clip);
        moving += blocks.velocity() != glm::dvec2(0) ? 1 : 0;
        EXPECT_TRUE(blocks.is_short() || blocks.velocity() == glm::dvec2(0));
        const PlacedClip placed(*clip, Placement{});
        for (int i = 0; i < clip->count(); ++i) {
            const auto center = [&](int at) {
                return blocks.origin() + blocks.velocity() * (clip->time(at) - clip->duration() / 2);
            };
            const double room = 1e-9 * (1 + clip->reach());
            EXPECT_LE(beyond(placed.disk(i), center(i), static_cast<double>(blocks.root_radius())), room);
            EXPECT_LE(beyond(placed.disk_at_end(i), center(i + 1), static_cast<double>(blocks.root_radius())), room);
            EXPECT_LE(beyond(placed.disk(i), blocks.origin(), blocks.radius()), room);
        }
    }
    EXPECT_GT(moving, 200);
}

TEST(Blocks, LevelsCoverTheClip) {
    Random random(76);
    for (const int count : {1, 2, 31, 32, 33, 64, 1000, 4096, 4097, 40000}) {
        const Blocks blocks(std::make_shared<const Clip>(0.1, std::vector<Disk>(static_cast<std::size_t>(count))));
        EXPECT_EQ(blocks.node(0).first, 0);
        EXPECT_EQ(blocks.node(0).count, count);
        int next = blocks.node_count() == 1 ? 0 : 1;
        for (int level = blocks.levels() - 1; level >= 0; --level) {
            int first = 0;
            for (int block = 0; block < blocks.count(level); ++block, ++next) {
                EXPECT_EQ(blocks.node_of(level, block), next);
                const Blocks::Node node = blocks.node(next);
                EXPECT_EQ(node.block, block);
                EXPECT_EQ(node.first, first);
                first += node.count;
            }
            EXPECT_EQ(first, count);
        }
        EXPECT_EQ(next, blocks.node_count());
        EXPECT_LE(blocks.count(blocks.levels() - 1), Blocks::kMostAtTop);
    }
    EXPECT_THROW(Blocks(nullptr), std::invalid_argument);
}

/// All that a trace says, as text.
std::string text_of(const Trace& trace) {
    std::string out;
    for (int step = 0; step < trace.size(); ++step) {
        const Trace::Event event = trace[step];
        for (const double number : {double(event.parent), double(event.depth), double(event.a), double(event.b),
                                    double(event.test.index()), double(event.outcome), double(event.axis), event.gap})
            out += std::to_string(std::bit_cast<std::uint64_t>(number)) + ' ';
        for (const MeasuredPair& pair : event.pairs) out += std::to_string(pair.i) + ',' + std::to_string(pair.j) + ' ';
        out += '\n';
    }
    return out;
}

TEST(Blocks, TracesAreTheSameOnEveryInstructionSetAndCanBeWorkedOutAgain) {
    const EachInstructionSet sets;
    Random random(77);
    int separated = 0, levels = 0;
    for (int round = 0; round < 500; ++round) {
        const ClipPtr clip_a = nasty_clip(random);
        const ClipPtr clip_b = nasty_clip(random, random.chance(0.6) ? clip_a->dt() : 0);
        const Tree tree_a(clip_a, {.tree = TreeKind::blocks}), tree_b(clip_b, {.tree = TreeKind::blocks});
        Placement place_a, place_b;
        test::random_placements(random, *clip_a, *clip_b, place_a, place_b);
        const PlacedTree a(tree_a, place_a), b(tree_b, place_b);
        const auto expected = direct_search(a.placed_clip(), b.placed_clip());
        std::string first;
        for (const std::string_view set : sets.names()) {
            ASSERT_TRUE(use_instruction_set(set));
            TraceRecorder recorder;
            ASSERT_EQ(query(a, b, recorder), expected);
            const Trace trace = recorder.take();
            if (first.empty()) first = text_of(trace);
            ASSERT_EQ(text_of(trace), first) << set;
            Statistics statistics;
            query(a, b, statistics);
            EXPECT_EQ(trace.counts(), statistics.tests);
            if (set != sets.names().front()) continue;
            const RelativeFrame frame(a.frame(), b.frame(), a.time_scale());
            for (int step = 0; step < trace.size(); ++step) {
                const Trace::Event event = trace[step];
                levels = std::max(levels, event.depth);
                if (event.test != BoxKind::block) continue;
                const Separation again = separate_block(a.tree().box(event.a), b.tree().box(event.b), frame);
                if (event.outcome == Outcome::overlap) {
                    // Apart by less than single precision can tell.
                    EXPECT_LT(again.gap, 1e-4 * (10 + 2 * tree_a.blocks()->radius() + 2 * tree_b.blocks()->radius()));
                    // What overlaps is looked into.
                    ASSERT_LT(step + 1, trace.size());
                    const Trace::Event next = trace[step + 1];
                    EXPECT_TRUE(next.depth > event.depth || (next.a == event.a && next.b == event.b));
                    continue;
                }
                ++separated;
                EXPECT_EQ(event.axis, 0);
                EXPECT_NEAR(again.gap, event.gap, 1e-9 * (1 + std::abs(event.gap)));
                EXPECT_GT(event.gap, 0);
            }
        }
    }
    EXPECT_GT(separated, 200);
    EXPECT_GE(levels, 1);
}

TEST(Blocks, TestsGrowSlowerThanTheClips) {
    // Walks over an area that grows with them: placed at random, most pairs meet nobody.
    const auto tests_a_query = [](int samples) {
        Random random(78);
        std::vector<Disk> walk;
        double x = 0, y = 0, heading = 0;
        for (int i = 0; i < samples; ++i) {
            walk.push_back({x, y, 0.4});
            heading += random.real(-0.2, 0.2);
            x += 0.04 * std::cos(heading), y += 0.04 * std::sin(heading);
        }
        const Tree tree(std::make_shared<const Clip>(1.0 / 30, walk), {.tree = TreeKind::blocks});
        const double area = tree.blocks()->radius();
        std::vector<std::int64_t> tests;
        for (int i = 0; i < 101; ++i) {
            const PlacedTree a(tree, {});
            const PlacedTree b(tree, {.translate = {random.real(-area, area), random.real(-area, area)},
                                      .rotate_deg = random.real(0, 360),
                                      .start = random.real(-1, 1)});
            Statistics statistics;
            query(a, b, statistics);
            tests.push_back(statistics.tests.all());
        }
        std::sort(tests.begin(), tests.end());
        return tests[tests.size() / 2];
    };
    const std::int64_t minute = tests_a_query(1800), hour = tests_a_query(108000);
    EXPECT_LT(hour, 8 * minute) << minute << " tests a minute";
}

TEST(InstructionSets, TheLastIsScalarAndOthersAreRefused) {
    const EachInstructionSet sets;
    ASSERT_FALSE(sets.names().empty());
    EXPECT_EQ(sets.names().back(), "scalar");
    EXPECT_FALSE(use_instruction_set("z80"));
}

}  // namespace
}  // namespace mobb
