#include <app/panels/recursion_picture.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace mobbscope::app {

namespace {

/// Puts a pair on the pixels of others.
void merge(PairCell& cell, const Recursion& recursion, int pair) {
    const auto at = [&](int i) { return mark_of(recursion.pairs[static_cast<std::size_t>(i)]); };
    if (at(pair) > at(cell.pair)) cell.pair = pair;
    ++cell.merged;
}

}  // namespace

EventMark mark_of(const RecursionPair& pair) {
    // A pair that went on to others stands for what they found.
    if (pair.has_children() && pair.hit) return EventMark::hit;
    if (pair.avoidable) return EventMark::avoidable;
    return mark_of(mobb::BoxKind::obb2d, pair.outcome);
}

EventMark mark_of(const mobb::Trace& trace, const Recursion& recursion, int event) {
    if (recursion.avoidable.at(event)) return EventMark::avoidable;
    const mobb::Trace::Event found = trace[event];
    return mark_of(found.test, found.outcome);
}

std::vector<StripCell> strip_cells(const mobb::Trace& trace, const Recursion& recursion, const ShownEvents& shown,
                                   int width) {
    const int events = shown.range.size();
    const int count = std::min(events, width);
    std::vector<StripCell> out;
    out.reserve(static_cast<std::size_t>(count));
    for (int c = 0; c < count; ++c) {
        StripCell cell;
        cell.first = shown.range.first + static_cast<int>(static_cast<std::int64_t>(c) * events / count);
        cell.end = shown.range.first + static_cast<int>(static_cast<std::int64_t>(c + 1) * events / count);
        cell.x0 = static_cast<float>(c) * static_cast<float>(width) / static_cast<float>(count);
        cell.x1 = static_cast<float>(c + 1) * static_cast<float>(width) / static_cast<float>(count);
        for (int e = cell.first; e < cell.end; ++e) {
            if (!shown.has(e)) continue;
            ++cell.marks[static_cast<std::size_t>(mark_of(trace, recursion, e))];
        }
        out.push_back(cell);
    }
    return out;
}

std::vector<PairCell> square_cells(const Recursion& recursion, mobb::Interval a, mobb::Interval b, int width,
                                   int height) {
    std::vector<PairCell> out;
    std::unordered_map<std::uint64_t, std::size_t> small;  // by place: cells of one pixel
    const auto pixel = [](double t, mobb::Interval whole, int size) {
        return static_cast<int>(std::lround(std::clamp((t - whole.t0) / (whole.t1 - whole.t0), 0.0, 1.0) * size));
    };
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t i = 0; i < recursion.pairs.size(); ++i) {
            const RecursionPair& pair = recursion.pairs[i];
            if (pair.has_children() != (pass == 0)) continue;
            PairCell cell;
            cell.pair = static_cast<int>(i);
            cell.x0 = std::min(pixel(pair.time_a.t0, a, width), width - 1);
            cell.x1 = std::max(pixel(pair.time_a.t1, a, width), cell.x0 + 1);
            cell.y0 = std::min(height - pixel(pair.time_b.t1, b, height), height - 1);
            cell.y1 = std::max(height - pixel(pair.time_b.t0, b, height), cell.y0 + 1);
            const bool tiny = cell.x1 - cell.x0 <= 2 && cell.y1 - cell.y0 <= 2;
            if (tiny) {
                // What is below two pixels shows only what it found.
                if (pass == 0) continue;
                const auto key = static_cast<std::uint64_t>(cell.x0) << 32 | static_cast<std::uint32_t>(cell.y0);
                const auto [at, is_new] = small.try_emplace(key, out.size());
                if (!is_new) {
                    PairCell& there = out[at->second];
                    there.x1 = std::max(there.x1, cell.x1);
                    there.y1 = std::max(there.y1, cell.y1);
                    merge(there, recursion, cell.pair);
                    continue;
                }
            }
            out.push_back(cell);
        }
    }
    return out;
}

int icicle_row(float height, int depth, float scale, float event_width) {
    constexpr float kLabelled = 14;  // pixels an event at scale 1: a pair has room for its label
    if (event_width >= kLabelled * scale) return static_cast<int>(20 * scale);
    return static_cast<int>(std::clamp(height / static_cast<float>(std::max(1, depth)), 8 * scale, 20 * scale));
}

std::vector<PairCell> icicle_cells(const Recursion& recursion, const ShownEvents& shown, int width, int row) {
    std::vector<PairCell> out;
    std::vector<std::size_t> last(static_cast<std::size_t>(recursion.depth), SIZE_MAX);  // by depth: cell to the left
    const double per_event = static_cast<double>(width) / static_cast<double>(shown.range.size());
    const auto pixel = [&](int event) {
        return static_cast<int>(std::clamp((event - shown.range.first) * per_event, 0.0, static_cast<double>(width)));
    };
    for (std::size_t i = 0; i < recursion.pairs.size(); ++i) {
        const RecursionPair& pair = recursion.pairs[i];
        if (pair.first >= shown.range.end) break;
        if (pair.end <= shown.range.first || !shown.has(pair.last)) continue;
        PairCell cell;
        cell.pair = static_cast<int>(i);
        cell.x0 = std::min(pixel(pair.first), width - 1);
        cell.x1 = std::max(pixel(pair.end), cell.x0 + 1);
        cell.y0 = pair.depth * row;
        cell.y1 = cell.y0 + row;
        std::size_t& left = last[static_cast<std::size_t>(pair.depth)];
        if (left != SIZE_MAX && cell.x0 < out[left].x1) {
            out[left].x1 = std::max(out[left].x1, cell.x1);
            merge(out[left], recursion, cell.pair);
            continue;
        }
        left = out.size();
        out.push_back(cell);
    }
    return out;
}

}  // namespace mobbscope::app
