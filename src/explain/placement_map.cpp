#include <base/numbers_in_text.h>
#include <base/text.h>
#include <base/threads.h>
#include <explain/placement_map.h>
#include <explain/query_sentence.h>
#include <mobb/least_clearance.h>
#include <mobb/query.h>

#include <glm/common.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

namespace mobbscope {

namespace {

constexpr std::array<std::string_view, kMapAxes> kAxisNames{"dx", "dy", "dheading", "dstart"};
constexpr std::array<std::string_view, kMapAxes> kUnits{"m", "m", "\u00B0", "s"};
constexpr std::array<std::string_view, 3> kShowNames{"answer", "clearance", "tests"};

constexpr int kCoarsest = 8;

/// The number of a placement that an axis changes.
double along(const mobb::Placement& placement, MapAxis axis) {
    switch (axis) {
        case MapAxis::dx:
            return placement.translate.x;
        case MapAxis::dy:
            return placement.translate.y;
        case MapAxis::dheading:
            return placement.rotate_deg;
        case MapAxis::dstart:
            break;
    }
    return placement.start;
}
void set_along(mobb::Placement& placement, MapAxis axis, double value) {
    switch (axis) {
        case MapAxis::dx:
            placement.translate.x = value;
            return;
        case MapAxis::dy:
            placement.translate.y = value;
            return;
        case MapAxis::dheading:
            placement.rotate_deg = value;
            return;
        case MapAxis::dstart:
            placement.start = value;
    }
}

/// Those that a map shows.
std::int64_t tests_of(const mobb::Statistics& statistics) {
    return statistics.tests.boxes() + statistics.tests[mobb::TestKind::samples];
}

/// Asks the cells of a row.
class MapRows {
  public:
    MapRows(const FittedScene& fitted, const SceneQuery& query, PlacementMap& map)
        : fitted_(fitted),
          query_(query),
          map_(map),
          a_(fitted.placed(query.a)),
          blocks_a_(blocks_of(fitted.tree(query.a))),
          blocks_b_(blocks_of(fitted.tree(query.b))) {
        if (map.order.show == MapShow::clearance) {
            least_a_ = std::make_unique<const mobb::ClipDisks>(fitted.tree(query.a).clip());
            least_b_ = std::make_unique<const mobb::ClipDisks>(fitted.tree(query.b).clip());
        }
    }

    void ask(int y, std::span<const int> columns) const {
        switch (map_.order.show) {
            case MapShow::answer:
                return ask_answers(y, columns);
            case MapShow::clearance:
                return ask_clearances(y, columns);
            case MapShow::tests:
                return ask_tests(y, columns);
        }
    }

    /// Whether the two collide with B so far from its reference.
    std::unique_ptr<bool[]> collide(std::span<const glm::dvec2> offsets) const {
        const mobb::PlacedBlocks a(*blocks_a_, query_.a.placement);
        std::vector<mobb::PlacedBlocks> placed;
        placed.reserve(offsets.size());
        std::vector<mobb::BlocksPair> pairs;
        pairs.reserve(offsets.size());
        for (const glm::dvec2 offset : offsets) {
            placed.emplace_back(*blocks_b_, moved(map_.reference, map_.order, offset));
            pairs.push_back({&a, &placed.back()});
        }
        auto answers = std::make_unique<bool[]>(offsets.size());
        mobb::intersects_each(pairs, {answers.get(), offsets.size()});
        return answers;
    }

  private:
    /// The fastest, whatever the tree: answers are the same bit for bit.
    static std::shared_ptr<const mobb::Blocks> blocks_of(const mobb::Tree& tree) {
        if (tree.blocks()) return {std::shared_ptr<const void>(), tree.blocks()};
        return std::make_shared<const mobb::Blocks>(tree.shared_clip());
    }

    mobb::Placement placement(int x, int y) const { return moved(map_.reference, map_.order, map_.order.middle(x, y)); }
    void set(int x, int y, double value, bool hit) const {
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(map_.order.width) + static_cast<std::size_t>(x);
        map_.values[at] = value;
        map_.hits[at] = hit ? 1 : 0;
    }

    void ask_answers(int y, std::span<const int> columns) const {
        std::vector<glm::dvec2> offsets;
        for (const int x : columns) offsets.push_back(map_.order.middle(x, y));
        const std::unique_ptr<bool[]> answers = collide(offsets);
        for (std::size_t i = 0; i < columns.size(); ++i) set(columns[i], y, answers[i] ? 1 : 0, answers[i]);
    }

    void ask_clearances(int y, std::span<const int> columns) const {
        std::optional<mobb::NearestPair> near;
        for (const int x : columns) {
            const mobb::PlacedClip b(least_b_->clip(), placement(x, y));
            // What is nearest in one cell is nearly so in the next.
            near = mobb::least_clearance(a_.placed_clip(), *least_a_, b, *least_b_, near);
            const double value = near ? near->clearance : std::numeric_limits<double>::infinity();
            set(x, y, value, value < 0);
        }
    }

    void ask_tests(int y, std::span<const int> columns) const {
        SceneQuery query = query_;
        for (const int x : columns) {
            query.b.placement = placement(x, y);
            mobb::Statistics statistics;
            const bool hit = mobbscope::ask(fitted_, query, map_.order.search, statistics).has_value();
            set(x, y, static_cast<double>(tests_of(statistics)), hit);
        }
    }

    const FittedScene& fitted_;
    const SceneQuery& query_;
    PlacementMap& map_;
    mobb::PlacedTree a_;
    std::shared_ptr<const mobb::Blocks> blocks_a_, blocks_b_;
    std::unique_ptr<const mobb::ClipDisks> least_a_, least_b_;
};

/// The line between cells that collide and cells that do not: through the middles of neighbours it is led by where
/// answers change between the two.
class Boundary {
  public:
    explicit Boundary(const PlacementMap& map) : map_(map) {
        const MapOrder& order = map.order;
        for (std::vector<std::size_t>* at : {&to_right_, &upwards_}) at->resize(map.hits.size(), kNone);
        for (int y = 0; y < order.height; y += map.step) {
            for (int x = 0; x < order.width; x += map.step) {
                if (x + map.step < order.width) add(to_right_, {x, y}, {x + map.step, y});
                if (y + map.step < order.height) add(upwards_, {x, y}, {x, y + map.step});
            }
        }
    }

    void refine(const MapRows& rows) {
        std::vector<glm::dvec2> middles(ends_.size());
        for (int halving = 0; halving < kHalvings; ++halving) {
            std::ranges::transform(ends_, middles.begin(), middle_of);
            const std::unique_ptr<bool[]> answers = rows.collide(middles);
            for (std::size_t i = 0; i < ends_.size(); ++i) (answers[i] ? ends_[i].hit : ends_[i].free) = middles[i];
        }
    }

    /// Squares between the middles of four cells, each with the line through it.
    std::vector<MapLine> lines() const {
        std::vector<MapLine> out;
        const int step = map_.step;
        for (int y = 0; y + step < map_.order.height; y += step) {
            for (int x = 0; x + step < map_.order.width; x += step) {
                std::array<glm::dvec2, 4> crossings;
                std::size_t count = 0;
                for (const std::size_t at : {to_right_[map_.known(x, y)], upwards_[map_.known(x + step, y)],
                                             to_right_[map_.known(x, y + step)], upwards_[map_.known(x, y)]}) {
                    if (at != kNone) crossings[count++] = middle_of(ends_[at]);
                }
                for (std::size_t i = 0; i + 1 < count; i += 2) out.push_back({crossings[i], crossings[i + 1]});
            }
        }
        return out;
    }

  private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    static constexpr int kHalvings = 5;

    /// Two offsets, of which one collides.
    struct Ends {
        glm::dvec2 hit, free;
    };
    static glm::dvec2 middle_of(const Ends& ends) { return (ends.hit + ends.free) / 2.0; }

    void add(std::vector<std::size_t>& at, glm::ivec2 from, glm::ivec2 to) {
        const bool from_hit = map_.hit(from.x, from.y);
        if (from_hit == map_.hit(to.x, to.y)) return;
        at[map_.known(from.x, from.y)] = ends_.size();
        const glm::dvec2 p = map_.order.middle(from.x, from.y), q = map_.order.middle(to.x, to.y);
        ends_.push_back(from_hit ? Ends{p, q} : Ends{q, p});
    }

    const PlacementMap& map_;
    std::vector<std::size_t> to_right_, upwards_;  ///< by cell: of the crossing to its neighbour
    std::vector<Ends> ends_;
};

/// What an axis is from and to so that B can meet A.
std::pair<double, double> meeting_range(const mobb::PlacedClip& a, const mobb::PlacedClip& b, MapAxis axis) {
    if (axis == MapAxis::dheading) return {-180, 180};
    if (axis == MapAxis::dstart) return {a.time(0) - b.time(b.count()), a.time(a.count()) - b.time(0)};
    const auto extent = [axis](const mobb::PlacedClip& clip) {
        std::pair<double, double> out{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
        for (int i = 0; i < clip.count(); ++i) {
            const mobb::Disk disk = clip.disk(i);
            const double at = axis == MapAxis::dx ? disk.x : disk.y;
            out = {std::min(out.first, at - disk.r), std::max(out.second, at + disk.r)};
        }
        return out;
    };
    const auto [from_a, to_a] = extent(a);
    const auto [from_b, to_b] = extent(b);
    return {from_a - to_b, to_a - from_b};
}

}  // namespace

std::string_view name(MapAxis axis) { return kAxisNames[static_cast<std::size_t>(axis)]; }
std::optional<MapAxis> map_axis_from_name(std::string_view name) { return enumerator_named<MapAxis>(kAxisNames, name); }
std::span<const std::string_view> map_axis_names() { return kAxisNames; }
std::string_view axis_unit(MapAxis axis) { return kUnits[static_cast<std::size_t>(axis)]; }

std::string_view name(MapShow show) { return kShowNames[static_cast<std::size_t>(show)]; }
std::optional<MapShow> map_show_from_name(std::string_view name) { return enumerator_named<MapShow>(kShowNames, name); }
std::span<const std::string_view> map_show_names() { return kShowNames; }

void check(const MapOrder& order) {
    if (order.across.axis == order.up.axis)
        throw std::invalid_argument("both axes are " + std::string(name(order.up.axis)) + "; give two different ones");
    for (const MapRange& range : {order.across, order.up}) {
        // Written so that NaN fails it.
        if (std::isfinite(range.from) && std::isfinite(range.to) && range.from < range.to) continue;
        const std::string axis(name(range.axis));
        std::string message = axis;
        message.append(" must go from a finite number up to a larger one, as ").append(axis).append("=-5:5");
        throw std::invalid_argument(message);
    }
    for (const int cells : {order.width, order.height}) {
        if (cells < 1 || cells > kMostMapCells)
            throw std::invalid_argument("a map has 1 to " + std::to_string(kMostMapCells) + " cells along a side");
    }
}

void check(const MapOrder& order, const mobb::Placement& b, const mobb::Clip& clip) {
    check(order);
    for (const double x : {order.across.from, order.across.to}) {
        for (const double y : {order.up.from, order.up.to}) {
            if (!mobb::is_valid(moved(b, order, {x, y}), clip.most_start()))
                throw std::invalid_argument("B would stand where none may, beyond " + brief(mobb::kMaxLength) + " m, " +
                                            brief(mobb::kMaxDegrees) + " degrees or " + brief(clip.most_start()) +
                                            " s; give smaller ranges");
        }
    }
}

mobb::Placement moved(const mobb::Placement& b, const MapOrder& order, glm::dvec2 by) {
    mobb::Placement out = b;
    set_along(out, order.across.axis, along(out, order.across.axis) + by.x);
    set_along(out, order.up.axis, along(out, order.up.axis) + by.y);
    return out;
}

mobb::Placement placed_at(const mobb::Placement& b, const MapOrder& order, glm::dvec2 at) {
    mobb::Placement out = b;
    set_along(out, order.across.axis, at.x);
    set_along(out, order.up.axis, at.y);
    return out;
}

glm::dvec2 offset_between(const mobb::Placement& from, const mobb::Placement& to, const MapOrder& order) {
    const auto between = [&](MapAxis axis) {
        const double by = along(to, axis) - along(from, axis);
        return axis == MapAxis::dheading ? std::remainder(by, 360) : by;
    };
    return {between(order.across.axis), between(order.up.axis)};
}

std::string axis_words(MapAxis axis, const std::string& b) {
    switch (axis) {
        case MapAxis::dx:
            return b + " moved along x, m";
        case MapAxis::dy:
            return b + " moved along y, m";
        case MapAxis::dheading:
            return b + " turned by, degrees";
        case MapAxis::dstart:
            break;
    }
    return b + " starts later by, s";
}

std::string map_words(const PlacementMap& map, const std::string& a, const std::string& b) {
    const std::size_t hits = map.hit_count();
    const double percent = 100 * static_cast<double>(hits) / static_cast<double>(map.hits.size());
    // Few are not none, and nearly all are not all.
    const std::string share = hits > 0 && percent < 0.1                  ? "under 0.1"
                              : hits < map.hits.size() && percent > 99.9 ? "over 99.9"
                                                                         : figure(percent, percent < 10 ? 2 : 3);
    const auto is_of = [&](MapAxis axis) { return map.order.across.axis == axis || map.order.up.axis == axis; };
    std::string how;
    if (is_of(MapAxis::dx) || is_of(MapAxis::dy)) how += " moved";
    if (is_of(MapAxis::dheading)) how += how.empty() ? " turned" : " and turned";
    if (is_of(MapAxis::dstart)) how += how.empty() ? " shifted in time" : " and shifted in time";
    return b + how + ", " + a + " stays: " + share + " % of " + grouped(map.hits.size()) + " placements collide";
}

PlacedAnswer answer_at(const FittedScene& fitted, const SceneQuery& query, MapShow show, Search search) {
    const mobb::PlacedTree a = fitted.placed(query.a), b = fitted.placed(query.b);
    if (show == MapShow::clearance) {
        const mobb::ClipDisks disks_a(a.tree().clip()), disks_b(b.tree().clip());
        const auto near = mobb::least_clearance(a.placed_clip(), disks_a, b.placed_clip(), disks_b);
        const double value = near ? near->clearance : std::numeric_limits<double>::infinity();
        return {value < 0, value};
    }
    mobb::Statistics statistics;
    const bool hit = ask(fitted, query, search, statistics).has_value();
    if (show == MapShow::answer) return {hit, hit ? 1.0 : 0.0};
    return {hit, static_cast<double>(tests_of(statistics))};
}

std::string placed_words(MapShow show, const PlacedAnswer& answer) {
    const std::string words = answer.hit ? "they collide" : "they never collide";
    switch (show) {
        case MapShow::answer:
            break;
        case MapShow::clearance:
            if (std::isinf(answer.value)) return "they share no time";
            return words + (answer.hit ? ", overlapping by " : ", at least ") + with_unit(std::abs(answer.value), "m") +
                   (answer.hit ? "" : " apart");
        case MapShow::tests:
            return words + ": " + counted(static_cast<std::int64_t>(answer.value), "test", "tests");
    }
    return words;
}

std::string offset_words(const MapOrder& order, glm::dvec2 offset) {
    const auto one = [](MapAxis axis, double by) {
        const std::string unit(axis_unit(axis));
        return std::string(name(axis)) + ' ' + formatted(axis == MapAxis::dheading ? "%+.1f" : "%+.2f", by) +
               (axis == MapAxis::dheading ? unit : ' ' + unit);
    };
    return one(order.across.axis, offset.x) + ", " + one(order.up.axis, offset.y);
}

std::size_t PlacementMap::hit_count() const {
    return static_cast<std::size_t>(std::ranges::count(hits, std::uint8_t{1}));
}

std::optional<glm::ivec2> PlacementMap::cell_at(glm::dvec2 offset) const {
    const double x = (offset.x - order.across.from) / (order.across.to - order.across.from) * order.width;
    const double y = (offset.y - order.up.from) / (order.up.to - order.up.from) * order.height;
    if (!(x >= 0 && x < order.width && y >= 0 && y < order.height)) return std::nullopt;
    return glm::ivec2(static_cast<int>(x), static_cast<int>(y));
}

PlacementMap map_placements(const FittedScene& fitted, const SceneQuery& query, const MapOrder& order,
                            const MapPass& pass, const Progress& progress) {
    check(order, query.b.placement, fitted.tree(query.b).clip());
    PlacementMap map{order, query.b.placement};
    const auto cells = static_cast<std::size_t>(order.width) * static_cast<std::size_t>(order.height);
    map.values.resize(cells);
    map.hits.resize(cells);
    const MapRows rows(fitted, query, map);
    limit_worker_threads();
    std::mutex telling;
    std::size_t done = 0;
    for (int step = kCoarsest; step > 0; step /= 2) {
        std::vector<int> every, between;  // columns of rows of which none is known yet, and of the others
        for (int x = 0; x < order.width; x += step) {
            every.push_back(x);
            if (x % (2 * step) != 0) between.push_back(x);
        }
        tbb::parallel_for(0, (order.height + step - 1) / step, [&](int row) {
            const int y = row * step;
            const std::vector<int>& columns = step == kCoarsest || y % (2 * step) != 0 ? every : between;
            rows.ask(y, columns);
            if (!progress) return;
            const std::scoped_lock lock(telling);
            progress(done += columns.size(), cells);
        });
        map.step = step;
        Boundary boundary(map);
        if (step == 1) boundary.refine(rows);
        map.boundary = boundary.lines();
        if (pass) pass(map);
    }
    return map;
}

void choose_ranges(const mobb::PlacedClip& a, const mobb::PlacedClip& b, MapOrder& order) {
    constexpr double kRoom = 0.08;  // on either side
    for (MapRange* range : {&order.across, &order.up}) {
        const auto [from, to] = meeting_range(a, b, range->axis);
        const double room = range->axis == MapAxis::dheading ? 0 : std::max(kRoom * (to - from), 1e-3);
        range->from = from - room;
        range->to = to + room;
    }
    const auto is_length = [](const MapRange& range) { return range.axis == MapAxis::dx || range.axis == MapAxis::dy; };
    if (!is_length(order.across) || !is_length(order.up)) return;
    const double half = std::max(order.across.to - order.across.from, order.up.to - order.up.from) / 2;
    for (MapRange* range : {&order.across, &order.up}) {
        const double middle = (range->from + range->to) / 2;
        range->from = middle - half;
        range->to = middle + half;
    }
}

}  // namespace mobbscope
