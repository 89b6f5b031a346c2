#include <mobb/lanes.h>
#include <mobb/sample_pairs.h>

namespace mobb {

namespace {

/// Whether a disk of B, in A's frame and widened by the slack, is near one of A; of doubles or of two at once.
template <class T>
auto is_near(T a_x, T a_y, T a_r, T b_x, T b_y, T b_r) {
    const T dx = a_x - b_x;
    const T dy = a_y - b_y;
    const T reach = a_r + b_r;
    return dx * dx + dy * dy < reach * reach;
}

template <int partners>
int count_apart_of(const Disk* a, const Disk* b, int count, const StoredRelation& relation) {
    const auto [c, s] = relation.rotation;
    const glm::dvec2 t = relation.translate;
    int k = 0;
    for (; k + 2 <= count; k += 2) {
        const TwoDoubles stored_x{b[k].x, b[k + 1].x}, stored_y{b[k].y, b[k + 1].y};
        const TwoDoubles x = c * stored_x - s * stored_y + t.x;
        const TwoDoubles y = s * stored_x + c * stored_y + t.y;
        const TwoDoubles r = TwoDoubles{b[k].r, b[k + 1].r} + relation.slack;
        const auto nears = [&](const Disk* p) {
            return is_near(TwoDoubles{p[0].x, p[1].x}, TwoDoubles{p[0].y, p[1].y}, TwoDoubles{p[0].r, p[1].r}, x, y, r);
        };
        TwoMasks near = nears(a + k);
        if constexpr (partners == 2) near |= nears(a + k + 1);
        if (any(near)) return near[0] ? k : k + 1;
    }
    if (k < count) {
        const Disk d = placed(b[k], relation.rotation, t);
        const double r = d.r + relation.slack;
        bool any = is_near(a[k].x, a[k].y, a[k].r, d.x, d.y, r);
        if constexpr (partners == 2) any |= is_near(a[k + 1].x, a[k + 1].y, a[k + 1].r, d.x, d.y, r);
        if (any) return k;
    }
    return count;
}

}  // namespace

int count_apart(const Disk* a, const Disk* b, int count, int partners, const StoredRelation& relation) {
    return partners == 2 ? count_apart_of<2>(a, b, count, relation) : count_apart_of<1>(a, b, count, relation);
}

}  // namespace mobb
