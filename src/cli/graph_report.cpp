#include <base/file.h>
#include <base/text.h>
#include <cli/graph_report.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <optional>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

constexpr std::size_t kMostRows = 40;      // of a list for people; JSON has all
constexpr std::size_t kLongestNames = 80;  // characters of a list of joints

const SceneClip& played_by(const Scene& scene, int move) {
    const GraphMove& of = scene.graph->moves[static_cast<std::size_t>(move)];
    return scene.clips[static_cast<std::size_t>(of.clip)];
}

/// Of an End Site, which may have no name, that of the joint whose tip it is.
std::string joint_name(const Scene& scene, int move, int joint) {
    const int clip = clip_with_joints(scene, scene.graph->moves[static_cast<std::size_t>(move)]);
    const std::vector<Joint>& joints = scene.clips[static_cast<std::size_t>(clip)].skeleton->joints;
    const Joint& of = joints[static_cast<std::size_t>(joint)];
    if (!of.end_site || of.parent < 0) return of.name;
    return joints[static_cast<std::size_t>(of.parent)].name + " (tip)";
}

std::string in_thousandths(double value) { return brief(std::round(value * 1000) / 1000); }

std::string in_hundredths(double value) { return brief(std::round(value * 100) / 100); }

std::string in_tenths(double value) { return brief(std::round(value * 10) / 10); }

std::string where(const Scene& scene, int before, int after) {
    return "where " + in_quotes(played_by(scene, before).name) + " goes on with " +
           in_quotes(played_by(scene, after).name);
}

/// "3.1 times (0.2 m, 0.0645 inside the moves)".
std::string against_inside(const ChangeRow& row, const LargestRatio& largest) {
    const std::string unit = ' ' + std::string(row.unit);
    return in_hundredths(largest.ratio) + " times (" + in_thousandths(largest.across) + unit + ", " +
           in_thousandths(largest.inside) + " inside the moves)";
}

std::ostream& begin_line(std::ostream& out, std::string_view what) {
    return out << "  " << std::left << std::setw(16) << what << std::right;
}

/// A table: of each change its largest ratio, what that is of, and where.
void print_changes(std::ostream& out, const Scene& scene, const Continuity& of) {
    begin_line(out, "largest ratio") << formatted("%7s%9s%9s  %-7s%11s  where\n", "", "at join", "inside", "unit",
                                                  ("over " + brief(kMostRatio)).c_str());
    for (std::size_t c = 0; c < kChanges.size(); ++c) {
        const LargestRatio& largest = of.largest[c];
        begin_line(out, kChanges[c].words)
            << formatted("%7.2f%9.3f%9.3f  %-7s%11zu  ", largest.ratio, largest.across, largest.inside,
                         std::string(kChanges[c].unit).c_str(), static_cast<std::size_t>(largest.over))
            << cleaned(joint_name(scene, largest.before, largest.joint)) << ", "
            << in_quotes(played_by(scene, largest.before).name) << " to "
            << in_quotes(played_by(scene, largest.after).name) << '\n';
    }
}

void print_feet(std::ostream& out, const Scene& scene, const Continuity& of) {
    begin_line(out, "feet");
    if (of.contacts == 0) {
        out << "no joint stands still for " << brief(kLeastContact) << " s\n";
        return;
    }
    out << "slide " << in_thousandths(of.median_slide) << " m median in " << counted(of.contacts, "contact", "contacts")
        << ", " << in_thousandths(of.within.metres) << " m at most, "
        << in_quotes(joint_name(scene, of.within.before, of.within.joint)) << " in "
        << in_quotes(played_by(scene, of.within.before).name);
    if (of.across.joint >= 0) {
        out << "; across a join " << in_thousandths(of.across.metres) << " m "
            << where(scene, of.across.before, of.across.after);
    }
    out << '\n';
}

void write_slide(JsonWriter& out, const char* key, const Scene& scene, const LargestSlide& slide, bool across) {
    const auto if_any = [&](const auto& value) { return slide.joint >= 0 ? std::optional(value()) : std::nullopt; };
    out.begin_object(key, Layout::row);
    out.member("metres", if_any([&] { return slide.metres; }));
    out.member("joint", if_any([&] { return joint_name(scene, slide.before, slide.joint); }));
    out.member(across ? "before" : "clip", if_any([&] { return played_by(scene, slide.before).name; }));
    if (across) out.member("after", if_any([&] { return played_by(scene, slide.after).name; }));
    out.end_object();
}

void write_counts(JsonWriter& out, const Continuity& of) {
    out.members("joins", of.joins, "measured", of.measured, "over", of.over);
}

std::string bounded_figures(const Continuity& of) {
    std::string out;
    for (std::size_t c = 0; c < kChanges.size(); ++c) {
        if (!kChanges[c].bounded) continue;
        out += (out.empty() ? "" : ", ") + std::string(kChanges[c].words) + ' ' + in_hundredths(of.largest[c].ratio);
    }
    return out;
}

/// "no ratio over 1.25 at 96 joins".
std::string how_many_over(const Continuity& of, const std::string& joins) {
    const std::string bound = " over " + brief(kMostRatio) + " at ";
    if (of.over == 0) return "no ratio" + bound + joins;
    return "a ratio" + bound + std::to_string(of.over) + " of " + joins;
}

/// "; 12 others not measured, of clips without a common skeleton", if there are any.
std::string not_measured(const Continuity& of) {
    if (of.measured == of.joins) return "";
    return "; " + counted(of.joins - of.measured, "other", "others") +
           " not measured, of clips without a common skeleton";
}

void print_graph_continuity(std::ostream& out, const Scene& scene, const Continuity& continuity) {
    begin_line(out, "joins");
    if (continuity.measured == 0) {
        out << "not measured: no two clips that join have one skeleton\n";
        return;
    }
    out << "changes from frame to frame, against the most inside the two moves: "
        << how_many_over(continuity, counted(continuity.measured, "join", "joins"))
        << (promises_continuity(scene) ? "" : " (no bound: the moves are not warped)") << not_measured(continuity)
        << '\n';
    print_changes(out, scene, continuity);
    print_feet(out, scene, continuity);
}

std::vector<std::string> broken_continuity(const Scene& scene, const Continuity& continuity) {
    std::vector<std::string> out;
    if (!promises_continuity(scene)) return out;
    for (std::size_t c = 0; c < kChanges.size(); ++c) {
        const LargestRatio& largest = continuity.largest[c];
        if (!kChanges[c].bounded || largest.over == 0) continue;
        out.push_back("the change of the " + std::string(kChanges[c].words) + " is " +
                      against_inside(kChanges[c], largest) + ' ' + where(scene, largest.before, largest.after) +
                      ", over the bound of " + brief(kMostRatio));
    }
    return out;
}

void print_spread(std::ostream& out, const Scene& scene, const char* what, const char* unit,
                  const TransitionSpread& spread, double bound) {
    begin_line(out, what);
    if (spread.count == 0) {
        out << "not measured: no two clips that join have one skeleton\n";
        return;
    }
    out << in_thousandths(spread.median) << ' ' << unit << " median, " << in_thousandths(spread.largest)
        << " at most (bound " << (std::isfinite(bound) ? brief(bound) : "none") << ") as recorded, "
        << where(scene, spread.before, spread.after) << '\n';
}

/// Of many the first, and how many more there are: print(number, item).
template <class Items, class Print>
void print_rows(std::ostream& out, const Items& items, const Print& print) {
    for (std::size_t i = 0; i < std::min(items.size(), kMostRows); ++i) print(i, items[i]);
    if (items.size() > kMostRows) out << "  and " << items.size() - kMostRows << " more\n";
}

std::size_t moves_of_rig(const MotionGraph& graph, std::size_t rig) {
    return static_cast<std::size_t>(std::ranges::count(graph.moves, static_cast<int>(rig), &GraphMove::rig));
}

/// The names of the joints that count, as many as fit a line.
std::string joint_names(const GraphRig& rig) {
    std::string out;
    for (const std::string& joint : rig.joints) out += (out.empty() ? "" : ", ") + cleaned(joint);
    return shortened(out, kLongestNames);
}

void write_spread(JsonWriter& out, const char* key, const Scene& scene, const TransitionSpread& spread) {
    const auto if_any = [&spread](const auto& value) { return spread.count > 0 ? std::optional(value) : std::nullopt; };
    const auto clip = [&](int move) {
        return spread.count > 0 ? std::optional(played_by(scene, move).name) : std::nullopt;
    };
    out.key(key);
    out.row("count", spread.count, "median", if_any(spread.median), "largest", if_any(spread.largest), "before",
            clip(spread.before), "after", clip(spread.after));
}

}  // namespace

void print_graph_info(std::ostream& out, const Scene& scene, const GraphFigures& figures,
                      const TransitionMeasures& transitions, const Continuity& continuity) {
    const MotionGraph& graph = *scene.graph;
    out << cleaned(shown_name(scene.file)) << ": " << counted(graph.hubs.size(), "hub", "hubs") << ", "
        << counted(figures.moves, "move", "moves") << ", " << in_tenths(figures.seconds) << " s of motion\n"
        << "  a choice        every " << in_hundredths(figures.seconds_between_choices) << " s, among "
        << in_tenths(figures.choices) << " moves on average\n";
    print_spread(out, scene, "pose distance", "m", transitions.pose_distance, graph.bounds.pose_distance);
    print_spread(out, scene, "root velocity", "m/s", transitions.root_speed, graph.bounds.root_speed);
    if (transitions.pose_distance.count > 0 && transitions.pose_distance.count < transitions.count) {
        out << "                  " << transitions.count - transitions.pose_distance.count << " of "
            << transitions.count << " joins have no pose distance: their clips have no skeleton, or another one\n";
    }
    print_graph_continuity(out, scene, continuity);
    out << "  hub       begin here   end here   m/s\n";
    print_rows(out, figures.hubs, [&](std::size_t, const HubFigures& hub) {
        out << "  " << std::left << std::setw(8) << cleaned(hub.name) << std::right << std::setw(12) << hub.begin
            << std::setw(11) << hub.end << std::setw(6) << in_hundredths(hub.speed)
            << (hub.begin == 0 ? "   dead end" : "") << '\n';
    });
    out << "  in " << counted(figures.components.size(), "part", "parts") << " whose hubs lead to each other\n";
    const auto print_part = [&](std::size_t c, const ComponentFigures& part) {
        out << "  part " << c << ": " << counted(part.hubs.size(), "hub", "hubs") << " from "
            << cleaned(figures.hubs[static_cast<std::size_t>(part.hubs.front())].name) << ", "
            << counted(part.moves, "move", "moves") << ", " << in_tenths(part.seconds) << " s\n";
    };
    if (figures.components.size() > 1) print_rows(out, figures.components, print_part);
    print_rows(out, graph.rigs, [&](std::size_t r, const GraphRig& rig) {
        out << "  rig " << r << ": " << counted(moves_of_rig(graph, r), "move", "moves") << ", poses compared by "
            << counted(rig.joints.size(), "joint", "joints") << ": " << joint_names(rig) << '\n';
    });
    print_rows(out, figures.sources, [&](std::size_t, const SourceFigures& source) {
        out << "  " << counted(source.moves, "move", "moves") << ", " << in_tenths(source.seconds) << " s, from "
            << (source.file.empty() ? "samples in the file" : cleaned(source.file)) << '\n';
    });
}

void write_graph_info(std::ostream& to, const Scene& scene, const GraphFigures& figures,
                      const TransitionMeasures& transitions, const Continuity& continuity) {
    JsonWriter out(to);
    out.begin_object();
    out.member("file", scene.file.string());
    out.list("hubs", figures.hubs, [&](const HubFigures& hub) {
        out.row("name", hub.name, "begin", hub.begin, "end", hub.end, "speed", hub.speed);
    });
    out.members("moves", figures.moves, "seconds", figures.seconds);
    write_bounds(out, scene.graph->bounds);
    out.begin_object("joints");
    out.member("count", transitions.count);
    write_spread(out, "pose_distance", scene, transitions.pose_distance);
    write_spread(out, "root_speed", scene, transitions.root_speed);
    out.end_object();
    write_continuity(out, "continuity", scene, continuity);
    out.members("choices", figures.choices, "seconds_between_choices", figures.seconds_between_choices);
    out.list("components", figures.components, [&](const ComponentFigures& part) {
        out.begin_object(Layout::row);
        out.values("hubs", part.hubs);
        out.members("moves", part.moves, "seconds", part.seconds);
        out.end_object();
    });
    out.values("dead_ends", figures.dead_ends);
    std::size_t rig = 0;
    out.list("rigs", scene.graph->rigs, [&](const GraphRig& of) {
        out.begin_object(Layout::row);
        out.member("moves", moves_of_rig(*scene.graph, rig++));
        out.values("joints", of.joints);
        out.end_object();
    });
    out.list("sources", figures.sources, [&](const SourceFigures& source) {
        const auto file = source.file.empty() ? std::nullopt : std::optional(source.file);
        out.row("file", file, "moves", source.moves, "seconds", source.seconds);
    });
    out.member("holds", broken_bounds(scene, transitions, continuity).empty());
    out.end_object();
}

std::vector<std::string> broken_bounds(const Scene& scene, const TransitionMeasures& transitions,
                                       const Continuity& continuity) {
    std::vector<std::string> out = broken_continuity(scene, continuity);
    const auto hold = [&](const TransitionSpread& spread, double bound, const char* what, const char* unit) {
        if (!exceeds(spread, bound)) return;
        out.push_back(std::string(what) + " is " + brief(spread.largest) + ' ' + unit + ' ' +
                      where(scene, spread.before, spread.after) + ", over the bound of " + brief(bound) + ' ' + unit);
    };
    hold(transitions.pose_distance, scene.graph->bounds.pose_distance, "the pose distance", "m");
    hold(transitions.root_speed, scene.graph->bounds.root_speed, "the change of the root's velocity", "m/s");
    return out;
}

void print_continuity(std::ostream& out, const RunContinuity& continuity) {
    const Continuity& free = continuity.free;
    const Continuity& forced = continuity.forced;
    if (free.measured + forced.measured == 0) {
        out << "how continuous it is was not measured: no two clips that join have one skeleton\n";
        return;
    }
    if (free.measured > 0) {
        out << "changes where moves join, against those inside them: "
            << how_many_over(free, counted(free.measured, "join", "joins")) << " (" << free.different
            << " different); largest: " << bounded_figures(free) << not_measured(free) << '\n';
    }
    if (free.contacts > 0) {
        out << "feet slide " << in_thousandths(free.median_slide) << " m (median), "
            << in_thousandths(free.within.metres) << " m at most within a move";
        if (free.across.joint >= 0) out << ", " << in_thousandths(free.across.metres) << " m across a join";
        out << '\n';
    }
    if (forced.measured > 0) {
        out << "beside these, " << how_many_over(forced, counted(forced.measured, "forced join", "forced joins"))
            << '\n';
    }
}

void write_forced_continuity(JsonWriter& out, const char* key, const Continuity& continuity) {
    out.begin_object(key, Layout::row);
    write_counts(out, continuity);
    out.end_object();
}

void write_continuity(JsonWriter& out, const char* key, const Scene& scene, const Continuity& continuity) {
    out.begin_object(key);
    out.member("bound", promises_continuity(scene) ? std::optional(kMostRatio) : std::nullopt);
    write_counts(out, continuity);
    for (std::size_t c = 0; c < kChanges.size(); ++c) {
        const LargestRatio& largest = continuity.largest[c];
        const auto if_any = [&](const auto& value) {
            return largest.before >= 0 ? std::optional(value()) : std::nullopt;
        };
        out.begin_object(kChanges[c].key, Layout::row);
        out.member("ratio", if_any([&] { return largest.ratio; }));
        out.member("across", if_any([&] { return largest.across; }));
        out.member("inside", if_any([&] { return largest.inside; }));
        out.member("joint", if_any([&] { return joint_name(scene, largest.before, largest.joint); }));
        out.member("before", if_any([&] { return played_by(scene, largest.before).name; }));
        out.member("after", if_any([&] { return played_by(scene, largest.after).name; }));
        out.member("over", largest.over);
        out.end_object();
    }
    out.begin_object("foot_slide");
    out.member("contacts", continuity.contacts);
    out.member("median", continuity.contacts > 0 ? std::optional(continuity.median_slide) : std::nullopt);
    write_slide(out, "within", scene, continuity.within, false);
    write_slide(out, "across", scene, continuity.across, true);
    out.end_object();
    out.end_object();
}

}  // namespace mobbscope::cli
