/// A scene said by what differs from another one: a history keeps many scenes that are nearly equal.
#pragma once

#include <scene/scene.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

class SceneDelta {
  public:
    /// What `scene` has and `base` has not.
    SceneDelta(const Scene& scene, const Scene& base);

    /// The scene again. `base` is the one that this was made with, or an equal one.
    Scene applied(const Scene& base) const;

    /// Memory that it takes, roughly; of clips and traces, which scenes share, only their places in the lists.
    std::size_t bytes() const;

  private:
    /// A list that begins and ends as the base's does.
    template <class Item>
    struct ListDelta {
        ListDelta(const std::vector<Item>& list, const std::vector<Item>& base);
        std::vector<Item> applied(const std::vector<Item>& base) const;

        std::size_t head = 0, tail = 0;  ///< items that both share
        std::vector<Item> middle;
    };
    ListDelta<SceneClip> clips_;
    ListDelta<Agent> agents_;
    ListDelta<SceneQuery> queries_;
    Scene rest_;  ///< all but the lists
};

}  // namespace mobbscope
