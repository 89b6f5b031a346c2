#include <mobb/trace.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mobb {

namespace {
constexpr std::size_t kCountedEvents = 1024;
}

int axis_count(TestKind test) {
    if (!test.is_box()) return 0;
    switch (info(test.box()).axes) {
        case BoxAxes::floor:
            return 4;
        case BoxAxes::space_time:
            return 15;
        case BoxAxes::world:
            return 2;
        case BoxAxes::centers:
            break;
    }
    return 1;
}

Trace::Event Trace::operator[](int step) const& {
    assert(step >= 0 && step < size());
    const auto i = static_cast<std::size_t>(step);
    const std::size_t pairs_begin = i == 0 ? 0 : pairs_end_[i - 1];
    return {parent_[i], depth_[i], a_[i],
            b_[i],      test_[i],  outcome_[i],
            axis_[i],   gap_[i],   std::span(pool_).subspan(pairs_begin, pairs_end_[i] - pairs_begin)};
}

void Trace::push(const Event& event) {
    parent_.push_back(event.parent);
    depth_.push_back(event.depth);
    a_.push_back(event.a);
    b_.push_back(event.b);
    test_.push_back(event.test);
    outcome_.push_back(event.outcome);
    axis_.push_back(static_cast<std::int8_t>(event.axis));
    gap_.push_back(event.gap);
    pool_.insert(pool_.end(), event.pairs.begin(), event.pairs.end());
    pairs_end_.push_back(static_cast<std::uint32_t>(pool_.size()));
    if (test_.size() % kCountedEvents == 0) counted_.push_back(counts());
}

TestCounts Trace::counts(int events) const {
    assert(events >= 0 && events <= size());
    const auto end = static_cast<std::size_t>(events);
    const std::size_t counted = std::min(end / kCountedEvents, counted_.size());
    TestCounts counts;
    if (counted > 0) counts = counted_[counted - 1];
    for (std::size_t i = counted * kCountedEvents; i < end; ++i) ++counts[test_[i]];
    counts[TestKind::samples] = end == 0 ? 0 : static_cast<std::int64_t>(pairs_end_[end - 1]);
    return counts;
}

void Trace::shrink_to_fit() {
    const auto shrink = [](auto&... arrays) { (arrays.shrink_to_fit(), ...); };
    shrink(parent_, depth_, a_, b_, axis_, test_, outcome_, gap_, pairs_end_, pool_, counted_);
}

std::size_t Trace::bytes() const {
    const auto bytes = [](const auto&... arrays) { return ((arrays.capacity() * sizeof(arrays[0])) + ...); };
    return bytes(parent_, depth_, a_, b_, axis_, test_, outcome_, gap_, pairs_end_, pool_, counted_);
}

void TraceRecorder::enter(int a, int b) {
    const int caller = open_.empty() ? -1 : open_.back().last;
    open_.push_back({a, b, caller, caller});
}

void TraceRecorder::time_test(bool overlap) {
    statistics_.time_test(overlap);
    push(TestKind::time, overlap ? Outcome::overlap : Outcome::disjoint_in_time);
}

void TraceRecorder::box_test(BoxKind test, const Separation& separation) {
    statistics_.box_test(test, separation);
    push(test, separation.separated() ? Outcome::separated : Outcome::overlap, separation);
}

void TraceRecorder::sample_pair(int i, int j, double squared_distance) {
    statistics_.sample_pair(i, j, squared_distance);
    // One more than there is room for tells push to stop.
    if (trace_.pairs() + pairs_.size() <= bound_.pairs) pairs_.push_back({i, j, std::sqrt(squared_distance)});
}

void TraceRecorder::sample_test(bool hit) {
    push(TestKind::samples, hit ? Outcome::hit : Outcome::no_hit);
    pairs_.clear();
}

void TraceRecorder::push(TestKind test, Outcome outcome, const Separation& separation) {
    OpenPair& open = open_.back();
    if (trace_.stopped() || trace_.size() == bound_.events || trace_.pairs() + pairs_.size() > bound_.pairs)
        return trace_.leave_out();
    trace_.push({open.parent, static_cast<int>(open_.size()) - 1, open.a, open.b, test, outcome, separation.axis,
                 separation.gap,
                 test == TestKind::samples ? std::span<const MeasuredPair>(pairs_) : std::span<const MeasuredPair>()});
    open.last = trace_.size() - 1;
}

Trace TraceRecorder::take() {
    statistics_ = {};
    // Of a short trace it would take longer than recording it.
    if (trace_.size() >= static_cast<int>(kCountedEvents)) trace_.shrink_to_fit();
    return std::exchange(trace_, {});
}

}  // namespace mobb
