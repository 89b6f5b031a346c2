/// Seeded random chains of the clips of random_motion.h.
#pragma once

#include <mobb/chain.h>
#include <mobb/fit.h>
#include <mobb/random_motion.h>

#include <glm/vec2.hpp>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mobb::test {

inline ChainPartPtr part_of(ClipPtr clip, const FitOptions& fit) {
    return std::make_shared<const ChainPart>(std::make_shared<const Tree>(std::move(clip), fit));
}

/// One to `most` links of random clips with one dt, under trees of any boxes, or of the kind that is given: each begins
/// where the one before ends, or anywhere.
inline std::vector<ChainLink> random_links(Random& random, int most, double time_scale, int most_samples,
                                           std::optional<TreeKind> kind = {}) {
    const bool linked = random.chance(0.7);
    const glm::dvec2 origin = random.chance(0.1) ? glm::dvec2{1e4, -1e5} : glm::dvec2{0};
    std::vector<ChainPartPtr> parts;
    std::vector<ChainLink> links;
    const int n = random.integer(1, most);
    for (int k = 0; k < n; ++k) {
        if (parts.empty() || random.chance(0.6)) {
            FitOptions fit = random_fit(random);
            fit.time_scale = time_scale;
            if (kind) fit.tree = *kind;
            const double dt = parts.empty() ? 0 : parts.front()->clip().dt();
            parts.push_back(part_of(random_clip(random, most_samples, dt), fit));
        }
        const ChainPartPtr& part =
            parts[static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.size()) - 1))];
        ChainLink link{part, origin + glm::dvec2{random.real(-3, 3), random.real(-3, 3)}, random_angle(random)};
        if (linked && !links.empty()) {
            const ChainLink& before = links.back();
            const Disk end = placed(before.part->clip().samples().back(), Rotation::from_degrees(before.rotate_deg),
                                    before.translate);
            const Disk begin = placed(part->clip().samples().front(), Rotation::from_degrees(link.rotate_deg), {0, 0});
            link.translate = {end.x - begin.x, end.y - begin.y};
        }
        links.push_back(link);
    }
    return links;
}

/// Links of which such a share is linear.
inline std::vector<ChainLink> random_running_links(Random& random, int most, double time_scale, int most_samples,
                                                   std::optional<TreeKind> kind = {}, double linear = 0.5) {
    std::vector<ChainLink> links = random_links(random, most, time_scale, most_samples, kind);
    for (ChainLink& link : links) {
        if (!random.chance(linear)) continue;
        const Clip& held = link.part->clip();
        const auto runs = std::make_shared<const Clip>(
            held.dt(), std::vector(held.samples().begin(), held.samples().end()), Motion::linear);
        link.part = part_of(runs, link.part->tree().options());
    }
    return links;
}

}  // namespace mobb::test
