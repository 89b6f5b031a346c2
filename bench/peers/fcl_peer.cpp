/// FCL: a BVHModel of oriented boxes in (x, y, t) for each clip, fitted and split by FCL, and FCL's own traversal of
/// two models that are placed. Its primitives are runs of samples; of two, the exact test decides.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/detail/traversal/collision/bvh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/traversal_recurse.h>

#include <memory>
#include <vector>

#include "boxes.h"
#include "peer.h"

namespace mobbscope::bench {

namespace {

using Obb = fcl::OBB<double>;
using Vector = fcl::Vector3<double>;
using Model = fcl::BVHModel<Obb>;

/// Fits a box around all corners of its samples' boxes, where FCL alone would take the points that stand for them.
class CylinderFitter : public fcl::detail::BVFitterBase<Obb> {
  public:
    explicit CylinderFitter(const BoxedClip& clip) : clip_(clip) {}

    void set(Vector*, fcl::Triangle*, fcl::BVHModelType) override {}
    void set(Vector*, Vector*, fcl::Triangle*, fcl::BVHModelType) override {}
    void clear() override {}
    Obb fit(unsigned int* primitives, int count) override {
        corners_.clear();
        for (int k = 0; k < count; ++k) {
            const int box = static_cast<int>(primitives[k]);
            for (int i = clip_.first(box); i < clip_.end(box); ++i) {
                const SpaceTimeBox b = box_of(*clip_.clip, i, i + 1);
                for (const double x : {b.low[0], b.high[0]}) {
                    for (const double y : {b.low[1], b.high[1]}) {
                        for (const double t : {b.low[2], b.high[2]}) corners_.emplace_back(x, y, t);
                    }
                }
            }
        }
        Obb out;
        fcl::fit(corners_.data(), static_cast<int>(corners_.size()), out);
        return out;
    }

  private:
    BoxedClip clip_;
    std::vector<Vector> corners_;
};

class Pairing : public fcl::detail::BVHCollisionTraversalNode<Obb> {
  public:
    Pairing(const PeerQuery& query, const BoxedClip& a, const Model& model_a, const BoxedClip& b, const Model& model_b)
        : query_(query), a_(a), b_(b) {
        model1 = &model_a;
        model2 = &model_b;
        rotation_ << query.rotation.c, -query.rotation.s, 0, query.rotation.s, query.rotation.c, 0, 0, 0, 1;
        shift_ = {query.shift[0], query.shift[1], query.shift[2]};
    }

    bool BVTesting(int i, int j) const override {
        return !fcl::overlap(rotation_, shift_, model1->getBV(i).bv, model2->getBV(j).bv);
    }
    void leafTesting(int i, int j) const override {
        hit_ = hit_ || query_.collide(a_, model1->getBV(i).primitiveId(), b_, model2->getBV(j).primitiveId());
    }
    bool canStop() const override { return hit_; }
    bool hit() const { return hit_; }

  private:
    const PeerQuery& query_;
    const BoxedClip &a_, &b_;
    fcl::Matrix3<double> rotation_;
    Vector shift_;
    mutable bool hit_ = false;
};

class FclPeer : public Peer {
  public:
    FclPeer(const Clips& clips, int samples_a_box) : clips_(clips), boxed_(boxed(clips, samples_a_box)) {
        for (const BoxedClip& clip : boxed_) {
            auto model = std::make_unique<Model>();
            model->bv_fitter = std::make_shared<CylinderFitter>(clip);
            model->beginModel(0, clip.count());
            for (int i = 0; i < clip.count(); ++i) {
                const SpaceTimeBox box = clip.box(i);
                model->addVertex(
                    {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2, (box.low[2] + box.high[2]) / 2});
            }
            model->endModel();
            models_.push_back(std::move(model));
        }
    }

    void place(std::span<const WorkloadQuery> queries) override { queries_ = peer_queries(clips_, queries); }

    void ask(std::span<char> answers) override {
        for (std::size_t i = 0; i < queries_.size(); ++i) {
            const PeerQuery& query = queries_[i];
            Pairing pairing(query, boxed_[query.a], *models_[query.a], boxed_[query.b], *models_[query.b]);
            fcl::detail::collisionRecurse<double>(&pairing, 0, 0, nullptr);
            answers[i] = pairing.hit();
        }
    }

  private:
    Clips clips_;
    std::vector<BoxedClip> boxed_;
    std::vector<std::unique_ptr<Model>> models_;
    std::vector<PeerQuery> queries_;
};

}  // namespace

std::unique_ptr<Peer> fcl_peer(const Clips& clips, int samples_a_box) {
    return std::make_unique<FclPeer>(clips, samples_a_box);
}

}  // namespace mobbscope::bench
