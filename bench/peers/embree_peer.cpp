/// Embree: a scene of user geometry in (x, y, t) for each clip, and rtcCollide. It collides scenes where they lie, so
/// those that move are built anew for each query: B's, in A's frame, by the fast builder for what changes. Before that,
/// boxes around both clips are compared.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <atomic>
#include <memory>
#include <stdexcept>
#include <vector>

#include "boxes.h"
#include "peer.h"

namespace mobbscope::bench {

namespace {

class EmbreePeer : public Peer {
  public:
    EmbreePeer(const Clips& clips, int samples_a_box)
        : clips_(clips), boxed_(boxed(clips, samples_a_box)), device_(rtcNewDevice("threads=1")) {
        if (!device_) throw std::runtime_error("Embree: no device");
        for (const BoxedClip& clip : boxed_) {
            auto scene = std::make_unique<Scene>();
            for (int i = 0; i < clip.count(); ++i) scene->own.push_back(clip.box(i));
            scene->whole = clip.whole();
            scene->boxes = scene->own;
            scene->fixed = make(*scene, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM);
            scene->moved = make(*scene, RTC_SCENE_FLAG_DYNAMIC, RTC_BUILD_QUALITY_LOW);
            scenes_.push_back(std::move(scene));
        }
    }
    EmbreePeer(const EmbreePeer&) = delete;
    EmbreePeer& operator=(const EmbreePeer&) = delete;
    ~EmbreePeer() override {
        for (const auto& scene : scenes_) {
            rtcReleaseScene(scene->fixed);
            rtcReleaseScene(scene->moved);
        }
        rtcReleaseDevice(device_);
    }

    void place(std::span<const WorkloadQuery> queries) override { queries_ = peer_queries(clips_, queries); }

    void ask(std::span<char> answers) override {
        for (std::size_t i = 0; i < queries_.size(); ++i) answers[i] = collide(queries_[i]);
    }

  private:
    struct Scene {
        std::vector<SpaceTimeBox> own, boxes;  ///< in the clip's frame; where they are put next
        SpaceTimeBox whole;
        RTCScene fixed = nullptr, moved = nullptr;
    };
    struct Question {
        const PeerQuery* query;
        const BoxedClip *a, *b;
        std::atomic<bool> hit{false};  ///< Embree may call from threads of its own
    };

    RTCScene make(Scene& scene, RTCSceneFlags flags, RTCBuildQuality quality) {
        RTCScene made = rtcNewScene(device_);
        rtcSetSceneFlags(made, flags);
        rtcSetSceneBuildQuality(made, quality);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.own.size()));
        rtcSetGeometryUserData(geometry, &scene);
        rtcSetGeometryBuildQuality(geometry, quality);
        rtcSetGeometryBoundsFunction(
            geometry,
            [](const RTCBoundsFunctionArguments* arguments) {
                const auto& boxes = static_cast<const Scene*>(arguments->geometryUserPtr)->boxes;
                const SpaceTimeBox& box = boxes[arguments->primID];
                *arguments->bounds_o = {static_cast<float>(box.low[0]),  static_cast<float>(box.low[1]),
                                        static_cast<float>(box.low[2]),  0,
                                        static_cast<float>(box.high[0]), static_cast<float>(box.high[1]),
                                        static_cast<float>(box.high[2]), 0};
            },
            nullptr);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(made, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(made);
        return made;
    }

    bool collide(const PeerQuery& query) {
        Scene &a = *scenes_[query.a], &b = *scenes_[query.b];
        if (!a.whole.meets(query.in_a(b.whole))) return false;
        for (std::size_t i = 0; i < b.own.size(); ++i) b.boxes[i] = query.in_a(b.own[i]);
        rtcCommitGeometry(rtcGetGeometry(b.moved, 0));
        rtcCommitScene(b.moved);
        Question question{&query, &boxed_[query.a], &boxed_[query.b]};
        rtcCollide(
            a.fixed, b.moved,
            [](void* user, RTCCollision* collisions, unsigned count) {
                auto& asked = *static_cast<Question*>(user);
                for (unsigned i = 0; i < count && !asked.hit; ++i) {
                    if (asked.query->collide(*asked.a, static_cast<int>(collisions[i].primID0), *asked.b,
                                             static_cast<int>(collisions[i].primID1))) {
                        asked.hit = true;
                    }
                }
            },
            &question);
        return question.hit;
    }

    Clips clips_;
    std::vector<BoxedClip> boxed_;
    RTCDevice device_;
    std::vector<std::unique_ptr<Scene>> scenes_;
    std::vector<PeerQuery> queries_;
};

}  // namespace

std::unique_ptr<Peer> embree_peer(const Clips& clips, int samples_a_box) {
    return std::make_unique<EmbreePeer>(clips, samples_a_box);
}

}  // namespace mobbscope::bench
