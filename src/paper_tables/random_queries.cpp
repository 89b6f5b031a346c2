#include <base/random.h>
#include <paper_tables/random_queries.h>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <cstddef>
#include <limits>

namespace mobbscope {

namespace {

/// The middle of the rectangle along x and y that the centres span.
glm::dvec2 middle(const mobb::Clip& clip) {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high = -low;
    for (const mobb::Disk& disk : clip.samples()) {
        low = glm::min(low, {disk.x, disk.y});
        high = glm::max(high, {disk.x, disk.y});
    }
    return (low + high) / 2.0;
}

}  // namespace

std::vector<WorkloadQuery> random_queries(const std::vector<mobb::ClipPtr>& clips, int count, const QueryDraw& draw) {
    std::vector<glm::dvec2> middles;
    for (const mobb::ClipPtr& clip : clips) middles.push_back(middle(*clip));
    Uniform uniform(draw.seed);
    std::vector<WorkloadQuery> queries;
    queries.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        WorkloadQuery query;
        query.clip_a = uniform.below(static_cast<int>(clips.size()));
        query.clip_b = uniform.below(static_cast<int>(clips.size()));
        const auto a = static_cast<std::size_t>(query.clip_a);
        const auto b = static_cast<std::size_t>(query.clip_b);
        const double x = uniform.within(-draw.range, draw.range);
        const double y = uniform.within(-draw.range, draw.range);
        query.b.rotate_deg = uniform.within(0, 360);
        query.b.start = uniform.within(-draw.offset * clips[b]->duration(), draw.offset * clips[a]->duration());
        query.a.translate = -middles[a];
        query.b.translate = glm::dvec2{x, y} - query.b.rotation()(middles[b]);
        queries.push_back(query);
    }
    return queries;
}

}  // namespace mobbscope
