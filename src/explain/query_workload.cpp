#include <base/random.h>
#include <base/threads.h>
#include <explain/query_workload.h>
#include <mobb/query.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

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

StandardPlacements::Draw StandardPlacements::draw(std::uint64_t seed, std::uint64_t index) const {
    CounterRandom random(seed, index, 0);
    const auto centered = [&random] { return 2 * random.unit() - 1; };
    Draw out;
    out.rotate_deg = 180 * centered();
    out.start = offset * centered();
    out.shift.x = side / 2 * centered();
    out.shift.y = side / 2 * centered();
    return out;
}

mobb::Placement StandardPlacements::place(const Draw& drawn) const {
    const mobb::Turn turn = drawn.rotate_deg;
    return {.translate = middle_a + drawn.shift - turn.rotation()(middle_b), .rotate_deg = turn, .start = drawn.start};
}

std::string_view name(QueryWorkload::Kind kind) {
    return kind == QueryWorkload::Kind::placements ? "placements" : "queries";
}

QueryWorkload standard_workload(std::span<const mobb::ClipPtr> clips, std::size_t count, std::uint64_t seed) {
    QueryWorkload out;
    out.seed = seed;
    out.queries.reserve(count);
    std::map<std::pair<std::size_t, std::size_t>, StandardPlacements> placements;
    const std::size_t pairs = clips.size() * (clips.size() + 1) / 2;
    for (std::size_t i = 0; i < count; ++i) {
        // Pair k of the triangle of all; the golden ratio brings up all of them evenly, however few are asked.
        const double turn = static_cast<double>(i) * std::numbers::phi;
        auto k = static_cast<std::size_t>((turn - std::floor(turn)) * static_cast<double>(pairs));
        std::size_t b = 0;
        for (; k > b; ++b) k -= b + 1;
        const auto at = placements.try_emplace({k, b}, *clips[k], *clips[b]).first;
        out.queries.push_back({static_cast<int>(k), static_cast<int>(b), {}, at->second.b(seed, i)});
        out.area += at->second.area();
        out.offset += at->second.offset;
    }
    const auto asked = static_cast<double>(std::max<std::size_t>(count, 1));
    out.area /= asked;
    out.offset /= asked;
    return out;
}

QueryWorkload scene_workload(const Scene& scene, std::size_t most) {
    QueryWorkload out;
    out.kind = QueryWorkload::Kind::queries;
    const std::size_t count = query_count(scene), taken = std::min(count, most);
    out.queries.reserve(taken);
    const AskedPairs pairs(scene);
    for (std::size_t i = 0; i < taken; ++i) {
        const SceneQuery query = query_at(scene, pairs, i * count / taken);
        out.queries.push_back({query.a.clip, query.b.clip, query.a.placement, query.b.placement});
    }
    return out;
}

mobb::TestCounts count_tests(const ClipQuery& query, std::span<const std::shared_ptr<const mobb::Tree>> trees) {
    mobb::Statistics statistics;
    mobb::query(mobb::PlacedTree(*trees[static_cast<std::size_t>(query.clip_a)], query.place_a),
                mobb::PlacedTree(*trees[static_cast<std::size_t>(query.clip_b)], query.place_b), statistics);
    return statistics.tests;
}

std::vector<mobb::TestCounts> count_tests(const QueryWorkload& workload,
                                          std::span<const std::shared_ptr<const mobb::Tree>> trees, std::size_t first,
                                          const Progress& progress) {
    constexpr std::size_t kTogether = 256;
    const std::size_t count = workload.queries.size() - std::min(first, workload.queries.size());
    std::vector<mobb::TestCounts> out(count);
    limit_worker_threads();
    std::mutex telling;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, (count + kTogether - 1) / kTogether, [&](std::size_t part) {
        const std::size_t begin = part * kTogether, end = std::min(begin + kTogether, count);
        for (std::size_t i = begin; i < end; ++i) out[i] = count_tests(workload.queries[first + i], trees);
        if (!progress) return;
        const std::scoped_lock lock(telling);
        progress(done += end - begin, count);
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

MeanTests as_numbers(const mobb::TestCounts& counts) {
    MeanTests out;
    for (const mobb::TestKind kind : mobb::kTestKinds) out[kind] = static_cast<double>(counts[kind]);
    return out;
}

MeanTests mean_of(MeanTests sums, std::size_t queries) {
    for (double& sum : sums.by_kind) sum /= static_cast<double>(queries);
    return sums;
}

MeanTests mean_tests(std::span<const mobb::TestCounts> counts) {
    MeanTests sums;
    for (const mobb::TestCounts& tests : counts) sums += as_numbers(tests);
    return mean_of(sums, counts.size());
}

double cost_of(const MeanTests& tests, const MeanTests& prices) {
    double sum = 0;
    for (const mobb::TestKind kind : mobb::kTestKinds) sum += tests[kind] > 0 ? tests[kind] * prices[kind] : 0;
    return sum;
}

double cost_of(const mobb::TestCounts& tests) { return cost_of(as_numbers(tests)); }

double standard_error(double squares, std::size_t count) {
    const auto numbers = static_cast<double>(count);
    return count > 1 ? std::sqrt(squares / (numbers - 1) / numbers) : std::numeric_limits<double>::quiet_NaN();
}

Spread spread_of(std::span<const double> numbers) {
    std::vector<double> sorted(numbers.begin(), numbers.end());
    std::ranges::sort(sorted);
    Spread out;
    out.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
    double squares = 0;
    for (const double number : sorted) squares += (number - out.mean) * (number - out.mean);
    out.standard_error = standard_error(squares, sorted.size());
    out.p95 = quantile(sorted, 0.95);
    out.p99 = quantile(sorted, 0.99);
    out.max = sorted.back();
    return out;
}

}  // namespace mobbscope
