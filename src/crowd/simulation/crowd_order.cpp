#include <base/text.h>
#include <crowd/simulation/crowd_order.h>
#include <scene/crowd_run.h>

#include <array>
#include <cstdint>
#include <utility>

namespace mobbscope {

namespace {

using CrowdOption = NumberOption<CrowdOrder>;

/// Seconds of the options.
template <double SimulateOptions::*member>
CrowdOption crowd_seconds(NumberOptionInfo info, double least = 0) {
    info.placeholder = "S";
    info.unit = "s";
    info.least = least;
    info.most = kMaxSimulated;
    info.decimals = 1;
    return {info,
            [](const CrowdOrder& from) {
                return Numbers{from.options.*member, 0};
            },
            [](CrowdOrder& to, Numbers numbers) { to.options.*member = numbers[0]; }};
}

}  // namespace

std::span<const NumberOption<CrowdOrder>> crowd_options() {
    static const std::array<CrowdOption, 8> all{
        CrowdOption{{.key = "agents",
                     .placeholder = "N",
                     .title = "Agents",
                     .help = "How many",
                     .least = 1,
                     .most = kMaxAgents,
                     .step = 10,
                     .whole = true},
                    [](const CrowdOrder& from) {
                        return Numbers{static_cast<double>(from.options.agents), 0};
                    },
                    [](CrowdOrder& to, Numbers numbers) { to.options.agents = static_cast<int>(numbers[0]); }},
        CrowdOption{{.key = "area",
                     .placeholder = "WxH",
                     .title = "Floor",
                     .unit = "m",
                     .help = "The floor, in metres",
                     .least = kMinArea,
                     .most = kMaxArea,
                     .decimals = 1,
                     .between = 'x',
                     .example = "30x40"},
                    [](const CrowdOrder& from) {
                        return Numbers{from.options.area.x, from.options.area.y};
                    },
                    [](CrowdOrder& to, Numbers numbers) {
                        to.options.area = {numbers[0], numbers[1]};
                    }},
        crowd_seconds<&SimulateOptions::seconds>(
            {.key = "seconds", .title = "Time simulated", .help = "Simulated", .step = 10}, kMinSimulated),
        CrowdOption{{.key = "seed",
                     .placeholder = "N",
                     .title = "Seed",
                     .help = "Another seed, another run",
                     .most = static_cast<double>(kMaxSeed),
                     .whole = true},
                    [](const CrowdOrder& from) {
                        return Numbers{static_cast<double>(from.options.seed), 0};
                    },
                    [](CrowdOrder& to, Numbers numbers) { to.options.seed = static_cast<std::uint64_t>(numbers[0]); }},
        crowd_seconds<&SimulateOptions::ahead>({.key = "ahead",
                                                .title = "Moves chosen ahead by",
                                                .help = "Seconds before its begin at which a move is chosen",
                                                .step = 0.1}),
        crowd_seconds<&SimulateOptions::grace>(
            {.key = "grace",
             .title = "Room kept at ends for",
             .help = "Seconds for which room is kept where moves end; 0: none, as in the paper",
             .step = 0.1}),
        crowd_seconds<&SimulateOptions::plan>(
            {.key = "plan",
             .title = "Plans reach ahead by",
             .help = "Seconds for which each choice plans how to go on; 0: not at all, as in the paper",
             .step = 0.5}),
        CrowdOption{{.key = "turn-rate",
                     .placeholder = "DEG_PER_S",
                     .title = "Turns on the way by at most",
                     .unit = "\u00B0/s",
                     .help = "Largest angular speed at which agents turn on the way of a move; 0: they do not",
                     .most = kMaxTurnRate,
                     .step = 10,
                     .decimals = 1},
                    [](const CrowdOrder& from) {
                        return Numbers{from.turn_rate, 0};
                    },
                    [](CrowdOrder& to, Numbers numbers) { to.turn_rate = numbers[0]; }},
    };
    return all;
}

Scene played_part(Scene scene) {
    scene.agents.clear();
    scene.queries.clear();
    if (scene.graph) remove_run(scene);
    scene.view = {};
    // They are about agents and queries that are gone.
    scene.debug.bookmarks.clear();
    scene.debug.views.clear();
    return scene;
}

std::string in_words(const SimulationCounts& counts) {
    return counted(counts.agents, "agent", "agents") + " for " + brief(counts.simulated) +
           " s: " + counted(counts.plays, "play", "plays") + ", " + counted(counts.choices, "choice", "choices");
}

}  // namespace mobbscope
