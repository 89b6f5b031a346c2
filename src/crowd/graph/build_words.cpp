#include <base/text.h>
#include <crowd/graph/build_words.h>

#include <cstddef>

namespace mobbscope {

namespace {

std::string moves_text(std::size_t count) { return counted(count, "move", "moves"); }

std::string hubs_text(std::size_t count) { return counted(count, "hub", "hubs"); }

}  // namespace

std::string size_in_words(const MotionGraph& graph) {
    return hubs_text(graph.hubs.size()) + ", " + moves_text(graph.moves.size());
}

std::string source_in_words(const BuildReport& report) {
    return "from " + counted(report.recordings, "recording", "recordings") + ", " + brief(report.seconds) + " s" +
           (report.rigs > 0 ? " of " + counted(report.rigs, "rig", "rigs") : "");
}

std::vector<std::string> in_words(const BuildReport& report) {
    return {source_in_words(report) + ": " + counted(report.pieces, "piece", "pieces") + " between the hubs",
            "left out: " + std::to_string(report.alike) + " that go like others or are more than --moves; " +
                moves_text(report.dead_ends) + " and " + hubs_text(report.dropped_hubs) +
                " at dead ends or in parts of fewer than --least-moves",
            "measured again from the files: " + counted(report.joints_checked, "join", "joins") + "; " +
                moves_text(report.broken) + " dropped that broke a bound"};
}

std::vector<std::string> warnings_of(const BuildReport& report) {
    std::vector<std::string> out;
    if (report.rigs_left_out > 0) {
        out.push_back(counted(report.rigs_left_out, "rig has", "rigs have") +
                      " no pose that comes again often enough, and no part in the graph");
    }
    if (report.without_joints > 0) {
        out.push_back(counted(report.without_joints, "clip has", "clips have") +
                      " no joints, and no part in the graph");
    }
    if (report.too_long > 0) {
        out.push_back(counted(report.too_long, "clip has", "clips have") +
                      " too many samples to keep the joints of each, and no part in the graph; lower --fps");
    }
    return out;
}

std::string why_no_move(const BuildReport& report) {
    return "measured again from the files no move keeps the bounds (" + moves_text(report.broken) +
           " dropped that broke one)";
}

}  // namespace mobbscope
