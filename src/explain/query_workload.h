/// Queries that fits are judged by, the tests that they make, and what these cost.
#pragma once

#include <mobb/observer.h>
#include <mobb/tree.h>
#include <scene/scene.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Placements of two clips that say nothing about any scene: A stays where its file has it and begins at 0; B is turned
/// to a heading that is uniform, begins at a start uniform within +-offset, and its middle is shifted from A's by what
/// is uniform over a square. They depend on the clips alone, so all fits are asked the same.
struct StandardPlacements {
    glm::dvec2 middle_a{0}, middle_b{0};  ///< of the box around the clip's disks
    double side = 0;    ///< m: four times what both reach around their middles: upright boxes never meet outside
    double offset = 0;  ///< s: the longer duration

    StandardPlacements(const mobb::Clip& a, const mobb::Clip& b);

    double area() const { return side * side; }

    struct Draw {
        double rotate_deg = 0, start = 0;  ///< of B
        glm::dvec2 shift{0};               ///< m, from A's middle to B's
    };
    /// What B's placement of that number is made of: the same for the same seed, on every machine.
    Draw draw(std::uint64_t seed, std::uint64_t index) const;
    mobb::Placement place(const Draw& drawn) const;
    mobb::Placement b(std::uint64_t seed, std::uint64_t index) const { return place(draw(seed, index)); }
};

/// Two clips of a list, each where it is placed.
struct ClipQuery {
    int clip_a = 0, clip_b = 0;
    mobb::Placement place_a, place_b;
};

/// Queries that fits are judged by. Every fit is asked the same.
struct QueryWorkload {
    enum class Kind {
        placements,  ///< StandardPlacements
        queries,     ///< those of a scene, or of a capture
    };
    Kind kind = Kind::placements;
    std::vector<ClipQuery> queries;
    // Of placements:
    double area = 0;         ///< m^2, of the shifts; the mean over the queries, as pairs of clips have their own
    double offset = 0;       ///< s, likewise: B starts within +-this
    std::uint64_t seed = 0;  ///< the same seed gives the same queries, of which a longer workload has more
};
/// As in files: "placements", "queries".
std::string_view name(QueryWorkload::Kind kind);

/// Standard placements of clips against each other and themselves: every pair as often as every other. Requires clips,
/// of which none is null.
QueryWorkload standard_workload(std::span<const mobb::ClipPtr> clips, std::size_t count, std::uint64_t seed);
/// As many queries as fits are judged by, where nobody says otherwise.
inline constexpr std::size_t kMostJudgedBy = 16'000;
/// The queries of a scene; its clips are the list. Of more than `most`, such as a crowd's, evenly many of all. There
/// may be none.
QueryWorkload scene_workload(const Scene& scene, std::size_t most = kMostJudgedBy);

/// The tests that a query makes. `trees`: by clip, none null. Throws std::invalid_argument if a placement is none that
/// may be.
mobb::TestCounts count_tests(const ClipQuery& query, std::span<const std::shared_ptr<const mobb::Tree>> trees);
/// Asks queries [first, all) of a workload on all processors, and gives the tests that each made. `trees`: by clip,
/// none null. `progress` is told by one thread at a time of how many of these were asked; it may throw to end the work.
/// Throws std::invalid_argument if a placement is none that may be.
std::vector<mobb::TestCounts> count_tests(const QueryWorkload& workload,
                                          std::span<const std::shared_ptr<const mobb::Tree>> trees,
                                          std::size_t first = 0, const Progress& progress = {});

/// Tests of a query as numbers that need not be whole: expected, or a mean.
struct MeanTests {
    std::array<double, mobb::kTestKindCount> by_kind{};

    constexpr double& operator[](mobb::TestKind test) { return by_kind[test.index()]; }
    double operator[](mobb::TestKind test) const { return by_kind[test.index()]; }
    double all() const { return std::accumulate(by_kind.begin(), by_kind.end(), 0.0); }
    double boxes() const;
    MeanTests& operator+=(const MeanTests& other);
};

MeanTests as_numbers(const mobb::TestCounts& counts);
/// Of sums over so many queries.
MeanTests mean_of(MeanTests sums, std::size_t queries);
/// Requires counts.
MeanTests mean_tests(std::span<const mobb::TestCounts> counts);

/// What a test of boxes costs, ns. Tests of blocks have no price: those that are counted are not those that a query
/// makes that nobody watches.
constexpr double price_of(mobb::BoxKind kind) {
    switch (kind) {
        case mobb::BoxKind::obb2d:
            return 14;
        case mobb::BoxKind::obb3d:
            return 37;
        case mobb::BoxKind::moving:
            return 26;
        case mobb::BoxKind::aabb:
            return 15;
        case mobb::BoxKind::block:
            return std::numeric_limits<double>::quiet_NaN();
    }
    throw "a box without a price";  // kTestPrices does not compile then
}
/// What each test costs, ns: a query's time is that of its tests, but for what every query takes. The same on every
/// machine; bench_advice prints what they are on this one (docs/performance.md, "The price of a test").
inline constexpr MeanTests kTestPrices = [] {
    MeanTests out;
    out[mobb::TestKind::time] = 3;
    for (const mobb::BoxKind kind : mobb::kBoxKinds) out[kind] = price_of(kind);
    out[mobb::TestKind::samples] = 1.4;
    return out;
}();

/// ns; NaN where a test has no price.
double cost_of(const MeanTests& tests, const MeanTests& prices = kTestPrices);
double cost_of(const mobb::TestCounts& tests);

/// A difference of fewer standard errors may be chance.
inline constexpr double kSureErrors = 3;

/// How numbers spread, one for each query. Of the differences between two fits, query by query, the standard error is
/// that of the paired difference.
struct Spread {
    double mean = 0, standard_error = 0;  ///< of the mean
    double p95 = 0, p99 = 0, max = 0;     ///< at least that share of the numbers is not above
};
/// Of a mean of `count` numbers, from the sum of the squares of their distances to it. NaN of a single number, which
/// says nothing of its error.
double standard_error(double squares, std::size_t count);
/// Requires numbers.
Spread spread_of(std::span<const double> numbers);

}  // namespace mobbscope
