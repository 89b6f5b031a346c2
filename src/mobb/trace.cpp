#include <mobb/trace.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mobb {

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
    axis_.push_back(event.axis);
    gap_.push_back(event.gap);
    pool_.insert(pool_.end(), event.pairs.begin(), event.pairs.end());
    pairs_end_.push_back(pool_.size());
}

TestCounts Trace::counts() const {
    TestCounts counts;
    for (const TestKind test : test_) ++counts[test];
    counts[TestKind::samples] = static_cast<std::int64_t>(pool_.size());
    return counts;
}

void TraceRecorder::enter(int a, int b) {
    const int caller = open_.empty() ? -1 : open_.back().last;
    open_.push_back({a, b, caller, caller});
}

void TraceRecorder::time_test(bool overlap) {
    push(TestKind::time, overlap ? Outcome::overlap : Outcome::disjoint_in_time);
}

void TraceRecorder::box_test(BoxKind test, const Separation& separation) {
    push(test, separation.separated() ? Outcome::separated : Outcome::overlap, separation);
}

void TraceRecorder::sample_pair(int i, int j, double squared_distance) {
    pairs_.push_back({i, j, std::sqrt(squared_distance)});
}

void TraceRecorder::sample_test(bool hit) {
    push(TestKind::samples, hit ? Outcome::hit : Outcome::no_hit);
    pairs_.clear();
}

void TraceRecorder::push(TestKind test, Outcome outcome, const Separation& separation) {
    OpenPair& open = open_.back();
    trace_.push({open.parent, static_cast<int>(open_.size()) - 1, open.a, open.b, test, outcome, separation.axis,
                 separation.gap,
                 test == TestKind::samples ? std::span<const MeasuredPair>(pairs_) : std::span<const MeasuredPair>()});
    open.last = trace_.size() - 1;
}

}  // namespace mobb
