/// The record of a query: one event per test, in order.
#pragma once

#include <mobb/observer.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace mobb {

enum class Outcome : std::uint8_t { disjoint_in_time, separated, overlap, hit, no_hit };

/// How many axes a box test may try (see Separation); 0 of another test.
int axis_count(TestKind test);

std::string_view name(TestKind test);
std::string_view name(Outcome outcome);
std::optional<TestKind> test_from_name(std::string_view name);
std::optional<Outcome> outcome_from_name(std::string_view name);

/// A pair of samples whose distance was measured.
struct MeasuredPair {
    int i = 0;
    int j = 0;
    double distance = 0;  ///< metres between the centres
};

/// Events as a struct of arrays, with one pool for the measured pairs of all of them: 31 bytes an event, 16 a pair.
class Trace {
  public:
    struct Event {
        int parent = -1;  ///< last event of the pair that called this one; -1 at the root
        int depth = 0;    ///< in node pairs; 0 at the root
        int a = 0;        ///< node indices
        int b = 0;
        TestKind test;
        Outcome outcome = Outcome::overlap;
        int axis = -1;                          ///< of a separation (see Separation); else -1
        double gap = 0;                         ///< of a separation, metres; else 0
        std::span<const MeasuredPair> pairs{};  ///< of a samples test, in order
    };

    int size() const { return static_cast<int>(test_.size()); }
    bool empty() const { return test_.empty(); }
    /// 0 <= step < size(). The event's pairs lie in the trace: they are valid until the next push.
    Event operator[](int step) const&;
    Event operator[](int step) const&& = delete;
    /// The event's `pairs` are copied into the pool. A parent must be an earlier event or -1.
    void push(const Event& event);
    /// What the statistics observer would have counted over the first `events`; it takes the same time for any number.
    TestCounts counts(int events) const;
    TestCounts counts() const { return counts(size()); }
    std::size_t pairs() const { return pool_.size(); }  ///< of all events

    /// How many events there were: more than size() if recording stopped before the end.
    std::int64_t events() const { return size() + left_out_; }
    bool stopped() const { return left_out_ > 0; }
    void leave_out(std::int64_t events = 1) { left_out_ += events; }  ///< further ones that are not recorded

    /// Gives back memory that further events would have taken.
    void shrink_to_fit();
    std::size_t bytes() const;

  private:
    std::vector<int> parent_, depth_, a_, b_;
    std::vector<std::int8_t> axis_;
    std::vector<TestKind> test_;
    std::vector<Outcome> outcome_;
    std::vector<double> gap_;
    std::vector<std::uint32_t> pairs_end_;  ///< end of event i's pairs in the pool; they begin where those of i-1 end
    std::vector<MeasuredPair> pool_;
    std::vector<TestCounts> counted_;  ///< after each kCountedEvents
    std::int64_t left_out_ = 0;
};

/// Where recording stops. A window takes up to 200 bytes an event (docs/performance.md), so these are half a gigabyte.
struct TraceBound {
    int events = 2'000'000;
    std::size_t pairs = 8'000'000;  ///< measured, of all events
};

/// Records a trace while it watches a traversal. Beyond its bound events are only counted.
class TraceRecorder {
  public:
    static constexpr bool watches = true;

    explicit TraceRecorder(const TraceBound& bound = {}) : bound_(bound) {}

    void enter(int a, int b);
    void leave() { open_.pop_back(); }
    void time_test(bool overlap);
    void box_test(BoxKind test, const Separation& separation);
    void sample_pair(int i, int j, double squared_distance);
    void sample_test(bool hit);

    const Trace& trace() const { return trace_; }
    /// Of the whole query.
    const TestCounts& tests() const { return statistics_.tests; }
    /// Hands the trace over and starts a new one; without it, a second query is recorded behind the first.
    Trace take();

  private:
    struct OpenPair {
        int a, b, parent, last;
    };
    void push(TestKind test, Outcome outcome, const Separation& separation = {});

    TraceBound bound_;
    Trace trace_;
    Statistics statistics_;
    std::vector<OpenPair> open_;
    std::vector<MeasuredPair> pairs_;
};

}  // namespace mobb
