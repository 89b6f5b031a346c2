/// What the program uses of oneTBB, by plain threads: Debian's library is not built for the thread sanitizer, which
/// would see none of what it waits for, and report races that are none. Any call runs on several threads at once,
/// however small it is, so that all that can race does.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb {

template <class Index>
class blocked_range {
  public:
    blocked_range(Index begin, Index end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
    Index begin() const { return begin_; }
    Index end() const { return end_; }
    std::size_t grainsize() const { return grain_; }

  private:
    Index begin_, end_;
    std::size_t grain_;
};

namespace by_threads {

inline constexpr std::size_t kThreads = 4;

/// Calls work(piece) for each of `pieces` pieces, each on one of the threads; the first exception passes through.
template <class Work>
void each_piece(std::size_t pieces, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr thrown;
    std::mutex mutex;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < std::min(pieces, kThreads); ++i) {
        threads.emplace_back([&] {
            for (std::size_t piece = next++; piece < pieces; piece = next++) {
                try {
                    work(piece);
                } catch (...) {
                    const std::lock_guard lock(mutex);
                    if (!thrown) thrown = std::current_exception();
                }
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    if (thrown) std::rethrow_exception(thrown);
}

template <class Index>
std::size_t pieces_of(const blocked_range<Index>& range) {
    const auto count = static_cast<std::size_t>(range.end() - range.begin());
    return std::min((count + range.grainsize() - 1) / range.grainsize(), 4 * kThreads);
}

template <class Index>
blocked_range<Index> piece_of(const blocked_range<Index>& range, std::size_t piece, std::size_t pieces) {
    const auto count = static_cast<std::size_t>(range.end() - range.begin());
    const auto at = [&](std::size_t i) { return range.begin() + static_cast<Index>(count * i / pieces); };
    return {at(piece), at(piece + 1), range.grainsize()};
}

}  // namespace by_threads

template <class Index, class Body>
void parallel_for(const blocked_range<Index>& range, const Body& body) {
    const std::size_t pieces = by_threads::pieces_of(range);
    by_threads::each_piece(pieces, [&](std::size_t i) { body(by_threads::piece_of(range, i, pieces)); });
}

template <class Index, class Body>
void parallel_for(Index begin, Index end, const Body& body) {
    parallel_for(blocked_range<Index>(begin, std::max(begin, end)), [&](const blocked_range<Index>& range) {
        for (Index i = range.begin(); i != range.end(); ++i) body(i);
    });
}

template <class Index, class Value, class Body, class Join>
Value parallel_reduce(const blocked_range<Index>& range, const Value& identity, const Body& body, const Join& join) {
    const std::size_t pieces = by_threads::pieces_of(range);
    std::vector<Value> parts(pieces, identity);
    by_threads::each_piece(pieces,
                           [&](std::size_t i) { parts[i] = body(by_threads::piece_of(range, i, pieces), identity); });
    Value out = identity;
    for (const Value& part : parts) out = join(out, part);
    return out;
}

class task_arena {
  public:
    static constexpr int automatic = -1;
    explicit task_arena(int = automatic) {}
    template <class Work>
    auto execute(const Work& work) {
        return work();
    }
};

}  // namespace tbb
