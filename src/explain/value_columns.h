/// Curves in columns of pixels: what a column of a chart covers where more happens in it than pixels can show.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace mobbscope {

/// What one pixel column of a chart shows: the range of values in it.
struct ValueColumn {
    double least = 0;
    double most = 0;
    bool any = false;  ///< false: there is no value in its time

    void add(double low, double high) {
        least = any ? std::min(least, low) : low;
        most = any ? std::max(most, high) : high;
        any = true;
    }
};

/// [t0, t1) in columns of equal width; no extreme is lost, however narrow a piece is.
class ValueColumns {
  public:
    /// t1 > t0, columns >= 1.
    ValueColumns(double t0, double t1, int columns)
        : t0_(t0), t1_(t1), per_second_(columns / (t1 - t0)), columns_(static_cast<std::size_t>(columns)) {}

    /// A piece of a curve. `range_within(from, to)`: its least and its most value between two times in it.
    template <class RangeWithin>
    void add(double from, double to, const RangeWithin& range_within) {
        if (to <= t0_ || from >= t1_) return;
        const std::size_t first = column(std::floor((from - t0_) * per_second_));
        // A piece that ends where a column begins is not in it, but is always in some column.
        const std::size_t last = std::max(first, column(std::ceil((to - t0_) * per_second_) - 1));
        for (std::size_t i = first; i <= last; ++i) {
            const std::pair<double, double> range =
                range_within(i == first ? from : border(i), i == last ? to : border(i + 1));
            columns_[i].add(range.first, range.second);
        }
    }

    std::vector<ValueColumn> take() && { return std::move(columns_); }

  private:
    std::size_t column(double position) const {
        return static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(columns_.size() - 1)));
    }
    double border(std::size_t column) const { return t0_ + static_cast<double>(column) / per_second_; }

    double t0_, t1_, per_second_;
    std::vector<ValueColumn> columns_;
};

}  // namespace mobbscope
