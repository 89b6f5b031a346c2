#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <conflicts/conflicts.h>
#include <mobb/predicate.h>
#include <mobb/traversal.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <tuple>

namespace mobbscope {

namespace {

/// The pair's conflict; without intervals if there is none. Where two collide the least clearance is that of a pair of
/// samples that collides: no other is measured for it.
Conflict conflict_of(const mobb::PlacedTree& a, const mobb::PlacedTree& b, Search search) {
    const bool direct = search == Search::direct;
    const mobb::PlacedClip& clip_a = a.placed_clip();
    const mobb::PlacedClip& clip_b = b.placed_clip();
    Conflict conflict;
    conflict.intervals = direct ? mobb::direct_contact_intervals(clip_a, clip_b) : mobb::contact_intervals(a, b);
    if (conflict.intervals.empty()) return conflict;
    conflict.least_clearance = std::numeric_limits<double>::infinity();
    // Told of every pair of samples that collides, in order of time.
    auto keep_deepest = [&](int i, int j) {
        const mobb::Approach approach = mobb::approach_of(clip_a, i, clip_b, j);
        const double s = approach.nearest();
        const double clearance = approach.clearance(s);
        if (clearance >= conflict.least_clearance) return false;
        conflict.least_clearance = clearance;
        conflict.time = approach.time(s);
        conflict.a_sample = i;
        conflict.b_sample = j;
        return false;
    };
    mobb::NoObserver observer;
    if (direct) {
        mobb::visit_sample_pairs(clip_a, 0, clip_a.count(), clip_b, 0, clip_b.count(), observer, keep_deepest);
    } else {
        mobb::visit_hits(a, b, observer, keep_deepest);
    }
    return conflict;
}

constexpr int kPieceSamples = 16;  // few enough that a piece is small on the floor, enough that pieces are few
constexpr double kMostCellsPerPiece = 8;
constexpr std::size_t kPairsAtFirst = 1'000'000;
constexpr std::size_t kMostKept = 10'000;  // conflicts, some 600 bytes each
// Widen the pieces by more than any rounding of the predicate, of held and of linear clips (see mobb/separation.cpp):
// it must not hit where they are apart.
constexpr double kWidening = 1e-14;
constexpr double kLinearWidening = 1e-6;

/// Some samples of a member: where they are on the floor, and when.
struct PathPiece {
    int member = 0;
    double t0 = 0, t1 = 0;
    double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

bool near(const PathPiece& a, const PathPiece& b) {
    return a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1 &&
           mobb::overlap_in_time(a.t0, a.t1, b.t0, b.t1);
}

std::vector<PathPiece> cut(std::span<const mobb::PlacedTree> crowd) {
    std::vector<PathPiece> pieces;
    for (std::size_t member = 0; member < crowd.size(); ++member) {
        const mobb::PlacedClip& clip = crowd[member].placed_clip();
        const double widening = clip.is_linear() ? kLinearWidening : kWidening;
        for (int first = 0; first < clip.count(); first += kPieceSamples) {
            const int end = std::min(clip.count() - first, kPieceSamples) + first;
            constexpr double kFar = std::numeric_limits<double>::infinity();
            PathPiece piece{static_cast<int>(member), clip.time(first), clip.time(end), kFar, -kFar, kFar, -kFar};
            // The last sample of a piece may run to the first of the next.
            const int reached = std::min(clip.is_linear() ? end + 1 : end, clip.count());
            for (int i = first; i < reached; ++i) {
                const mobb::Disk disk = clip.disk(i);
                const double wide = disk.r + widening * (std::abs(disk.x) + std::abs(disk.y) + disk.r);
                piece.x0 = std::min(piece.x0, disk.x - wide);
                piece.x1 = std::max(piece.x1, disk.x + wide);
                piece.y0 = std::min(piece.y0, disk.y - wide);
                piece.y1 = std::max(piece.y1, disk.y + wide);
            }
            pieces.push_back(piece);
        }
    }
    return pieces;
}

/// Square cells on the floor.
class Grid {
  public:
    /// Chooses cells as large as a piece is wide on average, and larger ones where some pieces would cover too many.
    explicit Grid(std::span<const PathPiece> pieces) {
        const auto count = static_cast<double>(pieces.size());
        double width = 0, largest = 0;
        for (const PathPiece& piece : pieces) {
            width += std::max(piece.x1 - piece.x0, piece.y1 - piece.y0) / count;
            largest =
                std::max({largest, std::abs(piece.x0), std::abs(piece.x1), std::abs(piece.y0), std::abs(piece.y1)});
        }
        // The numbers of cells fit 31 bits.
        size_ = std::max({width, largest * 0x1p-30, std::numeric_limits<double>::min()});
        while (cells_covered(pieces) > kMostCellsPerPiece * count) size_ *= 2;
    }

    /// Calls visit with a number for each cell that the piece covers; few cells have the same.
    template <class Visit>
    void for_each_cell(const PathPiece& piece, Visit visit) const {
        const std::int64_t x1 = cell(piece.x1);
        const std::int64_t y1 = cell(piece.y1);
        const std::int64_t y0 = cell(piece.y0);
        for (std::int64_t x = cell(piece.x0); x <= x1; ++x) {
            for (std::int64_t y = y0; y <= y1; ++y) visit(static_cast<std::size_t>(x * kColumn + y));
        }
    }

  private:
    std::int64_t cell(double coordinate) const { return static_cast<std::int64_t>(std::floor(coordinate / size_)); }

    double cells_covered(std::span<const PathPiece> pieces) const {
        double sum = 0;
        for (const PathPiece& piece : pieces) {
            sum += static_cast<double>(cell(piece.x1) - cell(piece.x0) + 1) *
                   static_cast<double>(cell(piece.y1) - cell(piece.y0) + 1);
        }
        return sum;
    }

    static constexpr std::int64_t kColumn =
        0x9E3779B1;  // odd and large: columns side by side do not fall on each other

    double size_ = 1;
};

/// Something that is walked, and by whom.
struct Walked {
    PlacedAgent path;
    int person = 0;  ///< from 0: the agent of the scene or the run, or the clip that stands for one
    int play = -1;   ///< of a run: index into CrowdAgent::plays
    std::shared_ptr<const mobb::Tree> joint{};  ///< of a run: the path is the joint that leads to the play; else null
};

std::vector<Walked> walked_in(const FittedScene& fitted) {
    const Scene& scene = fitted.scene();
    std::vector<Walked> out;
    if (!is_run(scene)) {
        for (const PlacedAgent& path : fitted.placed_agents()) out.push_back({path, static_cast<int>(out.size())});
        return out;
    }
    int person = 0;
    for (const CrowdAgent& agent : scene.crowd->agents) {
        std::optional<PlayJoint> joint;
        for (std::size_t i = 0; i < agent.plays.size(); ++i) {
            const Play& play = agent.plays[i];
            const int clip = scene.graph->moves[static_cast<std::size_t>(play.move)].clip;
            const int number = static_cast<int>(i);
            // A choice is of the way to the move, too.
            if (joint) {
                out.push_back({{agent.name, clip, joint->placement, person},
                               person,
                               number,
                               std::make_shared<const mobb::Tree>(joint->clip, fitted.options())});
            }
            if (!is_joints_alone(scene, agent, i))
                out.push_back({{agent.name, clip, play.placement, person}, person, number});
            joint = joint_behind(scene, agent, i);
        }
        ++person;
    }
    return out;
}

/// Sorted, with those that touch or overlap put together: a path ends where the next one begins.
std::vector<mobb::Interval> joined(std::vector<mobb::Interval> intervals) {
    std::ranges::sort(intervals, {}, &mobb::Interval::t0);
    std::vector<mobb::Interval> out;
    for (const mobb::Interval& interval : intervals) {
        if (!out.empty() && interval.t0 <= out.back().t1 + mobb::kMinOverlap) {
            out.back().t1 = std::max(out.back().t1, interval.t1);
        } else {
            out.push_back(interval);
        }
    }
    return out;
}

/// One conflict of all those between the paths of two people.
PeopleConflict put_together(int a, int b, std::span<const Conflict> of_paths) {
    std::vector<mobb::Interval> intervals;
    for (const Conflict& conflict : of_paths)
        intervals.insert(intervals.end(), conflict.intervals.begin(), conflict.intervals.end());
    const auto depth = [](const Conflict& of) { return std::tuple(of.least_clearance, of.time); };
    const auto deepest = std::ranges::min_element(of_paths, {}, depth);
    PeopleConflict out{a, b, joined(std::move(intervals)), *deepest, {}};
    const double begin = out.worst().t0;
    out.begins = *std::ranges::find_if(of_paths, [begin](const Conflict& of) {
        return std::ranges::find(of.intervals, begin, &mobb::Interval::t0) != of.intervals.end();
    });
    return out;
}

/// Throws InputError if so many bytes for pairs of a crowd are beyond the budget.
void cover(Spent& spent, std::size_t bytes) {
    if (!spent.try_cover(bytes))
        throw InputError(
            "too many pairs of the crowd come near each other for the memory; leave agents out, or give --trim");
}

void keep_each_once(std::vector<std::pair<int, int>>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

std::vector<std::pair<int, int>> near_pairs(std::span<const mobb::PlacedTree> crowd) {
    std::vector<PathPiece> pieces = cut(crowd);
    std::vector<std::pair<int, int>> pairs;
    if (pieces.empty()) return pairs;
    std::sort(pieces.begin(), pieces.end(), [](const PathPiece& a, const PathPiece& b) { return a.t0 < b.t0; });
    const Grid grid(pieces);
    // Pieces that may not have ended, by cell. Cells that share a place cost time alone.
    std::vector<std::vector<const PathPiece*>> present(std::bit_ceil(pieces.size()));
    std::vector<const PathPiece*> met_by(crowd.size());  // by member: the last piece that was near a piece of it
    std::size_t room = kPairsAtFirst;
    Spent spent;
    for (const PathPiece& piece : pieces) {
        // Those who walk together are found again with each of their pieces.
        if (pairs.size() > room) {
            keep_each_once(pairs);
            room = std::max(kPairsAtFirst, 2 * pairs.size());
        }
        // While it grows there are two of it.
        cover(spent, 2 * pairs.size() * sizeof(pairs[0]));
        grid.for_each_cell(piece, [&](std::size_t cell) {
            std::vector<const PathPiece*>& others = present[cell & (present.size() - 1)];
            std::erase_if(others, [&](const PathPiece* other) { return other->t1 <= piece.t0; });
            for (const PathPiece* other : others) {
                if (other->member == piece.member || !near(*other, piece)) continue;
                // Most are near each other in several cells.
                if (std::exchange(met_by[static_cast<std::size_t>(other->member)], &piece) == &piece) continue;
                pairs.emplace_back(std::min(other->member, piece.member), std::max(other->member, piece.member));
            }
            others.push_back(&piece);
        });
    }
    keep_each_once(pairs);
    return pairs;
}

const mobb::Interval& PeopleConflict::worst() const {
    // The deepest pair's overlap begins within an interval, or where two were put together.
    const auto begins_later = [this](double t0) { return t0 > deepest.time; };
    const auto after = std::ranges::find_if(intervals, begins_later, &mobb::Interval::t0);
    return after == intervals.begin() ? *after : *(after - 1);
}

double PeopleConflict::seconds() const {
    double sum = 0;
    for (const mobb::Interval& interval : intervals) sum += interval.t1 - interval.t0;
    return sum;
}

template <class Test>
void PeopleConflicts::for_each_pair(int person, std::optional<int> with, const Test& test) const {
    const auto path = [this](int of) { return first_path_[static_cast<std::size_t>(of)]; };
    const int first = with ? path(*with) : path(person + 1);
    const int end = with ? path(*with + 1) : path(people());
    for (int a = path(person); a < path(person + 1); ++a) {
        if (search_ == Search::direct) {
            for (int b = first; b < end; ++b) test(a, b);
            continue;
        }
        for (auto at = std::lower_bound(near_.begin(), near_.end(), std::pair(a, first));
             at != near_.end() && *at < std::pair(a, end); ++at)
            test(a, at->second);
    }
}

std::optional<Conflict> PeopleConflicts::conflict_between(int a, int b) const {
    Conflict conflict = conflict_of(crowd_[static_cast<std::size_t>(a)], crowd_[static_cast<std::size_t>(b)], search_);
    if (conflict.intervals.empty()) return std::nullopt;
    conflict.a = a;
    conflict.b = b;
    return conflict;
}

PeopleConflicts::PeopleConflicts(std::span<const mobb::PlacedTree> crowd, std::span<const int> person_of, Search search,
                                 const Progress& progress)
    : crowd_(crowd.begin(), crowd.end()), person_of_(person_of.begin(), person_of.end()), search_(search) {
    const int paths = static_cast<int>(crowd_.size());
    for (int path = 0; path < paths; ++path) {
        const auto person = static_cast<std::size_t>(person_of_[static_cast<std::size_t>(path)]);
        while (first_path_.size() <= person) first_path_.push_back(path);
    }
    first_path_.push_back(paths);
    if (search == Search::trees) near_ = near_pairs(crowd_);
    ranked_.reserve(near_.size());
    const std::size_t all =
        search == Search::trees ? near_.size() : crowd_.size() * (std::max<std::size_t>(crowd_.size(), 1) - 1) / 2;
    std::size_t done = 0;
    std::vector<int> asked(static_cast<std::size_t>(people()), -1);  // by person: the last whose paths were asked
    for (int person = 0; person < people(); ++person) {
        std::map<int, std::vector<Conflict>> met;  // by the other
        for_each_pair(person, std::nullopt, [&](int a, int b) {
            if (progress) progress(done, all);
            ++done;
            const int other = person_of_[static_cast<std::size_t>(b)];
            if (std::exchange(asked[static_cast<std::size_t>(other)], person) != person) ++tested_;
            if (auto conflict = conflict_between(a, b)) met[other].push_back(std::move(*conflict));
        });
        for (const auto& [other, conflicts] : met) {
            PeopleConflict found = put_together(person, other, conflicts);
            cover(spent_, near_.size() * sizeof(near_[0]) + (ranked_.size() + 1) * sizeof(Ranked));
            ranked_.push_back(
                {found.deepest.least_clearance, found.seconds(), found.worst().t0, found.a, found.b, ranked_.size()});
            if (kept_.size() < kMostKept) kept_.push_back(std::move(found));
        }
    }
    std::ranges::sort(ranked_, {}, [](const Ranked& of) {
        return std::tuple(of.least_clearance, -of.seconds, of.begin, of.a, of.b);
    });
}

PeopleConflict PeopleConflicts::operator[](std::size_t index) const {
    const Ranked& ranked = ranked_[index];
    if (ranked.found < kept_.size()) return kept_[ranked.found];
    std::vector<Conflict> of_paths;
    for_each_pair(ranked.a, ranked.b, [&](int a, int b) {
        if (auto conflict = conflict_between(a, b)) of_paths.push_back(std::move(*conflict));
    });
    return put_together(ranked.a, ranked.b, of_paths);
}

std::size_t PeopleConflicts::pairs() const {
    const auto count = static_cast<std::size_t>(people());
    return count < 2 ? 0 : count * (count - 1) / 2;
}

double PeopleConflicts::seconds() const {
    double sum = 0;
    for (const Ranked& conflict : ranked_) sum += conflict.seconds;
    return sum;
}

std::string conflict_count(std::size_t conflicts, std::size_t people, double seconds) {
    return counted(conflicts, "conflict", "conflicts") + " among " + counted(people, "agent", "agents") + ", " +
           figure(seconds) + " s in all";
}

std::vector<SceneConflict> conflicts_in(const FittedScene& fitted, const Progress& progress) {
    const std::vector<Walked> walked = walked_in(fitted);
    std::vector<mobb::PlacedTree> trees;
    std::vector<int> person_of;
    for (const Walked& one : walked) {
        trees.push_back(one.joint ? mobb::PlacedTree(*one.joint, one.path.placement) : fitted.placed(one.path));
        person_of.push_back(one.person);
    }
    const PeopleConflicts conflicts(trees, person_of, Search::trees, progress);
    if (conflicts.size() > kMostSceneConflicts) {
        throw InputError(shown_name(fitted.scene().file),
                         "it has " + std::to_string(conflicts.size()) + " conflicts, more than the " +
                             std::to_string(kMostSceneConflicts) +
                             " that a list holds; mobbscope conflicts writes them all");
    }
    std::vector<SceneConflict> out;
    out.reserve(conflicts.size());
    for (std::size_t i = 0; i < conflicts.size(); ++i) {
        if (progress) progress(i, conflicts.size());
        PeopleConflict found = conflicts[i];
        const Walked& a = walked[static_cast<std::size_t>(found.begins.a)];
        const Walked& b = walked[static_cast<std::size_t>(found.begins.b)];
        const auto joint_of = [](const Walked& one) { return one.joint ? one.joint->shared_clip() : nullptr; };
        out.push_back({a.path, b.path, a.play, b.play, joint_of(a), joint_of(b), std::move(found)});
    }
    return out;
}

std::optional<glm::dvec3> place_of(const Scene& scene, const SceneConflict& conflict) {
    const double time = conflict.begin();
    const auto disk_of = [&](const PlacedAgent& who, const mobb::ClipPtr& joint) -> std::optional<mobb::Disk> {
        const SceneClip& clip = scene.clips[static_cast<std::size_t>(who.clip)];
        const mobb::PlacedClip placed(joint ? *joint : *clip.clip, who.placement);
        const int sample = mobb::first_ending_after(placed, 0, placed.count(), time);
        if (sample >= placed.count()) return std::nullopt;
        return mobb::swept(placed, sample).at(time);
    };
    const auto a = disk_of(conflict.a, conflict.a_joint);
    const auto b = disk_of(conflict.b, conflict.b_joint);
    if (!a || !b) return std::nullopt;
    const double share = a->r + b->r > 0 ? a->r / (a->r + b->r) : 0.5;
    return glm::dvec3(a->x + share * (b->x - a->x), a->y + share * (b->y - a->y), time);
}

std::string sentence(const SceneConflict& conflict) {
    const auto& worst = conflict.facts.worst();
    std::string text = conflict.a.name + " and " + conflict.b.name + ": " +
                       with_unit(-conflict.facts.deepest.least_clearance, "m") +
                       formatted(" deep, from %.2f to %.2f s", worst.t0, worst.t1);
    const std::size_t others = conflict.facts.intervals.size() - 1;
    if (others > 0) text += "; they meet " + (others == 1 ? "once" : counted(others, "time", "times")) + " more";
    return text;
}

namespace {

const Play& play_of(const CrowdRun& run, const PlacedAgent& who, int play) {
    return run.agents[static_cast<std::size_t>(who.agent)].plays[static_cast<std::size_t>(play)];
}

}  // namespace

bool made_by_a(const CrowdRun& run, const SceneConflict& conflict) {
    // Choices of one time are made in the order of agents.
    const auto blame = [](const Play& play, int agent) {
        return std::tuple(play.kind == PlayKind::forced, play.chosen_at, agent);
    };
    const auto a = blame(play_of(run, conflict.a, conflict.a_play), conflict.a.agent);
    return a > blame(play_of(run, conflict.b, conflict.b_play), conflict.b.agent);
}

bool was_forced(const CrowdRun& run, const SceneConflict& conflict) {
    return play_of(run, conflict.a, conflict.a_play).kind == PlayKind::forced ||
           play_of(run, conflict.b, conflict.b_play).kind == PlayKind::forced;
}

}  // namespace mobbscope
