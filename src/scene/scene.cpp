#include <base/text.h>
#include <scene/scene.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <numeric>
#include <unordered_map>

namespace mobbscope {

namespace {

PlacedAgent placed_agent_of(const Scene& scene, std::size_t agent) {
    const Agent& a = scene.agents[agent];
    return {a.name, a.clip, a.placement, static_cast<int>(agent)};
}

}  // namespace

std::optional<Color> color_from_text(std::string_view text) {
    std::uint32_t rgb = 0;
    const char* const end = text.data() + text.size();
    if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, end, rgb, 16).ptr != end) return {};
    return Color{static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 0xff),
                 static_cast<std::uint8_t>(rgb & 0xff)};
}

std::string to_string(const Color& color) { return formatted("#%02X%02X%02X", color.r, color.g, color.b); }

void make_members(SceneClip& clip) {
    clip.members.clear();
    if (clip.body.empty()) return;
    const std::vector<double> headings =
        clip.headings.empty() ? mobb::headings_of(*clip.clip, clip.body) : clip.headings;
    for (const mobb::BodyDisk& disk : clip.body)
        clip.members.push_back(std::make_shared<const mobb::Clip>(mobb::member_of(*clip.clip, headings, disk)));
}

std::string body_words(const SceneClip& clip) {
    return counted(clip.body.size(), "disk", "disks") + " along " +
           (clip.headings.empty() ? "the way it moves" : "its headings");
}

void refuse_bodies(const Scene& scene, const std::string& what) {
    const auto at = std::ranges::find_if(scene.clips, [](const SceneClip& clip) { return !clip.body.empty(); });
    if (at == scene.clips.end()) return;
    throw InputError(scene.file, "clip " + in_quotes(at->name),
                     "it has a body of " + counted(at->body.size(), "disk", "disks") + ", and " + what +
                         " is of single disks; remove the body, or leave the clip out");
}

std::vector<int> numbered_floors(std::span<const std::string> floors) {
    std::unordered_map<std::string_view, int> numbers;
    std::vector<int> out;
    if (std::ranges::all_of(floors, &std::string::empty)) return out;
    for (const std::string& floor : floors) {
        const int next = static_cast<int>(numbers.size()) + 1;
        out.push_back(floor.empty() ? 0 : numbers.try_emplace(floor, next).first->second);
    }
    return out;
}

std::vector<int> floors_of(const Scene& scene) {
    std::vector<std::string> floors;
    for (const Agent& agent : scene.agents) floors.push_back(agent.floor);
    return numbered_floors(floors);
}

AskedPairs::AskedPairs(const Scene& scene)
    : agents_(scene.crowd ? 0 : scene.agents.size()), floors_(scene.crowd ? std::vector<int>() : floors_of(scene)) {
    if (floors_.empty()) return;
    // By floor, of the agents from one on; of floor 0 those of whom nobody says.
    std::vector<std::size_t> from(static_cast<std::size_t>(std::ranges::max(floors_)) + 1, 0);
    before_.assign(agents_ + 1, 0);
    for (std::size_t a = agents_; a-- > 0;) {
        const auto floor = static_cast<std::size_t>(floors_[a]);
        before_[a + 1] = floor == 0 ? agents_ - a - 1 : from[floor] + from[0];
        ++from[floor];
    }
    std::partial_sum(before_.begin(), before_.end(), before_.begin());
}

std::pair<std::size_t, std::size_t> AskedPairs::operator[](std::size_t index) const {
    std::size_t a = 0;
    // Bisection: the last agent with so few pairs before its own.
    for (std::size_t end = agents_; end - a > 1;) {
        const std::size_t middle = a + (end - a) / 2;
        (before(middle) <= index ? a : end) = middle;
    }
    std::size_t left = index - before(a);
    if (floors_.empty()) return {a, a + 1 + left};
    std::size_t b = a + 1;
    while (are_apart(floors_[a], floors_[b]) || left-- > 0) ++b;
    return {a, b};
}

std::optional<std::size_t> AskedPairs::index_of(std::size_t a, std::size_t b) const {
    if (floors_.empty()) return before(a) + (b - a - 1);
    if (are_apart(floors_[a], floors_[b])) return std::nullopt;
    const auto begin = floors_.begin();
    return before(a) + static_cast<std::size_t>(std::count_if(
                           begin + static_cast<std::ptrdiff_t>(a) + 1, begin + static_cast<std::ptrdiff_t>(b),
                           [&](int floor) { return !are_apart(floors_[a], floor); }));
}

std::size_t query_count(const Scene& scene) {
    return scene.queries.empty() ? AskedPairs(scene).size() : scene.queries.size();
}

SceneQuery query_at(const Scene& scene, std::size_t index) {
    return scene.queries.empty() ? query_at(scene, AskedPairs(scene), index) : scene.queries[index];
}

SceneQuery query_at(const Scene& scene, const AskedPairs& pairs, std::size_t index) {
    if (!scene.queries.empty()) return scene.queries[index];
    const auto [a, b] = pairs[index];
    return {placed_agent_of(scene, a), placed_agent_of(scene, b), {}, {}};
}

std::vector<PlacedAgent> placed_agents(const Scene& scene) {
    std::vector<PlacedAgent> out;
    for (std::size_t agent = 0; agent < scene.agents.size(); ++agent) out.push_back(placed_agent_of(scene, agent));
    if (!out.empty()) return out;
    for (int clip = 0; clip < static_cast<int>(scene.clips.size()); ++clip) {
        out.push_back({scene.clips[static_cast<std::size_t>(clip)].name, clip, {}, -1});
    }
    return out;
}

std::vector<PlacedAgent> placed_members(const Scene& scene) {
    std::vector<PlacedAgent> out = placed_agents(scene);
    const auto members = [&](const PlacedAgent& who) -> const std::vector<mobb::ClipPtr>& {
        return scene.clips[static_cast<std::size_t>(who.clip)].members;
    };
    // Of a crowd there may be a million.
    if (std::ranges::all_of(out, [&](const PlacedAgent& who) { return members(who).empty(); })) return out;
    std::vector<PlacedAgent> all;
    for (const PlacedAgent& who : out) {
        const std::vector<PlacedAgent> own = members_of(scene, who);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

std::string disk_words(const PlacedAgent& who) {
    return who.member < 0 ? "" : " (disk " + std::to_string(who.member) + ')';
}

const mobb::ClipPtr& path_of(const Scene& scene, const PlacedAgent& who) {
    const SceneClip& clip = scene.clips[static_cast<std::size_t>(who.clip)];
    return who.member < 0 ? clip.clip : clip.members[static_cast<std::size_t>(who.member)];
}

std::vector<PlacedAgent> members_of(const Scene& scene, const PlacedAgent& who) {
    const std::size_t disks = scene.clips[static_cast<std::size_t>(who.clip)].members.size();
    std::vector<PlacedAgent> out(std::max<std::size_t>(disks, 1), who);
    for (std::size_t i = 0; i < disks; ++i) out[i].member = static_cast<int>(i);
    return out;
}

}  // namespace mobbscope
