/// The moves that a crowd can play: those of its motion graph, and each of them turned on the way.
#pragma once

#include <crowd/simulation/played_move.h>
#include <mobb/clip.h>
#include <scene/crowd_run.h>
#include <scene/fitted_scene.h>
#include <scene/motion_graph.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace mobbscope {

/// Degrees that an agent may turn on the way of a move, the least first: multiples of kTurnStep.
inline constexpr std::array<double, 24> kTurns{0,   15,  -15,  30,  -30,  45,  -45,  60,  -60,  75,  -75,  90,
                                               -90, 105, -105, 120, -120, 135, -135, 150, -150, 165, -165, 180};

/// Degrees per second where nothing else is asked: a quick step aside, not a spin.
inline constexpr double kDefaultTurnRate = 120;

/// What queries go through: the answers are the same.
enum class QueriedBy {
    blocks,  ///< the fastest (mobb/blocks.h)
    trees,   ///< those of the fit in use
};

/// Whether clips that are turned on the way get skeletons of their own: a run has hundreds of them, and a file has
/// none.
enum class TurnedSkeletons {
    made,
    left_out,  ///< of clips with a source
};

/// The moves of a motion graph, and behind them all that they become by turns: each move that is no variant of
/// another, by each of kTurns that its duration allows, unless the graph has that variant. Moves are counted through
/// both. Refers to the scene, which must outlive it and have a graph. Const calls are safe from any number of threads.
class MoveSet {
  public:
    /// `turn_rate` as in CrowdRun; none: as in the scene's crowd, or without one kDefaultTurnRate. Throws
    /// std::invalid_argument if it is out of range.
    explicit MoveSet(const FittedScene& fitted, std::optional<double> turn_rate = {},
                     QueriedBy queried_by = QueriedBy::blocks);

    const FittedScene& fitted() const { return *fitted_; }
    const MotionGraph& graph() const { return *fitted_->scene().graph; }
    double turn_rate() const { return turn_rate_; }
    /// A clip that is none of the moves', as it is asked in a crowd of these.
    PlayableClip playable(const mobb::ClipPtr& clip) const;

    std::size_t count() const { return moves_.size(); }
    /// The moves that are no variants: indices into the graph's.
    const std::vector<int>& unturned() const { return unturned_; }
    /// Of which move it is a variant, or itself, and how far it is turned.
    const PlannedMove& origin(int move) const { return at(move).origin; }
    /// A move turned; none if it lasts too short for it. Where agents turn at once it is the move itself.
    std::optional<int> turned(const PlannedMove& wanted) const;
    /// The graph's move that this one is, or that it is a variant of: what has its hubs and its entry.
    const GraphMove& move(int move) const { return graph().moves[static_cast<std::size_t>(origin(move).move)]; }
    const PlayableClip& clip(int move) const { return at(move).clip; }
    const Stance& exit(int move) const { return at(move).exit; }
    /// Of the heading at the exit.
    const mobb::Rotation& exit_rotation(int move) const { return at(move).exit_rotation; }
    /// Metres: of the circle that an agent walks who goes on as fast as the move ends and turns as fast as the turn
    /// rate allows from move to move. None where agents turn at once, or never.
    std::optional<double> turning_radius(int move) const { return at(move).turning_radius; }
    /// Seconds from a move's begin until the next one begins.
    double until_next(int move) const { return clip(move).clip().until_next(); }
    /// Whether it is linear: from its last sample it runs on to the next move, over one dt.
    bool runs_on(int move) const { return clip(move).blocks.is_linear(); }
    /// Seconds from a move's begin until it runs on, or if it does not until the next one begins.
    double until_joint(int move) const {
        const mobb::Clip& clip = this->clip(move).clip();
        return runs_on(move) ? (clip.count() - 1) * clip.dt() : clip.until_next();
    }
    /// The moves that begin in the hub where `move` ends, none of them turned.
    const std::vector<int>& after(int move) const { return by_hub_[static_cast<std::size_t>(this->move(move).to)]; }
    /// The same, those first that take least room: floor times seconds.
    const std::vector<int>& after_by_room(int move) const {
        return by_room_[static_cast<std::size_t>(this->move(move).to)];
    }
    /// A move that may follow another, turned, with what a plan looks at first.
    struct Follower {
        PlannedMove planned;
        int played;          ///< the move turned so
        std::size_t number;  ///< of the move itself among those of after_by_room
        mobb::Disk last;     ///< of the clip
    };
    /// What holds moves that may follow, until what follows them: each disk, and the disk that stands where a move
    /// ends.
    struct Room {
        FloorRect bounds;
        double begin = 0, end = 0;  ///< global seconds
    };
    /// Followers in a group: in a larger one, moves that take little room would share it with moves that take much.
    static constexpr std::size_t kMostTogether = 16;
    /// Some that turn alike: they are near each other.
    struct FollowerGroup {
        std::vector<Follower> moves;  ///< 1 to kMostTogether
        Room room;                    ///< after a move that ends at 0, at the origin, along +x
    };
    /// Each of after_by_room by each of kTurns that it can turn by: all that turn least first, each time in that order.
    const std::vector<FollowerGroup>& followers(int move) const {
        return followers_[static_cast<std::size_t>(this->move(move).to)];
    }
    /// The room of a group of followers where the move before is placed, and of the joints that lead to them.
    Room room_after(int move, const mobb::Placement& placed, const Room& room) const;
    /// Of all followers that turn by no more than that.
    Room room_after(int move, const mobb::Placement& placed, double most_turn_deg) const;

    /// Where `next` is placed after `before`.
    mobb::Placement following(int before, const mobb::Placement& placed, const PlannedMove& next) const;
    /// Whether that depends on how far `next` turns: where agents turn at once.
    bool turns_at_once() const { return turn_rate_ == kTurnsAtOnce; }
    /// A move as an agent's play.
    PlayedMove motion(int agent, int play, int move, const mobb::Placement& placed) const {
        return {agent, play, move, clip(move), placed};
    }
    /// What a move that runs on, and is placed, does from its last sample until the next one begins: a linear clip of
    /// two samples, of one dt. `turn_deg` counts where agents turn at once: before `next`. It is made when it is asked
    /// for first, and kept. Requires runs_on(before).
    PlayedMove joint(int agent, int play, int before, const mobb::Placement& placed, int next, double turn_deg) const;
    /// The same in front of a play.
    PlayedMove joint(int agent, int play, const Play& before, const Play& next) const;
    /// The moves that are planned to follow an agent's play, each behind the joint that leads to it, if there is one.
    std::vector<PlayedMove> planned(int agent, int index, const Play& play) const;

    /// The scene with those of `used` that its graph has not behind the graph's moves, in order, each with a clip of
    /// its own; and without its crowd.
    struct Extended {
        Scene scene;
        std::vector<int> index;  ///< of each move in that scene's graph; -1 of those that are not in it
    };
    Extended extended(std::span<const int> used, TurnedSkeletons skeletons = TurnedSkeletons::made) const;

  private:
    struct Move {
        Move(const PlannedMove& of, PlayableClip playable, const Stance& end, double turn_rate);

        PlannedMove origin;
        PlayableClip clip;
        Stance exit;
        mobb::Rotation exit_rotation;
        std::optional<double> turning_radius;
    };

    static constexpr std::size_t kHeadings = 25;  ///< from -180 to 180 degrees
    using ByHeading = std::array<int, kHeadings>;

    /// Joints that were asked for, by the move before, the one that they lead to and, where agents turn at once, the
    /// turn.
    struct Joints {
        std::mutex mutex;
        std::map<std::tuple<int, int, double>, PlayableClip> made;
    };

    const Move& at(int move) const { return moves_[static_cast<std::size_t>(move)]; }
    const PlayableClip& joint_of(int before, const PlannedMove& next) const;
    void add_turned();
    Room room_of(const std::vector<Follower>& moves) const;
    std::vector<FollowerGroup> turned_each_way(const std::vector<int>& moves) const;
    std::optional<Move> turned_move(const PlannedMove& origin) const;

    const FittedScene* fitted_;
    double turn_rate_;
    QueriedBy queried_by_;
    std::vector<Move> moves_;
    std::vector<ByHeading> turned_;  ///< by the graph's move: its variants; -1: there is none
    std::vector<int> unturned_;
    std::vector<std::vector<int>> by_hub_;
    std::vector<std::vector<int>> by_room_;
    std::vector<std::vector<FollowerGroup>> followers_;
    std::unique_ptr<Joints> joints_ = std::make_unique<Joints>();
};

/// Where the moves that may follow another are placed, each worked out when it is asked for first. Refers to what it is
/// given, which must outlive it.
class FollowingPlacements {
  public:
    explicit FollowingPlacements(const MoveSet& moves) : moves_(moves) {}

    /// Begins anew, with moves that are not turned, such as MoveSet::after gives.
    void start(int before, const mobb::Placement& placed, const std::vector<int>& next) {
        before_ = before;
        placed_ = placed;
        next_ = next;
        states_.assign(next.size(), State::unknown);
        if (found_.size() < next.size()) found_.resize(next.size());
    }

    /// Of the one with that index among `next`, turned; null where it leads beyond what can be placed.
    const mobb::Placement* at(std::size_t index, double turn_deg) {
        // It is the same however far a move turns on its way.
        if (states_[index] == State::unknown || moves_.turns_at_once()) {
            found_[index] = moves_.following(before_, placed_, {next_[index], turn_deg});
            states_[index] = mobb::is_valid(found_[index]) ? State::valid : State::invalid;
        }
        return states_[index] == State::valid ? &found_[index] : nullptr;
    }

  private:
    enum class State : unsigned char { unknown, valid, invalid };

    const MoveSet& moves_;
    int before_ = 0;
    mobb::Placement placed_;
    std::span<const int> next_;
    std::vector<State> states_;
    std::vector<mobb::Placement> found_;  ///< of those that are known; the memory is used again
};

}  // namespace mobbscope
