#include <base/error.h>
#include <base/file.h>
#include <base/random.h>
#include <base/text.h>
#include <base/threads.h>
#include <crowd/graph/build_graph.h>
#include <crowd/graph/continuity.h>
#include <crowd/graph/graph_figures.h>
#include <crowd/graph/rigs.h>
#include <import/skeleton/warp.h>
#include <scene/arrangement.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

namespace mobbscope {

namespace {

// Faster motion than that is noise, and joints of every frame are kept.
constexpr double kMostRate = 1000;  // samples per second
constexpr int kFramesApart = 5;     // of moments looked at as hubs, at least
constexpr std::size_t kBatch = 32;  // of those looked at between two reports of progress

void check_options(const GraphOptions& options) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw std::invalid_argument(what);
    };
    require(options.bounds.pose_distance >= 0 && options.bounds.root_speed >= 0, "a bound must be 0 or more");
    require(options.least_seconds > 0, "the least seconds of a move must be over 0");
    require(options.most_seconds >= options.least_seconds && std::isfinite(options.most_seconds),
            "the most seconds of a move must be at least the least");
    require(options.warp >= 0 && std::isfinite(options.warp), "the seconds of a warp must be 0 or more");
    require(options.hubs >= 1 && options.moves >= 1 && options.candidates >= 1 && options.least_moves >= 1,
            "counts must be at least 1");
}

/// Moments of a rig, spread evenly over its recordings, each drawn at random from its share.
std::vector<HubMoment> draw_moments(const std::vector<Recording>& recordings, int rig, const GraphOptions& options) {
    std::vector<std::pair<int, int>> usable;
    for (std::size_t r = 0; r < recordings.size(); ++r) {
        if (recordings[r].track.rig != rig) continue;
        for (int f = recordings[r].first; f < recordings[r].end; ++f) usable.emplace_back(static_cast<int>(r), f);
    }
    const std::size_t count =
        std::min(static_cast<std::size_t>(options.candidates), (usable.size() + kFramesApart - 1) / kFramesApart);
    Uniform random(options.seed);
    std::vector<HubMoment> out;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = i * usable.size() / count;
        const std::size_t to = (i + 1) * usable.size() / count;
        const auto [recording, frame] = usable[from + random.next() % (to - from)];
        out.push_back(hub_moment(recordings, recording, frame));
    }
    return out;
}

/// Of moves that lead from hub to hub, which stay: those within a part, all of whose hubs lead to each other, of at
/// least so many moves.
std::vector<bool> moves_that_go_on(std::size_t hubs, const std::vector<std::pair<int, int>>& moves, int least_moves) {
    const std::vector<int> component = strong_components(static_cast<int>(hubs), moves);
    std::map<int, int> moves_in;
    const auto within = [&](const std::pair<int, int>& move) {
        const int from = component[static_cast<std::size_t>(move.first)];
        return from == component[static_cast<std::size_t>(move.second)] ? from : -1;
    };
    for (const auto& move : moves) ++moves_in[within(move)];
    std::vector<bool> out;
    for (const auto& move : moves) out.push_back(within(move) >= 0 && moves_in[within(move)] >= least_moves);
    return out;
}

/// Leaves the moves that `keep` says, and the hubs that these join, numbered anew.
template <class Move, class JoinedHub>
void keep_moves(std::vector<Move>& moves, std::vector<JoinedHub>& hubs, const std::vector<bool>& keep) {
    std::vector<Move> kept;
    std::vector<bool> joined(hubs.size(), false);
    for (std::size_t m = 0; m < moves.size(); ++m) {
        if (!keep[m]) continue;
        joined[static_cast<std::size_t>(moves[m].from)] = true;
        joined[static_cast<std::size_t>(moves[m].to)] = true;
        kept.push_back(moves[m]);
    }
    std::vector<int> number(hubs.size(), -1);
    std::vector<JoinedHub> left;
    for (std::size_t h = 0; h < hubs.size(); ++h) {
        if (!joined[h]) continue;
        number[h] = static_cast<int>(left.size());
        left.push_back(std::move(hubs[h]));
    }
    for (Move& move : kept) {
        move.from = number[static_cast<std::size_t>(move.from)];
        move.to = number[static_cast<std::size_t>(move.to)];
    }
    moves = std::move(kept);
    hubs = std::move(left);
}

/// From hub to hub.
template <class Move>
std::vector<std::pair<int, int>> edges_of(const std::vector<Move>& moves) {
    std::vector<std::pair<int, int>> out;
    for (const Move& move : moves) out.emplace_back(move.from, move.to);
    return out;
}

std::string letters(std::size_t index) {
    std::string out(1, static_cast<char>('A' + index % 26));
    return index < 26 ? out : letters(index / 26 - 1) + out;
}

std::string two_decimals(double value) { return formatted("%.2f", value); }

class Builder {
  public:
    Builder(const Scene& scene, const GraphOptions& options, const Progress& progress)
        : scene_(scene),
          options_(options),
          progress_(progress),
          rigs_(rigs_of(scene)),
          recordings_(recordings_of(scene, rigs_)) {}

    BuiltGraph build() {
        BuiltGraph out;
        report_.recordings = scene_.clips.size();
        for (const SceneClip& clip : scene_.clips) {
            if (!clip.skeleton) ++(clip.facts.joints > 0 ? report_.too_long : report_.without_joints);
        }
        report_.rigs = rigs_.rigs.size();
        for (const Recording& recording : recordings_) report_.seconds += recording.track.frames() * recording.track.dt;
        find_hubs();
        choose_moves();
        drop_dead_ends();
        find_poses();
        out.scene = written();
        out.report = report_;
        return out;
    }

  private:
    void find_hubs() {
        std::vector<std::vector<HubMoment>> moments;
        std::size_t all = 0;
        for (int rig = 0; rig < static_cast<int>(rigs_.rigs.size()); ++rig) {
            moments.push_back(draw_moments(recordings_, rig, options_));
            all += moments.back().size();
        }
        std::size_t done = 0;
        for (const std::vector<HubMoment>& of_rig : moments) {
            std::vector<Hub> candidates(of_rig.size());
            for (std::size_t begin = 0; begin < of_rig.size(); begin += kBatch) {
                if (progress_) progress_(done + begin, all);
                limit_worker_threads();
                tbb::parallel_for(begin, std::min(begin + kBatch, of_rig.size()), [&](std::size_t i) {
                    candidates[i] = {of_rig[i], cuts_like(recordings_, of_rig[i], options_.bounds)};
                });
            }
            done += of_rig.size();
            const std::vector<Hub> chosen = choose_hubs(recordings_, candidates, options_);
            if (chosen.empty()) ++report_.rigs_left_out;
            hubs_.insert(hubs_.end(), chosen.begin(), chosen.end());
        }
    }

    void choose_moves() {
        std::map<std::pair<int, int>, std::vector<Piece>> by_hubs;
        for (const Piece& piece : pieces_between(recordings_, hubs_, options_)) {
            by_hubs[{piece.from, piece.to}].push_back(piece);
            ++report_.pieces;
        }
        for (const auto& [unused, pieces] : by_hubs) {
            const auto kept = different_pieces(recordings_, pieces, static_cast<std::size_t>(options_.moves));
            for (const std::size_t i : kept) moves_.push_back(pieces[i]);
            report_.alike += pieces.size() - kept.size();
        }
    }

    void drop_dead_ends() {
        const std::size_t moves = moves_.size();
        const std::size_t hubs = hubs_.size();
        keep_moves(moves_, hubs_, moves_that_go_on(hubs, edges_of(moves_), options_.least_moves));
        report_.dead_ends = moves - moves_.size();
        report_.dropped_hubs = hubs - hubs_.size();
    }

    /// Of each hub the mean of the poses in which moves begin and end there.
    void find_poses() {
        std::vector<std::map<std::pair<int, int>, const Cut*>> cuts(hubs_.size());  // each once, in one order
        for (const Piece& move : moves_) {
            const auto add = [&](int hub, const Cut& cut) {
                cuts[static_cast<std::size_t>(hub)].emplace(std::pair(cut.recording, cut.frame), &cut);
            };
            add(move.from, move.begin);
            add(move.to, move.end);
        }
        for (const auto& of_hub : cuts) {
            std::vector<MovingPose> poses;
            for (const auto& [unused, cut] : of_hub) {
                const SceneClip& clip = recorded(cut->recording);
                poses.push_back(moving_pose(*clip.clip, *clip.skeleton, cut->frame, cut->heading_deg));
            }
            poses_.push_back(std::make_shared<const MovingPose>(mean(poses)));
        }
    }

    const SceneClip& recorded(int recording) const {
        return scene_.clips[static_cast<std::size_t>(recordings_[static_cast<std::size_t>(recording)].clip)];
    }

    WarpEnd warp_end(int hub, const Cut& cut) const {
        const auto at = static_cast<std::size_t>(hub);
        return {letters(at), poses_[at], cut.heading_deg};
    }

    Stance stance(const Cut& cut) const {
        const PoseTrack& track = recordings_[static_cast<std::size_t>(cut.recording)].track;
        return {track.root[static_cast<std::size_t>(cut.frame)], cut.heading_deg};
    }

    /// The samples from the first cut up to the one before the second.
    SceneClip part(const Piece& piece, UnusedNames& names) const {
        const SceneClip& whole = recorded(piece.begin.recording);
        const double dt = whole.clip->dt();
        const double file_begin = whole.options.trim ? whole.options.trim->first : 0;
        const double begin = file_begin + piece.begin.frame * dt;
        const double end = file_begin + piece.end.frame * dt;

        SceneClip clip;
        clip.name = names.take(whole.name + ' ' + two_decimals(begin) + '-' + two_decimals(end));
        clip.source = whole.source;
        clip.options = whole.options;
        // Half a step short: the frame at the end is the first of the move that follows.
        clip.options.trim = {begin, end - dt / 2};
        // What was found out from all of the recording must not be sought in a part.
        clip.options.unit = format_double(whole.facts.unit);
        if (is_utf8(whole.facts.root) && leads_to_root(*whole.skeleton, whole.facts.root))
            clip.options.root = whole.facts.root;
        clip.facts = whole.facts;
        clip.facts.warnings.clear();
        if (options_.warp > 0) {
            clip.warp = std::make_shared<const ClipWarp>(
                ClipWarp{options_.warp, warp_end(piece.from, piece.begin), warp_end(piece.to, piece.end)});
            WarpedClip made = warped(*frames_of(*whole.clip, piece.begin.frame, piece.end.frame + 1),
                                     frames_of(*whole.skeleton, piece.begin.frame, piece.end.frame + 1), *clip.warp,
                                     whole.options.radius.has_value());
            clip.clip = std::move(made.clip);
            clip.skeleton = std::move(made.skeleton);
        } else {
            clip.clip = frames_of(*whole.clip, piece.begin.frame, piece.end.frame);
            clip.skeleton =
                std::make_shared<const Skeleton>(frames_of(*whole.skeleton, piece.begin.frame, piece.end.frame));
        }
        return clip;
    }

    static mobb::ClipPtr frames_of(const mobb::Clip& clip, int first, int end) {
        const auto samples =
            clip.samples().subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
        return std::make_shared<const mobb::Clip>(clip.dt(), std::vector<mobb::Disk>(samples.begin(), samples.end()),
                                                  clip.motion());
    }

    static Skeleton frames_of(const Skeleton& skeleton, int first, int end) {
        Skeleton out{skeleton.joints, skeleton.root, {}, {}, skeleton.rest};
        for (int f = first; f < end; ++f) {
            const auto pose = skeleton.at(f);
            out.positions.insert(out.positions.end(), pose.begin(), pose.end());
            const auto rotations = skeleton.rotations_at(f);
            out.rotations.insert(out.rotations.end(), rotations.begin(), rotations.end());
        }
        return out;
    }

    /// Of joints that share a name the first is found by it.
    static bool leads_to_root(const Skeleton& skeleton, const std::string& name) {
        return std::ranges::find(skeleton.joints, name, &Joint::name) - skeleton.joints.begin() == skeleton.root;
    }

    Scene written() const {
        Scene out;
        out.file = scene_.file;
        out.fit = scene_.fit;
        auto graph = std::make_shared<MotionGraph>();
        graph->bounds = options_.bounds;
        for (std::size_t h = 0; h < hubs_.size(); ++h) graph->hubs.push_back({letters(h)});
        SceneRigs of_scene{rigs_.rigs, {}};
        UnusedNames names;
        for (const Piece& move : moves_) {
            const Recording& recording = recordings_[static_cast<std::size_t>(move.begin.recording)];
            // The rig's number is of the scene that is read; set_rigs numbers those that are used.
            of_scene.of_clip.push_back(recording.track.rig);
            graph->moves.push_back(
                {static_cast<int>(out.clips.size()), move.from, move.to, stance(move.begin), stance(move.end)});
            out.clips.push_back(part(move, names));
        }
        set_rigs(*graph, of_scene);
        out.graph = std::move(graph);
        return out;
    }

    const Scene& scene_;
    const GraphOptions& options_;
    const Progress& progress_;
    SceneRigs rigs_;
    std::vector<Recording> recordings_;
    std::vector<Hub> hubs_;
    std::vector<Piece> moves_;
    std::vector<std::shared_ptr<const MovingPose>> poses_;  ///< by hub
    BuildReport report_;
};

/// Of the graph's moves, which stay so that no transition breaks a bound. `jumps`: those that break what warped moves
/// promise.
std::vector<bool> moves_without_breaks(const MotionGraph& graph, const Transitions& measured,
                                       const std::vector<bool>& jumps) {
    std::vector<std::vector<std::size_t>> breaks_with(graph.moves.size());  // of each move, the moves on the other side
    for (std::size_t i = 0; i < measured.moves.size(); ++i) {
        if (!exceeds(measured.pose_distance[i], graph.bounds.pose_distance) &&
            !exceeds(measured.root_speed[i], graph.bounds.root_speed) && !jumps[i]) {
            continue;
        }
        const auto before = static_cast<std::size_t>(measured.moves[i].first);
        const auto after = static_cast<std::size_t>(measured.moves[i].second);
        breaks_with[before].push_back(after);
        if (before != after) breaks_with[after].push_back(before);
    }
    std::vector<std::size_t> breaks;
    for (const auto& others : breaks_with) breaks.push_back(others.size());
    std::vector<bool> keep(graph.moves.size(), true);
    while (true) {
        const auto worst = std::max_element(breaks.begin(), breaks.end());
        if (worst == breaks.end() || *worst == 0) return keep;
        const auto move = static_cast<std::size_t>(worst - breaks.begin());
        keep[move] = false;
        for (const std::size_t other : breaks_with[move]) {
            if (keep[other]) --breaks[other];
        }
        breaks[move] = 0;
    }
}

/// The order of two lists by that of their elements.
auto in_turn(const auto& a, const auto& b, const auto& order) {
    return std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end(), order);
}

/// By what clips hold, not by their names: the same motion has the same place whatever its file is called.
std::partial_ordering content_order(const SceneClip& a, const SceneClip& b) {
    if (const auto order = a.clip->dt() <=> b.clip->dt(); order != 0) return order;
    const auto disks = in_turn(a.clip->samples(), b.clip->samples(), [](const mobb::Disk& p, const mobb::Disk& q) {
        return std::tuple(p.x, p.y, p.r) <=> std::tuple(q.x, q.y, q.r);
    });
    if (disks != 0 || !a.skeleton || !b.skeleton)
        return disks != 0 ? disks : (a.skeleton != nullptr) <=> (b.skeleton != nullptr);
    const auto poses = in_turn(
        a.skeleton->positions, b.skeleton->positions,
        [](const glm::vec3& p, const glm::vec3& q) { return std::tuple(p.x, p.y, p.z) <=> std::tuple(q.x, q.y, q.z); });
    if (poses != 0) return poses;
    return in_turn(a.skeleton->joints, b.skeleton->joints, [](const Joint& p, const Joint& q) {
        return std::tie(p.name, p.parent, p.end_site) <=> std::tie(q.name, q.parent, q.end_site);
    });
}

constexpr double kAlikePath = 0.15;      // metres
constexpr double kAlikeHeading = 10;     // degrees
constexpr double kAlikeDuration = 0.15;  // seconds
constexpr std::size_t kPlaces = 5;  // at which paths are compared, at equal shares of their time; the last is the end

struct Course {
    std::array<glm::dvec2, kPlaces> places;  // metres, from the hub that the piece begins in
    double turn_deg;
    double seconds;
};

Course course_of(const std::vector<Recording>& recordings, const Piece& piece) {
    const PoseTrack& track = recordings[static_cast<std::size_t>(piece.begin.recording)].track;
    const mobb::Rotation turn = mobb::Rotation::from_degrees(-piece.begin.heading_deg);
    const int frames = piece.end.frame - piece.begin.frame;
    Course course{{}, piece.end.heading_deg - piece.begin.heading_deg, frames * track.dt};
    const glm::dvec2 begin = track.root[static_cast<std::size_t>(piece.begin.frame)];
    for (std::size_t k = 0; k < kPlaces; ++k) {
        const int frame = piece.begin.frame + static_cast<int>((k + 1) * static_cast<std::size_t>(frames) / kPlaces);
        course.places[k] = turn(track.root[static_cast<std::size_t>(frame)] - begin);
    }
    return course;
}

/// At most 1 if they are alike.
double difference(const Course& a, const Course& b) {
    double most = std::abs(a.seconds - b.seconds) / kAlikeDuration;
    most = std::max(most, std::abs(std::remainder(a.turn_deg - b.turn_deg, 360.0)) / kAlikeHeading);
    for (std::size_t k = 0; k < kPlaces; ++k) {
        most = std::max(most, glm::distance(a.places[k], b.places[k]) / kAlikePath);
    }
    return most;
}

constexpr double kLeastStep = 0.1;  // metres: shorter steps are sway, not a direction

glm::dvec2 center(const mobb::Disk& disk) { return {disk.x, disk.y}; }

double distance(glm::dvec2 a, glm::dvec2 b) { return std::hypot(b.x - a.x, b.y - a.y); }

Stance stance_at_begin(const mobb::Clip& clip) {
    const auto samples = clip.samples();
    const glm::dvec2 first = center(samples.front());
    for (const mobb::Disk& disk : samples) {
        if (distance(first, center(disk)) >= kLeastStep) return {first, heading_of(center(disk) - first)};
    }
    return {first, 0};
}

Stance stance_at_end(const mobb::Clip& clip) {
    const auto samples = clip.samples();
    const glm::dvec2 last = center(samples.back());
    // The pose after the last sample: one more step like the last one.
    const glm::dvec2 step = samples.size() > 1 ? last - center(samples[samples.size() - 2]) : glm::dvec2{0};
    for (std::size_t i = samples.size(); i-- > 0;) {
        if (distance(center(samples[i]), last) >= kLeastStep)
            return {last + step, heading_of(last - center(samples[i]))};
    }
    return {last + step, stance_at_begin(clip).heading_deg};
}

/// Throws InputError for motion that is sampled more often than a graph can use.
void check_rate(const Scene& scene) {
    for (const SceneClip& clip : scene.clips) {
        const double rate = 1 / clip.clip->dt();
        if (clip.facts.joints == 0 || rate <= kMostRate * (1 + 1e-6)) continue;
        throw InputError(scene.file.string(), "clip " + in_quotes(clip.name),
                         "has " + brief(rate) + " samples a second; graphs are built from up to " + brief(kMostRate) +
                             ": lower --fps");
    }
}

bool is_near(const Stance& stance) {
    return std::abs(stance.position.x) <= kMostStance && std::abs(stance.position.y) <= kMostStance;
}

void check_move(const Scene& scene, const GraphMove& move) {
    const SceneClip& clip = scene.clips[static_cast<std::size_t>(move.clip)];
    if (is_near(move.entry) && is_near(move.exit)) return;
    throw InputError(clip.source.value_or(scene.file.string()), "clip " + in_quotes(clip.name),
                     "begins or ends more than " + format_double(kMostStance) + " m from the origin; move it there");
}

/// The clips of files as one scene. Paths decide where the content does not: files are in their order.
Scene in_content_order(std::vector<Scene> files, const std::filesystem::path& scene_file) {
    std::stable_sort(files.begin(), files.end(),
                     [](const Scene& a, const Scene& b) { return in_turn(a.clips, b.clips, content_order) < 0; });
    Scene out;
    for (Scene& of_file : files) merge(out, std::move(of_file));
    lay_out_clips(out);
    move_to_file(out, scene_file);
    return out;
}

}  // namespace

std::vector<ClipFile> clip_files(const std::vector<std::filesystem::path>& places) {
    std::vector<ClipFile> all;
    for (const std::filesystem::path& place : places) {
        std::error_code ignored;
        if (std::filesystem::is_directory(place, ignored)) {
            std::vector<UnreadableFolder> unreadable;
            for (std::filesystem::path& file : clips_in(place, &unreadable)) all.push_back({std::move(file), true});
            for (UnreadableFolder& of : unreadable) all.push_back({std::move(of.folder), true, std::move(of.why)});
        } else if (lower_extension(place) == ".json") {
            throw InputError(place, "a graph is built from clip files; name those of the scene");
        } else {
            all.push_back({place, false});
        }
    }
    std::ranges::sort(all, {}, [](const ClipFile& file) { return std::pair(whole_path(file.path), file.path); });
    std::vector<ClipFile> out;
    std::map<std::filesystem::path, std::size_t> known;  // by the file that is meant
    for (ClipFile& file : all) {
        std::error_code unknown;
        std::filesystem::path meant = std::filesystem::canonical(file.path, unknown);
        if (unknown) meant = whole_path(file.path);
        const auto [same, is_new] = known.try_emplace(std::move(meant), out.size());
        if (is_new) {
            out.push_back(std::move(file));
        } else if (!file.in_folder) {
            out[same->second].in_folder = false;
        }
    }
    return out;
}

Recordings load_recordings(const std::vector<ClipFile>& files, const std::filesystem::path& scene_file,
                           const ImportOptions& options, bool strict, const Progress& progress) {
    std::vector<Scene> loaded;
    Recordings out;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (progress) progress(i, files.size());
        try {
            if (!files[i].why_not.empty()) throw InputError(files[i].why_not);
            loaded.push_back(load_scene(files[i].path, options));
        } catch (const InputError& error) {
            if (strict || !files[i].in_folder) throw;
            out.left_out.emplace_back(error.what());
            continue;
        }
        check_rate(loaded.back());
    }
    if (loaded.empty()) {
        const std::size_t others = out.left_out.size() - 1;
        throw InputError(out.left_out.front() +
                         (others > 0 ? "; nor can " + counted(others, "other file", "other files") + " be read" : ""));
    }
    out.scene = in_content_order(std::move(loaded), scene_file);
    return out;
}

Scene recordings_of_clips(const Scene& scene, const std::filesystem::path& scene_file) {
    check_rate(scene);
    std::vector<Scene> files;
    for (const SceneClip& clip : scene.clips) {
        const bool of_same = !files.empty() && clip.source && files.back().clips.back().source == clip.source;
        if (!of_same) files.emplace_back().file = scene.file;
        files.back().clips.push_back(clip);
    }
    Scene out = in_content_order(std::move(files), scene_file);
    out.fit = scene.fit;
    return out;
}

BuiltGraph make_graph(Scene recordings, const GraphOptions& options, const std::string& place,
                      const GraphProgress& progress) {
    refuse_bodies(recordings, "a motion graph");
    if (options.whole) {
        recordings.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(recordings));
        BuiltGraph out{std::move(recordings), {}};
        out.report.recordings = out.scene.clips.size();
        out.report.rigs = out.scene.graph->rigs.size();
        for (const SceneClip& clip : out.scene.clips) out.report.seconds += clip.clip->duration();
        return out;
    }
    const auto progress_in = [&](GraphStage stage) -> Progress {
        if (!progress) return {};
        return [&progress, stage](std::size_t done, std::size_t all) { progress(stage, done, all); };
    };
    BuiltGraph out = build_graph(recordings, options, place, progress_in(GraphStage::comparing));
    check_graph(out, options.least_moves, progress_in(GraphStage::measuring));
    return out;
}

BuiltGraph build_graph(const Scene& recordings, const GraphOptions& options, const std::string& place,
                       const Progress& progress) {
    check_options(options);
    BuiltGraph out = Builder(recordings, options, progress).build();
    if (out.report.too_long > 0 && out.report.without_joints + out.report.too_long == out.report.recordings) {
        throw InputError(place,
                         "every clip with joints has too many samples to keep the joints of each; lower --fps, or give "
                         "--trim");
    }
    if (out.report.without_joints == out.report.recordings) {
        throw InputError(
            place, "no clip has joints, so no pose can be compared; give motion files, or take clips whole (--whole)");
    }
    if (out.scene.graph->moves.empty()) {
        throw InputError(place,
                         "no pose comes again often enough; allow more pose distance and root speed (--pose-distance, "
                         "--root-speed), or take clips whole (--whole)");
    }
    return out;
}

void check_graph(BuiltGraph& built, int least_moves, const Progress& progress) {
    Scene& scene = built.scene;
    const std::string text = to_json(scene);
    raise_budget(text.size());  // as if it were read from its file
    Scene read = parse_scene(text, scene.file.string(), scene.file.parent_path());
    read.file = scene.file;
    const Transitions measured = each_transition(read, progress);
    built.report.joints_checked = measured.moves.size();
    MotionGraph graph = *scene.graph;
    const std::vector<bool> jumps =
        promises_continuity(read) ? joins_over(read, measured.moves) : std::vector<bool>(measured.moves.size(), false);
    std::vector<bool> keep = moves_without_breaks(graph, measured, jumps);
    built.report.broken = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), false));
    if (built.report.broken == 0) return;

    const std::size_t moves = graph.moves.size() - built.report.broken;
    const std::size_t hubs = graph.hubs.size();
    keep_moves(graph.moves, graph.hubs, keep);
    keep_moves(graph.moves, graph.hubs, moves_that_go_on(graph.hubs.size(), edges_of(graph.moves), least_moves));
    built.report.dead_ends += moves - graph.moves.size();
    built.report.dropped_hubs += hubs - graph.hubs.size();

    SceneRigs of_scene{std::move(graph.rigs), {}};
    std::vector<SceneClip> clips;
    for (GraphMove& move : graph.moves) {
        of_scene.of_clip.push_back(move.rig);
        clips.push_back(std::move(scene.clips[static_cast<std::size_t>(move.clip)]));
        move.clip = static_cast<int>(clips.size()) - 1;
    }
    set_rigs(graph, of_scene);
    scene.clips = std::move(clips);
    scene.graph = std::make_shared<MotionGraph>(std::move(graph));
}

std::vector<std::size_t> different_pieces(const std::vector<Recording>& recordings, const std::vector<Piece>& pieces,
                                          std::size_t most) {
    if (pieces.empty()) return {};
    std::vector<Course> courses;
    for (const Piece& piece : pieces) courses.push_back(course_of(recordings, piece));
    const auto to_hubs = [](const Piece& piece) { return piece.begin.distance + piece.end.distance; };
    const auto best = std::ranges::min_element(pieces, {}, to_hubs);
    auto next = static_cast<std::size_t>(best - pieces.begin());
    std::vector<std::size_t> out;
    std::vector<double> to_nearest(pieces.size(), std::numeric_limits<double>::infinity());
    while (out.size() < most) {
        out.push_back(next);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            to_nearest[i] = std::min(to_nearest[i], difference(courses[i], courses[next]));
        }
        next = static_cast<std::size_t>(std::max_element(to_nearest.begin(), to_nearest.end()) - to_nearest.begin());
        if (to_nearest[next] <= 1) break;
    }
    std::sort(out.begin(), out.end());
    return out;
}

MotionGraph graph_of_whole_clips(const Scene& scene) {
    MotionGraph graph;
    graph.hubs = {{"any"}};
    graph.bounds = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < scene.clips.size(); ++i) {
        const mobb::Clip& clip = *scene.clips[i].clip;
        const GraphMove move{static_cast<int>(i), 0, 0, stance_at_begin(clip), stance_at_end(clip)};
        check_move(scene, move);
        graph.moves.push_back(move);
    }
    set_rigs(graph, rigs_of(scene));
    return graph;
}

}  // namespace mobbscope
