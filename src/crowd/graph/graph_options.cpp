#include <crowd/graph/graph_options.h>
#include <scene/crowd_run.h>

#include <array>
#include <type_traits>

namespace mobbscope {

namespace {

constexpr double kMostBound = 1e9;
constexpr double kLeastSeconds = 1e-9;  // of a move: over 0
constexpr double kMostSeconds = 3600;
constexpr double kMostCount = 10'000;

using GraphOption = NumberOption<GraphOptions>;

/// A number of the options, or of their bounds.
template <auto member>
GraphOption graph_number(const NumberOptionInfo& info) {
    return {info,
            [](const GraphOptions& from) {
                return Numbers{static_cast<double>(from.*member), 0};
            },
            [](GraphOptions& to, Numbers numbers) {
                using Type = std::remove_cvref_t<decltype(to.*member)>;
                to.*member = static_cast<Type>(numbers[0]);
            }};
}

template <auto member>
GraphOption graph_bound(const NumberOptionInfo& info) {
    return {info,
            [](const GraphOptions& from) {
                return Numbers{from.bounds.*member, 0};
            },
            [](GraphOptions& to, Numbers numbers) { to.bounds.*member = numbers[0]; }};
}

template <auto member>
GraphOption graph_count(NumberOptionInfo info) {
    info.placeholder = "N";
    info.least = 1;
    info.most = kMostCount;
    info.whole = true;
    return graph_number<member>(info);
}

}  // namespace

std::span<const NumberOption<GraphOptions>> graph_options() {
    static const std::array<GraphOption, 9> all{
        graph_bound<&GraphBounds::pose_distance>(
            {.key = "pose-distance",
             .placeholder = "D",
             .title = "Poses differ by at most",
             .unit = "m",
             .help = "Metres that poses may differ by where moves join: root mean square over the joints",
             .most = kMostBound,
             .step = 0.01,
             .decimals = 3}),
        graph_bound<&GraphBounds::root_speed>({.key = "root-speed",
                                               .placeholder = "V",
                                               .title = "Velocities differ by at most",
                                               .unit = "m/s",
                                               .help = "Metres per second that the root's velocity may change by there",
                                               .most = kMostBound,
                                               .step = 0.05,
                                               .decimals = 2}),
        GraphOption{{.key = "seconds",
                     .placeholder = "A:B",
                     .title = "A move lasts",
                     .unit = "s",
                     .help = "How long moves last",
                     .least = kLeastSeconds,
                     .most = kMostSeconds,
                     .step = 0.1,
                     .decimals = 2,
                     .between = ':',
                     .example = "1:4"},
                    [](const GraphOptions& from) {
                        return Numbers{from.least_seconds, from.most_seconds};
                    },
                    [](GraphOptions& to, Numbers numbers) {
                        to.least_seconds = numbers[0];
                        to.most_seconds = numbers[1];
                    }},
        graph_count<&GraphOptions::hubs>(
            {.key = "hubs", .title = "Hubs of a rig, at most", .help = "Most hubs for each rig"}),
        graph_count<&GraphOptions::moves>(
            {.key = "moves",
             .title = "Moves between two hubs, at most",
             .help = "Most moves from one hub to another; those that differ most are taken"}),
        graph_number<&GraphOptions::warp>(
            {.key = "warp",
             .placeholder = "S",
             .title = "Bent to the hub's pose over",
             .unit = "s",
             .help = "Seconds over which a move is warped at either end to its hub's pose and velocity; 0: not at all",
             .most = kMostSeconds,
             .step = 0.05,
             .decimals = 2}),
        graph_count<&GraphOptions::least_moves>({.key = "least-moves",
                                                 .title = "Moves of a part, at least",
                                                 .help = "Parts of the graph with fewer are left out"}),
        graph_count<&GraphOptions::candidates>({.key = "candidates",
                                                .title = "Moments looked at",
                                                .help = "Moments of each rig that are looked at as hubs",
                                                .step = 50}),
        graph_number<&GraphOptions::seed>({.key = "seed",
                                           .placeholder = "S",
                                           .title = "Seed",
                                           .help = "Decides which moments those are",
                                           .most = static_cast<double>(kMaxSeed),
                                           .whole = true}),
    };
    return all;
}

}  // namespace mobbscope
