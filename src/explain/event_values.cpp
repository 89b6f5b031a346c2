#include <base/text.h>
#include <explain/clearance.h>
#include <explain/event_values.h>
#include <explain/table_rows.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

FieldRange one(double value) { return {value, value}; }

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

FieldRange EventValues::value(EventField field, int side, int step) const {
    const mobb::Trace::Event event = (*trace_)[step];
    const RecursionPair& pair = this->pair(step);
    const int node = side == 0 ? event.a : event.b;
    switch (field) {
        case EventField::step:
            return one(step);
        case EventField::time: {
            const double begin = std::max(pair.time_a.t0, pair.time_b.t0);
            const double end = std::min(pair.time_a.t1, pair.time_b.t1);
            return end > begin ? FieldRange{begin, end} : one(kNone);
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
        case EventField::avoidable:
            return one(recursion_->avoidable.at(step) ? 1 : 0);
    }
    return one(kNone);
}

std::string EventValues::text(EventField field, int side, int step, bool exact) const {
    const TableField& about = info(field);
    const FieldRange range = value(field, side, step);
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
        if (about.unit.empty()) return std::to_string(static_cast<std::int64_t>(value));
        if (exact) return format_double(value);
        // Rows of small values differ too.
        return formatted(value != 0 && std::abs(value) < 1e-3 ? "%.3g" : "%.3f", value);
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
    return compares(value(EventFilter::field(term), term.side, step), term.comparison, term.value);
}

bool EventValues::passes(const EventFilter& filter, int step) const {
    return filter.passes([&](const EventFilter::Term& term) { return holds(term, step); });
}

std::vector<bool> passing_steps(const EventValues& values, const EventFilter& filter) {
    std::vector<bool> out(static_cast<std::size_t>(values.size()));
    for (int step = 0; step < values.size(); ++step) out[static_cast<std::size_t>(step)] = values.passes(filter, step);
    return out;
}

std::vector<int> steps_of(const std::vector<bool>& passing) {
    std::vector<int> out;
    for (std::size_t step = 0; step < passing.size(); ++step) {
        if (passing[step]) out.push_back(static_cast<int>(step));
    }
    return out;
}

std::vector<int> steps_that_pass(const EventValues& values, const EventFilter& filter) {
    return steps_of(passing_steps(values, filter));
}

void sort_steps(std::vector<int>& steps, const EventValues& values, EventField field, int side, bool descending) {
    std::vector<double> keys(steps.size());
    std::ranges::transform(steps, keys.begin(), [&](int step) { return values.value(field, side, step).least; });
    sort_rows(steps, keys, descending);
}

}  // namespace mobbscope
