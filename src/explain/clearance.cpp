#include <explain/clearance.h>
#include <mobb/predicate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mobbscope {

namespace {

/// Takes down the pairs in the order in which the one loop over pairs of samples visits them.
struct PieceRecorder : mobb::ObserverBase {
    const mobb::PlacedClip& a;
    const mobb::PlacedClip& b;
    Clearance out;

    PieceRecorder(const mobb::PlacedClip& a_, const mobb::PlacedClip& b_) : a(a_), b(b_) {}

    void sample_pair(int i, int j, double /*squared_distance*/) {
        const mobb::Approach approach = mobb::approach_of(a, i, b, j);
        const double s = approach.nearest();
        const double apart = approach.clearance(s);
        // The predicate decides on squares; a root that rounds may not contradict it.
        out.pieces.push_back({approach, approach.t0, approach.t1, std::max(apart, 0.0), approach.time(s), i, j});
        colliding = std::min(apart, -std::numeric_limits<double>::denorm_min());
    }
    bool operator()(int /*i*/, int /*j*/) {
        ClearancePiece& piece = out.pieces.back();
        piece.clearance = colliding;
        if (out.contact) return false;
        out.contact = out.pieces.size() - 1;
        out.contact_time = piece.approach.time(piece.approach.overlap().begin);
        return false;
    }

    double colliding = 0;  ///< clearance of the last pair if it collides
};

/// The least and the most clearance of a piece from one global time to another.
std::pair<double, double> range_within(const ClearancePiece& piece, double from, double to) {
    // Convex over the piece: least at its least or at the end nearer to that, most at an end.
    const double begin = std::clamp(from, piece.t0, piece.t1);
    const double end = std::clamp(to, begin, piece.t1);
    const double least_at = std::clamp(piece.least_at, begin, end);
    const auto clearance = [&](double t) { return clearance_at(piece, t); };
    return {least_at == piece.least_at ? piece.clearance : clearance(least_at),
            std::max({clearance(begin), clearance(end), piece.clearance})};
}

}  // namespace

double clearance_at(const ClearancePiece& piece, double time) {
    if (piece.approach.is_still()) return piece.clearance;
    const double s = std::clamp((time - piece.t0) / (piece.t1 - piece.t0), 0.0, 1.0);
    return piece.approach.clearance(s);
}

Clearance clearance_over_time(const mobb::PlacedClip& a, const mobb::PlacedClip& b) {
    PieceRecorder recorder(a, b);
    mobb::visit_sample_pairs(a, 0, a.count(), b, 0, b.count(), recorder, recorder);
    Clearance& out = recorder.out;
    const auto least = std::ranges::min_element(out.pieces, {}, &ClearancePiece::clearance);
    if (least != out.pieces.end()) out.least = static_cast<std::size_t>(least - out.pieces.begin());
    return std::move(out);
}

double measured_radii(const mobb::PlacedClip& a, const mobb::PlacedClip& b, int i, int j) {
    const mobb::Approach approach = mobb::approach_of(a, i, b, j);
    return approach.radii(approach.least());
}

double most_overlap(const mobb::PlacedClip& a, const mobb::PlacedClip& b, int i, int j) {
    const mobb::Approach approach = mobb::approach_of(a, i, b, j);
    return -approach.clearance(approach.nearest());
}

std::vector<ValueColumn> columns_of(const Clearance& clearance, double t0, double t1, int columns) {
    ValueColumns out(t0, t1, columns);
    for (const ClearancePiece& piece : clearance.pieces)
        out.add(piece.t0, piece.t1, [&](double from, double to) { return range_within(piece, from, to); });
    return std::move(out).take();
}

}  // namespace mobbscope
