/// What all peers share: boxes in (x, y, t) around runs of samples, the way from B's frame to A's, and the exact test
/// behind them.
#pragma once

#include "peer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace mobbscope::bench {

/// Metres, metres and seconds. Their libraries count in float, so it is wider by this than what it bounds.
struct SpaceTimeBox {
    static constexpr double kSlack = 1e-4;
    std::array<double, 3> low, high;

    bool meets(const SpaceTimeBox& o) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (low[k] > o.high[k] || o.low[k] > high[k]) return false;
        }
        return true;
    }
};

/// In the clip's own frame and time, around samples [first, end).
inline SpaceTimeBox box_of(const mobb::Clip& clip, int first, int end) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    SpaceTimeBox box{{kFar, kFar, first * clip.dt() - SpaceTimeBox::kSlack},
                     {-kFar, -kFar, end * clip.dt() + SpaceTimeBox::kSlack}};
    for (int i = first; i < end; ++i) {
        const mobb::Disk& d = clip.samples()[static_cast<std::size_t>(i)];
        const double r = d.r + SpaceTimeBox::kSlack;
        box.low[0] = std::min(box.low[0], d.x - r), box.high[0] = std::max(box.high[0], d.x + r);
        box.low[1] = std::min(box.low[1], d.y - r), box.high[1] = std::max(box.high[1], d.y + r);
    }
    return box;
}

/// A clip cut into runs of samples.
struct BoxedClip {
    mobb::ClipPtr clip;
    int samples_a_box;

    int count() const { return (clip->count() + samples_a_box - 1) / samples_a_box; }
    int first(int box) const { return box * samples_a_box; }
    int end(int box) const { return std::min(first(box) + samples_a_box, clip->count()); }
    SpaceTimeBox box(int box) const { return box_of(*clip, first(box), end(box)); }
    SpaceTimeBox whole() const { return box_of(*clip, 0, clip->count()); }
};

inline std::vector<BoxedClip> boxed(const Clips& clips, int samples_a_box) {
    std::vector<BoxedClip> out;
    for (const mobb::ClipPtr& clip : clips) out.push_back({clip, samples_a_box});
    return out;
}

/// Two placed clips, and B as A's frame has it: rotated about the time axis and shifted.
struct PeerQuery {
    std::size_t a, b;  ///< clips
    mobb::PlacedClip placed_a, placed_b;
    mobb::Rotation rotation;
    std::array<double, 3> shift;

    PeerQuery(const Clips& clips, const WorkloadQuery& query)
        : a(static_cast<std::size_t>(query.clip_a)),
          b(static_cast<std::size_t>(query.clip_b)),
          placed_a(*clips[a], query.a),
          placed_b(*clips[b], query.b) {
        const mobb::Rotation back = placed_a.rotation().inverse();
        rotation = back * placed_b.rotation();
        const glm::dvec2 d = back(query.b.translate - query.a.translate);
        shift = {d.x, d.y, query.b.start - query.a.start};
    }

    /// A box of B's, in A's frame.
    SpaceTimeBox in_a(const SpaceTimeBox& box) const {
        const double c = std::abs(rotation.c), s = std::abs(rotation.s);
        const double hx = (box.high[0] - box.low[0]) / 2, hy = (box.high[1] - box.low[1]) / 2;
        const glm::dvec2 middle = rotation({(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2});
        const double x = middle.x + shift[0], y = middle.y + shift[1];
        return {{x - c * hx - s * hy, y - s * hx - c * hy, box.low[2] + shift[2]},
                {x + c * hx + s * hy, y + s * hx + c * hy, box.high[2] + shift[2]}};
    }

    /// The samples of two runs, by the predicate that all of this library shares.
    bool collide(const BoxedClip& boxes_a, int box_a, const BoxedClip& boxes_b, int box_b) const {
        mobb::NoObserver nobody;
        auto stop = [](int, int) { return true; };
        return mobb::visit_sample_pairs(placed_a, boxes_a.first(box_a), boxes_a.end(box_a), placed_b,
                                        boxes_b.first(box_b), boxes_b.end(box_b), nobody, stop)
            .hit;
    }
};

inline std::vector<PeerQuery> peer_queries(const Clips& clips, std::span<const WorkloadQuery> queries) {
    std::vector<PeerQuery> out;
    out.reserve(queries.size());
    for (const WorkloadQuery& query : queries) out.emplace_back(clips, query);
    return out;
}

}  // namespace mobbscope::bench
