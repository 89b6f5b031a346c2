#include <base/random.h>
#include <crowd/simulation/query_sample.h>

#include <algorithm>
#include <unordered_map>

namespace mobbscope {

void QuerySample::offer(std::span<const AskedPair> pairs) {
    for (const AskedPair& pair : pairs) {
        const std::uint64_t number = offered_++;
        if (size_ == 0 || kept_.size() < size_) {
            kept_.push_back({number, pair});
            continue;
        }
        const std::uint64_t place = CounterRandom(seed_, number, 0).next() % offered_;
        if (place < size_) kept_[place] = {number, pair};
    }
}

Scene QuerySample::workload(const Scene& scene) const {
    Scene out;
    out.file = scene.file;
    out.clips = scene.clips;
    out.fit = scene.fit;
    std::unordered_map<const mobb::Clip*, int> index;
    for (std::size_t i = 0; i < scene.clips.size(); ++i) index[scene.clips[i].clip.get()] = static_cast<int>(i);
    const auto participant = [&](const PlayedMove& motion) {
        const int clip = index.at(&motion.tree->clip());
        return PlacedAgent{scene.clips[static_cast<std::size_t>(clip)].name, clip, motion.placement, -1};
    };
    std::vector<Kept> ordered = kept_;
    std::sort(ordered.begin(), ordered.end(), [](const Kept& a, const Kept& b) { return a.number < b.number; });
    out.queries.reserve(ordered.size());
    for (const Kept& kept : ordered) {
        out.queries.push_back({participant(kept.pair.candidate), participant(kept.pair.committed), {}, {}});
    }
    return out;
}

}  // namespace mobbscope
