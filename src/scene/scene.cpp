#include <base/text.h>
#include <scene/scene.h>

#include <charconv>

namespace mobbscope {

namespace {

PlacedAgent placed_agent_of(const Scene& scene, std::size_t agent) {
    const Agent& a = scene.agents[agent];
    return {a.name, a.clip, a.placement, static_cast<int>(agent)};
}

/// How many pairs come before those whose first agent is `a`.
std::size_t pairs_before(std::size_t a, std::size_t agents) { return a * (2 * agents - a - 1) / 2; }

}  // namespace

std::optional<Color> color_from_text(std::string_view text) {
    std::uint32_t rgb = 0;
    const char* const end = text.data() + text.size();
    if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, end, rgb, 16).ptr != end) return {};
    return Color{static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 0xff),
                 static_cast<std::uint8_t>(rgb & 0xff)};
}

std::string to_string(const Color& color) { return formatted("#%02X%02X%02X", color.r, color.g, color.b); }

std::size_t query_count(const Scene& scene) {
    if (!scene.queries.empty()) return scene.queries.size();
    const std::size_t agents = scene.crowd ? 0 : scene.agents.size();
    return agents == 0 ? 0 : agents * (agents - 1) / 2;
}

SceneQuery query_at(const Scene& scene, std::size_t index) {
    if (!scene.queries.empty()) return scene.queries[index];
    const std::size_t agents = scene.agents.size();
    std::size_t a = 0;
    // Bisection: the last agent with so few pairs before its own.
    for (std::size_t end = agents; end - a > 1;) {
        const std::size_t middle = a + (end - a) / 2;
        (pairs_before(middle, agents) <= index ? a : end) = middle;
    }
    const std::size_t b = a + 1 + (index - pairs_before(a, agents));
    return {placed_agent_of(scene, a), placed_agent_of(scene, b), {}, {}};
}

std::size_t query_of_pair(const Scene& scene, std::size_t a, std::size_t b) {
    return pairs_before(a, scene.agents.size()) + (b - a - 1);
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

}  // namespace mobbscope
