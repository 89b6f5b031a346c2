// Plans of the League of Robot Runners (MAPF-Competition/Start-Kit): JSON with where each robot starts and its actions.
#include <base/json.h>
#include <import/clip/sampling.h>
#include <import/tracks/mapf_plan.h>
#include <mobb/clip.h>

#include <array>
#include <utility>

namespace mobbscope {

namespace {

/// Cells that a robot goes in a step, with rows downwards.
struct CellStep {
    int row, column;
};

/// East, south, west, north: clockwise.
constexpr std::array<CellStep, 4> kHeadings{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};
constexpr std::string_view kHeadingLetters = "ESWN";
constexpr std::string_view kMoveLetters = "RDLU";  // in the same order

class RobotRunnersReader {
  public:
    RobotRunnersReader(std::string_view text, const std::string& file)
        : text_(parse_json(text, file)), root_(text_, file) {}

    TrackFile read() {
        turns_ = reads_turns();
        const JsonPlace starts = root_.require("start");
        const std::optional<JsonPlace> actual = root_.find("actualPaths");
        const bool planned = !actual || actual->size() == 0;
        const JsonPlace paths = planned ? root_.require("plannerPaths") : *actual;
        if (paths.size() != starts.size() || paths.size() == 0) {
            paths.fail("has " + counted(paths.size(), "path", "paths") + " for " +
                       counted(starts.size(), "start", "starts") + "; give every robot one of each");
        }
        for (int i = 0; i < paths.size(); ++i) read_robot(std::to_string(i), starts[i], paths[i]);
        TrackFile out = plan_of(tracks_, root_.file());
        out.warnings.push_back({"cells are (row, column): x is the column, y the row"});
        if (planned) {
            out.warnings.push_back(
                {"there are no actualPaths: plannerPaths are taken, which the robots need not have followed"});
        }
        return out;
    }

  private:
    /// Whether robots turn and go forward, or go in any direction.
    bool reads_turns() const {
        const std::optional<JsonPlace> model = root_.find("actionModel");
        if (!model || model->string() == "MAPF_T") return true;
        if (model->string() != "MAPF")
            model->fail(in_quotes(model->string()) + " is not an action model that is known; give MAPF or MAPF_T");
        return false;
    }

    void read_robot(const std::string& id, const JsonPlace& start, const JsonPlace& path) {
        constexpr int kMostCells = 1'000'000'000;  // as moves add up to more
        if (start.size() < 2) start.fail("must be [row, column], and with turns a heading such as \"E\"");
        int row = start[0].integer(-kMostCells, kMostCells), column = start[1].integer(-kMostCells, kMostCells);
        std::size_t heading = turns_ ? heading_of(start) : 0;
        int step = 0;
        const auto add = [&] {
            tracks_.add(
                id, {static_cast<double>(step++), static_cast<double>(column), static_cast<double>(row), path.line()});
        };
        add();
        for (const char action : path.string()) {
            if (action == ',' || action == ' ') continue;
            // T: the planner said nothing in time.
            const std::size_t move = turns_ ? std::string_view::npos : kMoveLetters.find(action);
            if (move != std::string_view::npos) {
                heading = move;
            } else if (turns_ && (action == 'R' || action == 'C')) {
                heading = (heading + (action == 'R' ? 1 : 3)) % kHeadings.size();
            } else if (action != 'W' && action != 'T' && !(turns_ && action == 'F')) {
                path.fail("step " + std::to_string(step) + " is " + in_quotes({&action, 1}) +
                          (turns_ ? ", which is none of F, R, C, W and T" : ", which is none of R, D, L, U, W and T"));
            }
            if (move != std::string_view::npos || (turns_ && action == 'F')) {
                row += kHeadings[heading].row;
                column += kHeadings[heading].column;
            }
            add();
        }
    }

    std::size_t heading_of(const JsonPlace& start) const {
        if (start.size() < 3) start.fail("has no heading; give [row, column, \"E\"], or S, W or N");
        const JsonPlace heading = start[2];
        const std::string& word = heading.string();
        const std::size_t at = word.size() == 1 ? kHeadingLetters.find(word.front()) : std::string_view::npos;
        if (at == std::string_view::npos) heading.fail(in_quotes(word) + " is no heading; give E, S, W or N");
        return at;
    }

    JsonText text_;
    JsonPlace root_;
    bool turns_ = true;
    TrackCollector tracks_{root_.file()};
};

}  // namespace

bool looks_like_robot_runners(std::string_view text) {
    return json_head(text).has_any({"actionModel", "actualPaths", "plannerPaths"});
}

TrackFile parse_robot_runners(std::string_view text, const std::string& file) {
    return RobotRunnersReader(text, file).read();
}

}  // namespace mobbscope
