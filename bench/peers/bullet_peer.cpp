/// Bullet: a btDbvt of boxes in (x, y, t) for each clip. Two that are placed are gone through together as Bullet does
/// it for two compound shapes: B's boxes are turned into A's frame when they are looked at.
#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <LinearMath/btAabbUtil2.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "boxes.h"
#include "peer.h"

namespace mobbscope::bench {

namespace {

btVector3 vector_of(const std::array<double, 3>& v) {
    return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

btTransform transform_of(const PeerQuery& query) {
    const auto c = static_cast<btScalar>(query.rotation.c), s = static_cast<btScalar>(query.rotation.s);
    return btTransform(btMatrix3x3(c, -s, 0, s, c, 0, 0, 0, 1), vector_of(query.shift));
}

class BulletPeer : public Peer {
  public:
    BulletPeer(const Clips& clips, int samples_a_box) : clips_(clips), boxed_(boxed(clips, samples_a_box)) {
        for (const BoxedClip& clip : boxed_) {
            auto tree = std::make_unique<btDbvt>();
            for (int i = 0; i < clip.count(); ++i) {
                const SpaceTimeBox box = clip.box(i);
                // NOLINTNEXTLINE: Bullet keeps a pointer or a number with each leaf
                tree->insert(btDbvtVolume::FromMM(vector_of(box.low), vector_of(box.high)),
                             reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
            }
            tree->optimizeTopDown();
            trees_.push_back(std::move(tree));
        }
    }

    void place(std::span<const WorkloadQuery> queries) override { queries_ = peer_queries(clips_, queries); }

    void ask(std::span<char> answers) override {
        for (std::size_t i = 0; i < queries_.size(); ++i) answers[i] = collide(queries_[i]);
    }

  private:
    struct Pair {
        const btDbvtNode *a, *b;
    };

    bool collide(const PeerQuery& query) {
        const btTransform b_to_a = transform_of(query);
        stack_.assign(1, {trees_[query.a]->m_root, trees_[query.b]->m_root});
        while (!stack_.empty()) {
            const Pair pair = stack_.back();
            stack_.pop_back();
            btVector3 low, high;
            btTransformAabb(pair.b->volume.Mins(), pair.b->volume.Maxs(), 0, b_to_a, low, high);
            if (!Intersect(pair.a->volume, btDbvtVolume::FromMM(low, high))) continue;
            if (pair.a->isleaf() && pair.b->isleaf()) {
                if (query.collide(boxed_[query.a], index(pair.a), boxed_[query.b], index(pair.b))) return true;
            } else if (pair.a->isleaf()) {
                for (const btDbvtNode* child : pair.b->childs) stack_.push_back({pair.a, child});
            } else if (pair.b->isleaf()) {
                for (const btDbvtNode* child : pair.a->childs) stack_.push_back({child, pair.b});
            } else {
                for (const btDbvtNode* child_a : pair.a->childs) {
                    for (const btDbvtNode* child_b : pair.b->childs) stack_.push_back({child_a, child_b});
                }
            }
        }
        return false;
    }
    static int index(const btDbvtNode* leaf) { return static_cast<int>(reinterpret_cast<std::intptr_t>(leaf->data)); }

    Clips clips_;
    std::vector<BoxedClip> boxed_;
    std::vector<std::unique_ptr<btDbvt>> trees_;
    std::vector<PeerQuery> queries_;
    std::vector<Pair> stack_;
};

}  // namespace

std::unique_ptr<Peer> bullet_peer(const Clips& clips, int samples_a_box) {
    return std::make_unique<BulletPeer>(clips, samples_a_box);
}

}  // namespace mobbscope::bench
