#include <app/document/clip_groups.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace mobbscope::app {

namespace {

struct GroupKey {
    std::string folder;
    std::size_t rig = 0;
    friend auto operator<=>(const GroupKey&, const GroupKey&) = default;
};

std::string folder_of(const Scene& scene, const SceneClip& clip) {
    if (!clip.source) return "";
    return (scene.file.parent_path() / *clip.source).lexically_normal().parent_path().string();
}

std::string folder_title(const std::string& folder, const Scene& scene) {
    if (folder.empty() && !scene.clips.empty()) return "in the scene";
    const std::string name = std::filesystem::path(folder).filename().string();
    return name.empty() ? folder : name;
}

std::string rig_title(const SceneClip& clip) {
    if (clip.facts.rig == 0) return "no skeleton";
    return clip.facts.root + ", " + std::to_string(clip.facts.joints) + " joints";
}

}  // namespace

std::vector<ClipGroup> clip_groups(const Scene& scene) {
    std::vector<ClipGroup> out;
    std::vector<GroupKey> keys;
    std::map<GroupKey, std::size_t> places;
    std::set<std::string> folders;
    std::set<std::size_t> rigs;
    for (int i = 0; i < static_cast<int>(scene.clips.size()); ++i) {
        const SceneClip& clip = scene.clips[static_cast<std::size_t>(i)];
        const GroupKey key{folder_of(scene, clip), clip.facts.rig};
        folders.insert(key.folder);
        rigs.insert(key.rig);
        const auto [at, is_new] = places.try_emplace(key, out.size());
        if (is_new) {
            out.emplace_back();
            keys.push_back(key);
        }
        out[at->second].clips.push_back(i);
    }
    if (out.size() < 2) return {};
    std::map<std::string, int> known;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const SceneClip& first = scene.clips[static_cast<std::size_t>(out[i].clips.front())];
        std::string& title = out[i].title;
        if (folders.size() > 1) title = folder_title(keys[i].folder, scene);
        if (rigs.size() > 1) title += (title.empty() ? "" : ": ") + rig_title(first);
        // Folders of one name, or rigs with as many joints, are numbered.
        const int count = ++known[title];
        if (count > 1) title += " (" + std::to_string(count) + ")";
    }
    return out;
}

}  // namespace mobbscope::app
