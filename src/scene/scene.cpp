#include <scene/scene.h>

namespace mobbscope {

namespace {

Participant participant_of(const Scene& scene, int agent) {
    const Agent& a = scene.agents[static_cast<std::size_t>(agent)];
    return {a.name, a.clip, a.placement, agent};
}

}  // namespace

std::vector<SceneQuery> effective_queries(const Scene& scene) {
    if (!scene.queries.empty()) return scene.queries;
    std::vector<SceneQuery> pairs;
    const int count = static_cast<int>(scene.agents.size());
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            pairs.push_back({participant_of(scene, a), participant_of(scene, b), {}, {}});
        }
    }
    return pairs;
}

std::vector<Participant> participants(const Scene& scene) {
    std::vector<Participant> out;
    for (int agent = 0; agent < static_cast<int>(scene.agents.size()); ++agent) {
        out.push_back(participant_of(scene, agent));
    }
    if (!out.empty()) return out;
    for (int clip = 0; clip < static_cast<int>(scene.clips.size()); ++clip) {
        out.push_back({scene.clips[static_cast<std::size_t>(clip)].name, clip, {}, -1});
    }
    return out;
}

}  // namespace mobbscope
