#include <scene/scene_delta.h>

#include <algorithm>
#include <iterator>

namespace mobbscope {

namespace {

Scene without_lists(Scene scene) {
    scene.clips = {};
    scene.agents = {};
    scene.queries = {};
    return scene;
}

}  // namespace

template <class Item>
SceneDelta::ListDelta<Item>::ListDelta(const std::vector<Item>& list, const std::vector<Item>& base) {
    const auto [list_differs, base_differs] = std::mismatch(list.begin(), list.end(), base.begin(), base.end());
    const auto [list_ends, base_ends] = std::mismatch(list.rbegin(), std::make_reverse_iterator(list_differs),
                                                      base.rbegin(), std::make_reverse_iterator(base_differs));
    head = static_cast<std::size_t>(list_differs - list.begin());
    tail = static_cast<std::size_t>(list_ends - list.rbegin());
    middle.assign(list_differs, list_ends.base());
}

template <class Item>
std::vector<Item> SceneDelta::ListDelta<Item>::applied(const std::vector<Item>& base) const {
    std::vector<Item> out;
    out.reserve(head + middle.size() + tail);
    out.insert(out.end(), base.begin(), base.begin() + static_cast<std::ptrdiff_t>(head));
    out.insert(out.end(), middle.begin(), middle.end());
    out.insert(out.end(), base.end() - static_cast<std::ptrdiff_t>(tail), base.end());
    return out;
}

SceneDelta::SceneDelta(const Scene& scene, const Scene& base)
    : clips_(scene.clips, base.clips),
      agents_(scene.agents, base.agents),
      queries_(scene.queries, base.queries),
      rest_(without_lists(scene)) {}

Scene SceneDelta::applied(const Scene& base) const {
    Scene out = rest_;
    out.clips = clips_.applied(base.clips);
    out.agents = agents_.applied(base.agents);
    out.queries = queries_.applied(base.queries);
    return out;
}

std::size_t SceneDelta::bytes() const {
    return sizeof(*this) + clips_.middle.capacity() * sizeof(SceneClip) + agents_.middle.capacity() * sizeof(Agent) +
           queries_.middle.capacity() * sizeof(SceneQuery);
}

}  // namespace mobbscope
