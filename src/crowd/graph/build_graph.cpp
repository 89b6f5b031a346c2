#include <base/error.h>
#include <base/file.h>
#include <base/random.h>
#include <base/text.h>
#include <crowd/graph/build_graph.h>
#include <crowd/graph/cut_search.h>
#include <crowd/graph/hub_choice.h>
#include <scene/load_files.h>
#include <scene/motion_graph.h>
#include <scene/scene_edits.h>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace mobbscope {

namespace {

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

std::string letters(std::size_t index) {
    std::string out(1, static_cast<char>('A' + index % 26));
    return index < 26 ? out : letters(index / 26 - 1) + out;
}

std::string two_decimals(double value) { return formatted("%.2f", value); }

class Builder {
  public:
    Builder(const Scene& scene, const GraphOptions& options, const Progress& progress)
        : scene_(scene), options_(options), progress_(progress), recordings_(recordings_of(scene, rigs_)) {}

    BuiltGraph build() {
        BuiltGraph out;
        report_.recordings = scene_.clips.size();
        report_.without_joints = scene_.clips.size() - recordings_.size();
        report_.rigs = static_cast<std::size_t>(rigs_.count());
        for (const Recording& recording : recordings_) report_.seconds += recording.track.frames() * recording.track.dt;
        find_hubs();
        choose_moves();
        drop_dead_ends();
        out.scene = written();
        out.report = report_;
        return out;
    }

  private:
    void find_hubs() {
        std::vector<std::vector<HubMoment>> moments;
        std::size_t all = 0;
        for (int rig = 0; rig < rigs_.count(); ++rig) {
            moments.push_back(draw_moments(recordings_, rig, options_));
            all += moments.back().size();
        }
        std::size_t done = 0;
        for (const std::vector<HubMoment>& of_rig : moments) {
            std::vector<Hub> candidates(of_rig.size());
            for (std::size_t begin = 0; begin < of_rig.size(); begin += kBatch) {
                if (progress_) progress_(done + begin, all);
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
        std::vector<std::pair<int, int>> edges;
        for (const Piece& move : moves_) edges.emplace_back(move.from, move.to);
        const std::vector<int> component = strong_components(static_cast<int>(hubs_.size()), edges);
        std::map<int, int> moves_in;
        const auto within = [&](const Piece& move) {
            const int from = component[static_cast<std::size_t>(move.from)];
            return from == component[static_cast<std::size_t>(move.to)] ? from : -1;
        };
        for (const Piece& move : moves_) ++moves_in[within(move)];
        std::vector<int> number(hubs_.size(), -1);
        std::vector<Hub> hubs;
        for (std::size_t h = 0; h < hubs_.size(); ++h) {
            if (moves_in[component[h]] < options_.least_moves) continue;
            number[h] = static_cast<int>(hubs.size());
            hubs.push_back(std::move(hubs_[h]));
        }
        std::vector<Piece> moves;
        for (Piece move : moves_) {
            if (within(move) < 0 || number[static_cast<std::size_t>(move.from)] < 0) continue;
            move.from = number[static_cast<std::size_t>(move.from)];
            move.to = number[static_cast<std::size_t>(move.to)];
            moves.push_back(move);
        }
        report_.dead_ends = moves_.size() - moves.size();
        report_.dropped_hubs = hubs_.size() - hubs.size();
        hubs_ = std::move(hubs);
        moves_ = std::move(moves);
    }

    Stance stance(const Cut& cut) const {
        const PoseTrack& track = recordings_[static_cast<std::size_t>(cut.recording)].track;
        return {track.root[static_cast<std::size_t>(cut.frame)], cut.heading_deg};
    }

    /// The samples from the first cut up to the one before the second.
    SceneClip part(const Piece& piece, UnusedNames& names) const {
        const Recording& recording = recordings_[static_cast<std::size_t>(piece.begin.recording)];
        const SceneClip& whole = scene_.clips[static_cast<std::size_t>(recording.clip)];
        const double dt = recording.track.dt;
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
        clip.options.unit = short_or_exact(whole.facts.unit);
        if (leads_to_root(*whole.skeleton, whole.facts.root)) clip.options.root = whole.facts.root;
        const auto samples = whole.clip->samples().subspan(
            static_cast<std::size_t>(piece.begin.frame), static_cast<std::size_t>(piece.end.frame - piece.begin.frame));
        clip.clip = std::make_shared<mobb::Clip>(dt, std::vector<mobb::Disk>(samples.begin(), samples.end()),
                                                 whole.clip->motion());
        clip.facts = whole.facts;
        clip.facts.warnings.clear();
        auto skeleton = std::make_shared<Skeleton>();
        skeleton->joints = whole.skeleton->joints;
        skeleton->root = whole.skeleton->root;
        skeleton->rest = whole.skeleton->rest;
        for (int f = piece.begin.frame; f < piece.end.frame; ++f) {
            const auto pose = whole.skeleton->at(f);
            skeleton->positions.insert(skeleton->positions.end(), pose.begin(), pose.end());
            const auto rotations = whole.skeleton->rotations_at(f);
            skeleton->rotations.insert(skeleton->rotations.end(), rotations.begin(), rotations.end());
        }
        clip.skeleton = std::move(skeleton);
        return clip;
    }

    /// Of joints that share a name the first is found by it.
    static bool leads_to_root(const Skeleton& skeleton, const std::string& name) {
        const auto found = std::find_if(skeleton.joints.begin(), skeleton.joints.end(),
                                        [&](const Joint& joint) { return joint.name == name; });
        return found - skeleton.joints.begin() == skeleton.root;
    }

    static std::string short_or_exact(double unit) {
        const std::string text = short_double(unit);
        return parse_double(text) == unit ? text : format_double(unit);
    }

    Scene written() const {
        Scene out;
        out.file = scene_.file;
        out.fit = scene_.fit;
        auto graph = std::make_shared<MotionGraph>();
        graph->bounds = options_.bounds;
        for (std::size_t h = 0; h < hubs_.size(); ++h) graph->hubs.push_back({letters(h)});
        UnusedNames names;
        for (const Piece& move : moves_) {
            graph->moves.push_back(
                {static_cast<int>(out.clips.size()), move.from, move.to, stance(move.begin), stance(move.end)});
            out.clips.push_back(part(move, names));
        }
        out.graph = std::move(graph);
        return out;
    }

    const Scene& scene_;
    const GraphOptions& options_;
    const Progress& progress_;
    Rigs rigs_;
    std::vector<Recording> recordings_;
    std::vector<Hub> hubs_;
    std::vector<Piece> moves_;
    BuildReport report_;
};

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

bool is_near(const Stance& stance) {
    return std::abs(stance.position.x) <= kMostStance && std::abs(stance.position.y) <= kMostStance;
}

void check_move(const Scene& scene, const GraphMove& move) {
    const SceneClip& clip = scene.clips[static_cast<std::size_t>(move.clip)];
    if (is_near(move.entry) && is_near(move.exit)) return;
    throw InputError(clip.source.value_or(scene.file.string()), "clip " + in_quotes(clip.name),
                     "begins or ends more than " + short_double(kMostStance) + " m from the origin; move it there");
}

}  // namespace

std::vector<std::filesystem::path> clip_files(const std::vector<std::filesystem::path>& places) {
    std::vector<std::filesystem::path> out;
    for (const std::filesystem::path& place : places) {
        std::error_code ignored;
        if (std::filesystem::is_directory(place, ignored)) {
            for (std::filesystem::path& file : clips_in(place, true)) out.push_back(std::move(file));
        } else if (lower_extension(place) == ".json") {
            throw InputError(place.string(), "", "a graph is built from clip files; name those of the scene");
        } else {
            out.push_back(place);
        }
    }
    return out;
}

Scene load_recordings(const std::vector<std::filesystem::path>& files, const std::filesystem::path& scene_file,
                      const ImportOptions& options, const Progress& progress) {
    Scene scene = load_files(files, options, progress);
    move_to_file(scene, scene_file);
    return scene;
}

BuiltGraph build_graph(const Scene& recordings, const GraphOptions& options, const std::string& place,
                       const Progress& progress) {
    check_options(options);
    BuiltGraph out = Builder(recordings, options, progress).build();
    if (out.report.without_joints == out.report.recordings) {
        throw InputError(place, "", "no clip has joints, so no pose can be compared; give motion files, or --whole");
    }
    if (out.scene.graph->moves.empty()) {
        throw InputError(place, "",
                         "no pose comes again often enough; allow more with --pose-distance and --root-speed, or take "
                         "clips as they are with --whole");
    }
    return out;
}

std::vector<std::size_t> different_pieces(const std::vector<Recording>& recordings, const std::vector<Piece>& pieces,
                                          std::size_t most) {
    if (pieces.empty()) return {};
    std::vector<Course> courses;
    for (const Piece& piece : pieces) courses.push_back(course_of(recordings, piece));
    const auto to_hubs = [](const Piece& piece) { return piece.begin.distance + piece.end.distance; };
    const auto best = std::min_element(pieces.begin(), pieces.end(),
                                       [&](const Piece& a, const Piece& b) { return to_hubs(a) < to_hubs(b); });
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
    return graph;
}

}  // namespace mobbscope
