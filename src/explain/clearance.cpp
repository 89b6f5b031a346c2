#include <explain/clearance.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mobbscope {

namespace {

/// Takes down the pairs in the order in which the one loop over pairs of samples visits them.
struct PieceRecorder : mobb::ObserverBase {
    const mobb::PlacedClip& a;
    const mobb::PlacedClip& b;
    Clearance out;

    PieceRecorder(const mobb::PlacedClip& a_, const mobb::PlacedClip& b_) : a(a_), b(b_) {}

    void sample_pair(int i, int j, double squared_distance) {
        const double apart = std::sqrt(squared_distance) - (a.disk(i).r + b.disk(j).r);
        // The predicate decides on squares; a root that rounds may not contradict it.
        out.pieces.push_back(
            {std::max(a.time(i), b.time(j)), std::min(a.time(i + 1), b.time(j + 1)), std::max(apart, 0.0), i, j});
        colliding = std::min(apart, -std::numeric_limits<double>::denorm_min());
    }
    bool operator()(int /*i*/, int /*j*/) {
        out.pieces.back().clearance = colliding;
        if (!out.contact) out.contact = out.pieces.size() - 1;
        return false;
    }

    double colliding = 0;  ///< clearance of the last pair if it collides
};

}  // namespace

Clearance clearance_over_time(const mobb::PlacedClip& a, const mobb::PlacedClip& b) {
    PieceRecorder recorder(a, b);
    mobb::visit_sample_pairs(a, 0, a.count(), b, 0, b.count(), recorder, recorder);
    Clearance& out = recorder.out;
    const auto least =
        std::min_element(out.pieces.begin(), out.pieces.end(),
                         [](const ClearancePiece& p, const ClearancePiece& q) { return p.clearance < q.clearance; });
    if (least != out.pieces.end()) out.least = static_cast<std::size_t>(least - out.pieces.begin());
    return std::move(out);
}

std::vector<ClearanceColumn> columns_of(const Clearance& clearance, double t0, double t1, int columns) {
    std::vector<ClearanceColumn> out(static_cast<std::size_t>(columns));
    const double per_second = columns / (t1 - t0);
    for (const ClearancePiece& piece : clearance.pieces) {
        if (piece.t1 <= t0 || piece.t0 >= t1) continue;
        const auto column = [&](double position) {
            return static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(columns - 1)));
        };
        const std::size_t first = column(std::floor((piece.t0 - t0) * per_second));
        // A piece that ends where a column begins is not in it, but is always in some column.
        const std::size_t last = std::max(first, column(std::ceil((piece.t1 - t0) * per_second) - 1));
        for (std::size_t i = first; i <= last; ++i) {
            ClearanceColumn& at = out[i];
            at.least = at.any ? std::min(at.least, piece.clearance) : piece.clearance;
            at.most = at.any ? std::max(at.most, piece.clearance) : piece.clearance;
            at.any = true;
        }
    }
    return out;
}

}  // namespace mobbscope
