/// Boost.Geometry: an R-tree of boxes in (x, y, t) for each clip, packed. It joins no two trees, so A's is asked for
/// each box of B that comes near A at all.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <memory>
#include <utility>
#include <vector>

#include "boxes.h"
#include "peer.h"

namespace mobbscope::bench {

namespace {

namespace bg = boost::geometry;

class BoostPeer : public Peer {
  public:
    BoostPeer(const Clips& clips, int samples_a_box) : clips_(clips), boxed_(boxed(clips, samples_a_box)) {
        for (const BoxedClip& clip : boxed_) {
            std::vector<Value> values;
            boxes_.emplace_back();
            for (int i = 0; i < clip.count(); ++i) {
                boxes_.back().push_back(clip.box(i));
                values.emplace_back(box(boxes_.back().back()), i);
            }
            trees_.emplace_back(values);
            wholes_.push_back(clip.whole());
        }
    }

    void place(std::span<const WorkloadQuery> queries) override { queries_ = peer_queries(clips_, queries); }

    void ask(std::span<char> answers) override {
        for (std::size_t i = 0; i < queries_.size(); ++i) answers[i] = collide(queries_[i]);
    }

  private:
    using Point = bg::model::point<double, 3, bg::cs::cartesian>;
    using Box = bg::model::box<Point>;
    using Value = std::pair<Box, int>;
    using Tree = bg::index::rtree<Value, bg::index::rstar<16>>;

    static Box box(const SpaceTimeBox& b) {
        return {{b.low[0], b.low[1], b.low[2]}, {b.high[0], b.high[1], b.high[2]}};
    }

    bool collide(const PeerQuery& query) const {
        const SpaceTimeBox& whole = wholes_[query.a];
        if (!whole.meets(query.in_a(wholes_[query.b]))) return false;
        const std::vector<SpaceTimeBox>& boxes = boxes_[query.b];
        for (std::size_t j = 0; j < boxes.size(); ++j) {
            const SpaceTimeBox there = query.in_a(boxes[j]);
            if (!whole.meets(there)) continue;
            const auto near = bg::index::intersects(box(there));
            for (auto it = trees_[query.a].qbegin(near); it != trees_[query.a].qend(); ++it) {
                if (query.collide(boxed_[query.a], it->second, boxed_[query.b], static_cast<int>(j))) return true;
            }
        }
        return false;
    }

    Clips clips_;
    std::vector<BoxedClip> boxed_;
    std::vector<std::vector<SpaceTimeBox>> boxes_;
    std::vector<SpaceTimeBox> wholes_;
    std::vector<Tree> trees_;
    std::vector<PeerQuery> queries_;
};

}  // namespace

std::unique_ptr<Peer> boost_peer(const Clips& clips, int samples_a_box) {
    return std::make_unique<BoostPeer>(clips, samples_a_box);
}

}  // namespace mobbscope::bench
