#include <base/text.h>
#include <explain/clearance.h>
#include <explain/event_values.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

EventValues::Range one(double value) { return {value, value}; }

bool compares(double value, Comparison comparison, double with) {
    switch (comparison) {
        case Comparison::equal:
            return value == with;
        case Comparison::not_equal:
            return value != with && !std::isnan(value);
        case Comparison::less:
            return value < with;
        case Comparison::at_most:
            return value <= with;
        case Comparison::greater:
            return value > with;
        case Comparison::at_least:
            return value >= with;
    }
    return false;
}

/// Whether it holds of any number of the range.
bool compares(EventValues::Range range, Comparison comparison, double with) {
    switch (comparison) {
        case Comparison::equal:
            return range.least <= with && with <= range.most;
        case Comparison::not_equal:
            return with < range.least || with > range.most;
        case Comparison::less:
        case Comparison::at_most:
            return compares(range.least, comparison, with);
        case Comparison::greater:
        case Comparison::at_least:
            return compares(range.most, comparison, with);
    }
    return false;
}

}  // namespace

double EventValues::clearance(int step) const {
    double least = kNone;
    for (const mobb::MeasuredPair& measured : (*trace_)[step].pairs) {
        const mobb::Approach approach =
            mobb::approach_of(sides_[0]->placed_clip(), measured.i, sides_[1]->placed_clip(), measured.j);
        least = std::fmin(least, approach.clearance(approach.nearest()));
    }
    return least;
}

EventValues::Range EventValues::value(EventField field, int side, int step) const {
    const mobb::Trace::Event event = (*trace_)[step];
    const RecursionPair& pair = this->pair(step);
    const int node = side == 0 ? event.a : event.b;
    switch (field) {
        case EventField::step:
            return one(step);
        case EventField::time: {
            const double begin = std::max(pair.time_a.t0, pair.time_b.t0);
            const double end = std::min(pair.time_a.t1, pair.time_b.t1);
            return end > begin ? Range{begin, end} : one(kNone);
        }
        case EventField::shared:
            return one(
                std::max(0.0, std::min(pair.time_a.t1, pair.time_b.t1) - std::max(pair.time_a.t0, pair.time_b.t0)));
        case EventField::depth:
            return one(event.depth);
        case EventField::parent:
            return one(event.parent < 0 ? kNone : event.parent);
        case EventField::node:
            return one(node);
        case EventField::level:
            return one(tree(side).level(node));
        case EventField::sample: {
            const mobb::Node& covers = tree(side).node(node);
            return {static_cast<double>(covers.first), static_cast<double>(covers.first + covers.count - 1)};
        }
        case EventField::leaf:
            return one(tree(side).is_leaf(node) ? 1 : 0);
        case EventField::test:
            return one(static_cast<double>(event.test.index()));
        case EventField::outcome:
            return one(static_cast<double>(event.outcome));
        case EventField::axis:
            return one(event.axis < 0 ? kNone : event.axis);
        case EventField::gap:
            return one(event.outcome == mobb::Outcome::separated ? event.gap : kNone);
        case EventField::clearance:
            return one(event.pairs.empty() ? kNone : clearance(step));
        case EventField::pairs:
            return one(event.test == mobb::TestKind::samples ? static_cast<double>(event.pairs.size()) : kNone);
        case EventField::tests_below:
            return one(pair.end - 1 - pair.last);
        case EventField::hit_below:
            return one(pair.hit ? 1 : 0);
    }
    return one(kNone);
}

std::string EventValues::text(EventField field, int side, int step) const {
    const EventFieldInfo& about = info(field);
    const Range range = value(field, side, step);
    if (std::isnan(range.least)) return "";
    switch (about.kind) {
        case FieldKind::word:
            return std::string(about.values[static_cast<std::size_t>(range.least)]);
        case FieldKind::flag:
            return range.least > 0 ? "yes" : "";
        case FieldKind::node: {
            const int node = this->node(side, step);
            return std::to_string(tree(side).level(node)) + '.' + std::to_string(tree(side).place_in_level(node));
        }
        case FieldKind::number:
        case FieldKind::range:
            break;
    }
    const auto number = [&](double value) {
        return about.unit.empty() ? std::to_string(static_cast<std::int64_t>(value)) : formatted("%.3f", value);
    };
    return range.least == range.most ? number(range.least) : number(range.least) + ".." + number(range.most);
}

bool EventValues::holds(const EventFilter::Term& term, int step) const {
    if (term.level >= 0) {
        const mobb::Tree& of = tree(term.side);
        const int node = this->node(term.side, step);
        const bool is = of.level(node) == term.level && of.place_in_level(node) == static_cast<int>(term.value);
        return is == (term.comparison == Comparison::equal);
    }
    const Range range = value(term.field, term.side, step);
    return info(term.field).kind == FieldKind::range ? compares(range, term.comparison, term.value)
                                                     : compares(range.least, term.comparison, term.value);
}

bool EventValues::passes(const EventFilter& filter, int step) const {
    return filter.passes([&](const EventFilter::Term& term) { return holds(term, step); });
}

std::vector<int> steps_that_pass(const EventValues& values, const EventFilter& filter) {
    std::vector<int> out;
    for (int step = 0; step < values.size(); ++step) {
        if (values.passes(filter, step)) out.push_back(step);
    }
    return out;
}

void sort_steps(std::vector<int>& steps, const EventValues& values, EventField field, int side, bool descending) {
    struct Row {
        double key;
        int step;
    };
    std::vector<Row> rows;
    rows.reserve(steps.size());
    for (const int step : steps) rows.push_back({values.value(field, side, step).least, step});
    std::ranges::stable_sort(rows, [&](const Row& a, const Row& b) {
        if (std::isnan(a.key) || std::isnan(b.key)) return !std::isnan(a.key) && std::isnan(b.key);
        return descending ? a.key > b.key : a.key < b.key;
    });
    std::ranges::transform(rows, steps.begin(), &Row::step);
}

}  // namespace mobbscope
