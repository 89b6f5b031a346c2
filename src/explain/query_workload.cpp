#include <base/random.h>
#include <base/threads.h>
#include <explain/query_workload.h>
#include <mobb/query.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace mobbscope {

namespace {

constexpr double kLeastSide = 1e-9;  // m: points that stand meet nowhere, rather than everywhere

struct Around {
    glm::dvec2 middle{0};
    double reach = 0;
};

/// The middle of the box around a clip's disks, and how far from there they reach.
Around around(const mobb::Clip& clip) {
    const mobb::Disk& first = clip.samples().front();
    glm::dvec2 low{first.x, first.y}, high = low;
    for (const mobb::Disk& disk : clip.samples()) {
        low = {std::min(low.x, disk.x - disk.r), std::min(low.y, disk.y - disk.r)};
        high = {std::max(high.x, disk.x + disk.r), std::max(high.y, disk.y + disk.r)};
    }
    Around out{(low + high) / 2.0};
    for (const mobb::Disk& disk : clip.samples()) {
        out.reach = std::max(out.reach, std::hypot(disk.x - out.middle.x, disk.y - out.middle.y) + disk.r);
    }
    return out;
}

/// The number that a share of a sorted list is not above.
double quantile(std::span<const double> sorted, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

StandardPlacements::StandardPlacements(const mobb::Clip& a, const mobb::Clip& b)
    : offset(std::max(a.duration(), b.duration())) {
    const Around of_a = around(a), of_b = around(b);
    middle_a = of_a.middle;
    middle_b = of_b.middle;
    side = std::max(4 * (of_a.reach + of_b.reach), kLeastSide);
}

mobb::Placement StandardPlacements::b(std::uint64_t seed, std::uint64_t index) const {
    CounterRandom random(seed, index, 0);
    const auto centered = [&random] { return 2 * random.unit() - 1; };
    mobb::Placement place;
    place.rotate_deg = 180 * centered();
    place.start = offset * centered();
    const double dx = side / 2 * centered();
    const double dy = side / 2 * centered();
    place.translate = middle_a + glm::dvec2(dx, dy) - mobb::Rotation::from_degrees(place.rotate_deg)(middle_b);
    return place;
}

std::vector<PlacedQuery> standard_queries(const mobb::Tree& a, const mobb::Tree& b, std::size_t count,
                                          std::uint64_t seed) {
    const StandardPlacements placements(a.clip(), b.clip());
    std::vector<PlacedQuery> out;
    out.reserve(count);
    for (std::size_t i = 0; i < count; ++i) out.push_back({&a, &b, {}, placements.b(seed, i)});
    return out;
}

std::vector<mobb::TestCounts> count_tests(std::span<const PlacedQuery> queries, const Progress& progress) {
    constexpr std::size_t kTogether = 256;
    std::vector<mobb::TestCounts> out(queries.size());
    limit_worker_threads();
    std::mutex telling;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, (queries.size() + kTogether - 1) / kTogether, [&](std::size_t part) {
        const std::size_t first = part * kTogether, end = std::min(first + kTogether, queries.size());
        for (std::size_t i = first; i < end; ++i) {
            const PlacedQuery& asked = queries[i];
            mobb::Statistics statistics;
            mobb::query(mobb::PlacedTree(*asked.a, asked.place_a), mobb::PlacedTree(*asked.b, asked.place_b),
                        statistics);
            out[i] = statistics.tests;
        }
        if (!progress) return;
        const std::scoped_lock lock(telling);
        progress(done += end - first, queries.size());
    });
    return out;
}

double MeanTests::boxes() const {
    double sum = 0;
    for (const mobb::BoxKind kind : mobb::kBoxKinds) sum += (*this)[kind];
    return sum;
}

MeanTests& MeanTests::operator+=(const MeanTests& other) {
    for (std::size_t i = 0; i < by_kind.size(); ++i) by_kind[i] += other.by_kind[i];
    return *this;
}

MeanTests mean_tests(std::span<const mobb::TestCounts> counts) {
    MeanTests out;
    for (const mobb::TestCounts& tests : counts) {
        for (const mobb::TestKind kind : mobb::kTestKinds) out[kind] += static_cast<double>(tests[kind]);
    }
    for (double& mean : out.by_kind) mean /= static_cast<double>(counts.size());
    return out;
}

double cost_of(const MeanTests& tests, const MeanTests& prices) {
    return std::inner_product(tests.by_kind.begin(), tests.by_kind.end(), prices.by_kind.begin(), 0.0);
}

double cost_of(const mobb::TestCounts& tests, const MeanTests& prices) {
    return cost_of(mean_tests(std::span(&tests, 1)), prices);
}

Spread spread_of(std::span<const double> numbers) {
    std::vector<double> sorted(numbers.begin(), numbers.end());
    std::ranges::sort(sorted);
    const auto count = static_cast<double>(sorted.size());
    Spread out;
    out.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
    double squares = 0;
    for (const double number : sorted) squares += (number - out.mean) * (number - out.mean);
    if (sorted.size() > 1) out.standard_error = std::sqrt(squares / (count - 1) / count);
    out.p95 = quantile(sorted, 0.95);
    out.p99 = quantile(sorted, 0.99);
    out.max = sorted.back();
    return out;
}

}  // namespace mobbscope
