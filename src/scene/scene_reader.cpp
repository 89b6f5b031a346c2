// Scene files read: JSON to Scene, with every complaint at its place.
#include <base/budget.h>
#include <base/file.h>
#include <base/input.h>
#include <base/json.h>
#include <base/sentences.h>
#include <base/text.h>
#include <import/clip/held_steps.h>
#include <import/clip/sample_times.h>
#include <import/clip/sampling.h>
#include <import/foreign_files.h>
#include <import/import.h>
#include <mobb/capture.h>
#include <scene/arrangement.h>
#include <scene/clip_import.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>
#include <scene/scene_json.h>
#include <scene/step_link.h>
#include <scene/view_options.h>

#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace mobbscope {

namespace {

constexpr int kVersion = 1;
/// Options over options: what `over` says wins.
ImportOptions merged(ImportOptions base, const ImportOptions& over) {
    for_each_import_option([&](const char*, auto option) {
        if (over.*option) base.*option = over.*option;
    });
    return base;
}

Color read_color(const JsonPlace& place) {
    const std::optional<Color> color = color_from_text(place.string());
    if (!color) place.fail(in_quotes(place.string()) + " is not a colour; give one like #E69F00");
    return *color;
}

/// Of a clip, which takes what is to be said of its start.
mobb::Placement read_placement(const JsonPlace& place, SceneClip& clip) {
    mobb::Placement placement;
    if (const auto translate = place.find("translate")) {
        placement.translate = translate->vector<glm::dvec2>(mobb::kMaxLength, "[x, y] in metres");
    }
    if (const auto degrees = place.find("rotate_deg")) placement.rotate_deg = degrees->number(-1e9, 1e9);
    if (const auto start = place.find("start")) {
        placement.start = start->number(-mobb::kMaxTime, mobb::kMaxTime);
        start->attempt([&] { mobb::checked(placement, clip.clip->most_start()); });
        warn_of_coarse_times(*clip.clip, placement.start, clip.facts.warnings);
    }
    return placement;
}

// One overload for each type of an import option; texts may stand as numbers.

void read_option(const JsonPlace& place, std::string_view, double& to) { to = place.number(); }

void read_option(const JsonPlace& place, std::string_view, std::pair<double, double>& to) {
    place.require_size(2, "[A, B] in seconds");
    to = {place[0].number(), place[1].number()};
}

/// Metres, or the column of a CSV. A file of radii is no part of a scene: each clip has its own radius.
void read_option(const JsonPlace& place, std::string_view, Radius& to) {
    if (place.is_string()) {
        to = RadiusColumn{place.string()};
    } else {
        to = place.number();
    }
}

void read_option(const JsonPlace& place, std::string_view, Origin& to) {
    const auto origin = origin_from_name(place.string());
    if (!origin) place.fail(in_quotes(place.string()) + " is not an origin; give keep, start or start_heading");
    to = *origin;
}

void read_option(const JsonPlace& place, std::string_view, mobb::Motion& to) {
    const auto motion = mobb::motion_from_name(place.string());
    if (!motion) place.fail(in_quotes(place.string()) + " is not a motion; give held or linear");
    to = *motion;
}

void read_option(const JsonPlace& place, std::string_view, bool& to) { to = place.boolean(); }

/// The name of a track: a string, or a whole number, which a file of tracks has as decimal digits.
std::string read_id(const JsonPlace& place) {
    if (!place.is_number()) return place.string();
    const double number = place.number();
    // Beyond 2^53 a double no longer tells whole numbers apart.
    if (number != std::floor(number) || std::abs(number) >= 0x1p53)
        place.fail(format_double(number) + " is not exact as a number; write the id as a string");
    return std::to_string(static_cast<std::int64_t>(number));
}

void read_option(const JsonPlace& place, std::string_view key, std::string& to) {
    if (key == "id") {
        to = read_id(place);
    } else if (key == "animation" && place.is_number()) {
        to = std::to_string(place.integer(0, kMaxInt));
    } else if (key == "unit" && place.is_number()) {
        to = format_double(place.number());
    } else {
        to = place.string();
    }
}

ImportOptions read_import_options(const JsonPlace& place) {
    ImportOptions options;
    for_each_import_option([&](const char* key, auto option) {
        const auto value = place.find(key);
        if (!value) return;
        read_option(*value, key, (options.*option).emplace());
        // Checked after each key, so that a complaint stands at the value it is about.
        value->attempt([&] { check(options); });
    });
    return options;
}

/// Options of the command line that apply to a file; those that do not are named in `warnings`.
ImportOptions overrides_for(const std::filesystem::path& file, const ImportOptions& overrides,
                            std::vector<ImportWarning>& warnings) {
    const ApplicableOptions taken = applicable(overrides, file);
    for (const std::string& key : taken.left_out) warnings.push_back({does_not_apply(key, file)});
    return taken.options;
}

void append(std::vector<ImportWarning>& to, const std::vector<ImportWarning>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Of inline samples.
mobb::Motion read_motion(const JsonPlace& clip) {
    mobb::Motion motion = mobb::Motion::held;
    if (const auto key = clip.find("motion")) read_option(*key, "motion", motion);
    return motion;
}

mobb::ClipPtr read_samples(const JsonPlace& place) {
    const mobb::Motion motion = read_motion(place);
    const JsonPlace dt = place.require("dt");
    const double seconds = dt.number();
    const JsonPlace list = place.require("samples");
    if (list.size() == 0) list.fail("a clip needs at least one sample");
    std::vector<mobb::Disk> samples;
    samples.reserve(static_cast<std::size_t>(list.size()));
    for (int i = 0; i < list.size(); ++i) {
        const JsonPlace sample = list[i];
        sample.require_size(3, "[x, y, r] in metres");
        samples.push_back({sample[0].number(-mobb::kMaxLength, mobb::kMaxLength),
                           sample[1].number(-mobb::kMaxLength, mobb::kMaxLength),
                           sample[2].number(0, mobb::kMaxLength)});
    }
    // The samples are in range by now: what may be wrong is how long they last.
    return dt.attempt([&] { return std::make_shared<const mobb::Clip>(seconds, std::move(samples), motion); });
}

/// Finds a named thing, or names the nearest one.
class NameTable {
  public:
    /// False if the name is taken.
    bool add(const std::string& name) {
        names_.push_back(name);
        return index_.try_emplace(name, static_cast<int>(names_.size()) - 1).second;
    }
    int find(const JsonPlace& place, const char* what) const {
        const auto found = index_.find(place.string());
        if (found != index_.end()) return found->second;
        place.fail("there is no " + std::string(what) + " " + in_quotes(place.string()) +
                   (names_.empty() ? "; the scene has none"
                                   : "; the nearest is " + in_quotes(nearest(place.string(), names_))));
    }

  private:
    std::vector<std::string> names_;
    std::unordered_map<std::string, int> index_;
};

constexpr double kMostSpeed = 1e6;  // metres or radians per second, of poses
constexpr int kPoseNumbers = 10;

/// A joint's rotation, spin and offset, on one line of numbers.
HangingJoint read_hanging_joint(const JsonPlace& place) {
    place.require_size(kPoseNumbers, "[qx, qy, qz, qw, wx, wy, wz, x, y, z]");
    const auto number = [&](int i, double most) { return place[i].number(-most, most); };
    const glm::dquat rotation(number(3, 1), number(0, 1), number(1, 1), number(2, 1));
    if (!(std::abs(glm::length(rotation) - 1) < 1e-6)) place.fail("its first four numbers are not a unit quaternion");
    return {rotation,
            {number(4, kMostSpeed), number(5, kMostSpeed), number(6, kMostSpeed)},
            {number(7, mobb::kMaxLength), number(8, mobb::kMaxLength), number(9, mobb::kMaxLength)}};
}

MovingPose read_pose(const JsonPlace& place) {
    place.allow_only({"height", "velocity", "joints"});
    MovingPose pose;
    pose.height = place.require("height").number(-mobb::kMaxLength, mobb::kMaxLength);
    const JsonPlace velocity = place.require("velocity");
    velocity.require_size(3, "[along the heading, to the left, up] in metres per second");
    for (int i = 0; i < 3; ++i) pose.velocity[i] = velocity[i].number(-kMostSpeed, kMostSpeed);
    const JsonPlace joints = place.require("joints");
    for (int i = 0; i < joints.size(); ++i) pose.joints.push_back(read_hanging_joint(joints[i]));
    return pose;
}

constexpr std::string_view kSceneKeys[] = {"$schema", "mobbscope", "poses",   "clips", "graph", "crowd",
                                           "agents",  "fit",       "queries", "debug", "view"};

class SceneReader {
  public:
    SceneReader(const JsonPlace& root, std::filesystem::path folder, const ImportOptions& overrides,
                const Progress& progress, Importer& importer)
        : root_(root), folder_(std::move(folder)), overrides_(overrides), progress_(progress), importer_(importer) {}

    /// Whether a text is meant to be a scene: no list, and no object without any of a scene's keys.
    static bool may_be(const JsonPlace& root) {
        if (!root.is_object()) return !root.is_array();
        return root.members() == 0 ||
               std::ranges::any_of(kSceneKeys, [&](std::string_view key) { return root.find(key).has_value(); });
    }

    Scene read() {
        root_.allow_only(kSceneKeys);
        check_version();
        if (const auto poses = root_.find("poses")) {
            for (int i = 0; i < poses->members(); ++i) {
                const JsonPlace pose = poses->member(i);
                if (!pose_names_.add(pose.key())) pose.fail("another pose is named " + in_quotes(pose.key()));
                poses_.push_back(std::make_shared<const MovingPose>(read_pose(pose)));
            }
        }
        const JsonPlace clips = root_.require("clips");
        if (clips.members() == 0) clips.fail("there is no clip; add one");
        for (int i = 0; i < clips.members(); ++i) {
            if (progress_) progress_(static_cast<std::size_t>(i), static_cast<std::size_t>(clips.members()));
            scene_.clips.push_back(read_clip(clips.member(i)));
        }
        if (const auto graph = root_.find("graph")) {
            scene_.graph = std::make_shared<MotionGraph>(
                read_graph(*graph, [this](const JsonPlace& clip) { return clip_names_.find(clip, "clip"); }));
        }
        if (scene_.graph) check_moved_clips(clips);
        if (const auto agents = root_.find("agents")) {
            for (int i = 0; i < agents->size(); ++i) scene_.agents.push_back(read_agent((*agents)[i]));
        }
        if (const auto fit = root_.find("fit")) scene_.fit = read_fit(*fit);
        if (const auto queries = root_.find("queries")) {
            for (int i = 0; i < queries->size(); ++i) scene_.queries.push_back(read_query((*queries)[i]));
        }
        if (const auto crowd = root_.find("crowd")) {
            scene_.crowd = read_crowd(*crowd, scene_);
            warn_of_plays();
        }
        if (const auto debug = root_.find("debug")) scene_.debug = read_debug_state(*debug, query_count(scene_));
        if (const auto view = root_.find("view")) {
            scene_.view = read_view(*view);
            check_viewed_query(*view);
            check_viewed_names(*view);
        }
        return std::move(scene_);
    }

  private:
    void check_version() const {
        if (const auto schema = root_.find("$schema")) schema->string();
        const auto version = root_.find("mobbscope");
        if (version && version->number() != kVersion) {
            version->fail("the file has version " + format_double(version->number()) + "; this program reads version " +
                          std::to_string(kVersion));
        }
    }

    SceneClip read_clip(const JsonPlace& place) {
        SceneClip clip;
        clip.name = place.key();
        if (clip.name.empty()) place.fail("a clip needs a name");
        clip_names_.add(clip.name);
        // A misspelt key is named as such before anything is concluded from what is missing.
        std::vector<std::string_view> keys{"source"};
        for_each_import_option([&keys](const char* key, auto) { keys.push_back(key); });
        keys.push_back("warp");
        keys.push_back("turn");
        keys.push_back("samples");
        keys.push_back("digest");
        keys.push_back("body");
        keys.push_back("headings");
        place.allow_only(keys);
        if (place.find("source")) {
            read_source(place, clip);
        } else if (place.find("samples")) {
            refuse_import_keys(place);
            if (const auto turn = place.find("turn"))
                turn->fail("only a clip with a source is turned; turn the samples, and remove this");
            clip.clip = read_samples(place);
            if (const auto digest = place.find("digest")) check_digest(read_digest(*digest), clip);
            override_samples(place, clip);
            clip.body = read_body(place).value_or(std::vector<mobb::BodyDisk>());
            if (const auto headings = place.find("headings")) clip.headings = read_headings(*headings, place, clip);
            warn_of_long_held_step(*clip.clip, clip.facts.warnings);
            warn_of_coarse_times(*clip.clip, 0, clip.facts.warnings);
            if (clip.headings.empty()) warn_of_no_heading(*clip.clip, clip.body, clip.facts.warnings);
        } else {
            place.fail("a clip needs a source, or dt and samples");
        }
        if (clip.body.empty()) return clip;
        const JsonPlace body = place.find("body").value_or(place);
        if (!bodies_.try_add(clip.body.size() * clip.clip->samples().size_bytes()))
            body.fail("with this one the bodies of the scene take too much memory; leave disks out");
        body.attempt([&] { make_members(clip); });
        return clip;
    }

    /// The disks that the scene gives a clip. A radius that is asked for is everyone's, and there is no body.
    std::optional<std::vector<mobb::BodyDisk>> read_body(const JsonPlace& place) const {
        const auto body = place.find("body");
        if (!body) return std::nullopt;
        if (const auto radius = place.find("radius"))
            radius->fail("a clip has a radius or a body, not both; remove one");
        std::optional disks = read_disks(*body);
        if (overrides_.radius) disks.reset();
        return disks;
    }

    static std::vector<mobb::BodyDisk> read_disks(const JsonPlace& place) {
        const auto most = static_cast<int>(mobb::kMaxBodyDisks);
        if (place.size() == 0 || place.size() > most)
            place.fail("a body has from 1 to " + std::to_string(most) + " disks; leave it out for one at the samples");
        std::vector<mobb::BodyDisk> out;
        place.each([&](const JsonPlace& disk) {
            disk.require_size(3, "[forward, left, r] in metres");
            out.push_back({disk[0].number(-mobb::kMaxLength, mobb::kMaxLength),
                           disk[1].number(-mobb::kMaxLength, mobb::kMaxLength), disk[2].number(0, mobb::kMaxLength)});
        });
        return out;
    }

    static std::vector<double> read_headings(const JsonPlace& place, const JsonPlace& of, const SceneClip& clip) {
        if (!of.find("body")) place.fail("they are those of a body; give a body, or remove them");
        place.require_size(clip.clip->count(), "degrees, one a sample");
        std::vector<double> out;
        place.each([&](const JsonPlace& heading) { out.push_back(heading.number(-1e9, 1e9)); });
        return out;
    }

    static void check_digest(std::uint64_t said, SceneClip& clip) {
        const std::uint64_t is = mobb::digest(*clip.clip);
        if (is != said)
            clip.facts.warnings.push_back({"its samples are not those that were captured: their digest is " +
                                               digest_text(is) + ", and the file says " + digest_text(said),
                                           std::string(kDigest)});
        clip.digest = said;
    }

    /// Of the options that go over the scene's a motion and a radius are for inline samples too.
    void override_samples(const JsonPlace& place, SceneClip& clip) const {
        const mobb::Clip& was = *clip.clip;
        const mobb::Motion motion = overrides_.motion.value_or(was.motion());
        if (!overrides_.radius && motion == was.motion()) return;
        std::vector<mobb::Disk> samples(was.samples().begin(), was.samples().end());
        if (overrides_.radius) {
            const double metres = place.attempt([&] { return metres_of(*overrides_.radius, clip.name, ""); });
            for (mobb::Disk& disk : samples) disk.r = metres;
        }
        clip.clip = std::make_shared<const mobb::Clip>(was.dt(), std::move(samples), motion);
        clip.digest.reset();
    }

    static void read_turn(const JsonPlace& place, SceneClip& clip) {
        place.allow_only({"deg", "seconds"});
        const double deg = place.require("deg").number(-180, 180);
        const JsonPlace seconds = place.require("seconds");
        if (seconds.number(0, mobb::kMaxTime) == 0) seconds.fail("must be greater than 0");
        place.attempt([&] { bend(clip, {deg, seconds.number()}); });
    }

    /// Whoever plays moves is one disk. A turned move plays a clip that turns as far; of samples it cannot be told.
    void check_moved_clips(const JsonPlace& clips) const {
        for (const GraphMove& move : scene_.graph->moves) {
            if (clip_has_body(move.clip))
                clips.member(move.clip).fail("a motion graph plays it, and its clips have no body; remove the body");
        }
        const JsonPlace graph = root_.require("graph");
        const JsonPlace moves = graph.require("moves");
        for (int i = 0; i < moves.size(); ++i)
            check_turned_clip(scene_.graph->moves[static_cast<std::size_t>(i)], moves[i]);
    }
    void check_turned_clip(const GraphMove& move, const JsonPlace& place) const {
        const SceneClip& clip = scene_.clips[static_cast<std::size_t>(move.clip)];
        if (!move.turned || !clip.source || (clip.turn && clip.turn->deg == move.turned->deg)) return;
        const auto [is, wanted] = told_apart(clip.turn ? clip.turn->deg : 0, move.turned->deg, brief);
        const std::string now = clip.turn ? "by " + is + " degrees" : "not at all";
        place.require("clip").fail("the clip " + in_quotes(clip.name) + " turns " + now + ", the move by " + wanted +
                                   " degrees; mend the clip's turn");
    }

    static void refuse_import_keys(const JsonPlace& place) {
        if (const auto warp = place.find("warp")) warp->fail("samples are as they are; remove it, or give a source");
        for_each_import_option([&place](std::string_view key, auto) {
            const auto import_key = place.find(key);
            // These two are those of the samples too.
            if (import_key && key != "dt" && key != "motion")
                import_key->fail("an import key is for a clip with a source; remove it");
        });
    }

    void read_source(const JsonPlace& place, SceneClip& clip) {
        if (const auto samples = place.find("samples"))
            samples->fail("a clip has a source or samples, not both; remove one");
        if (const auto digest = place.find("digest"))
            digest->fail("only samples have a digest; remove it, or give samples");
        const JsonPlace source = place.require("source");
        if (source.string().empty()) source.fail("the source is empty; name a clip file");
        if (source.string().find('\0') != std::string::npos)
            source.fail("the source holds a NUL byte, as no file name does; remove it");
        if (is_standard_input(source.string()))
            source.fail("standard input is not a source of a scene's clip; name a clip file");
        clip.source = source.string();
        if (const auto headings = place.find("headings"))
            headings->fail("only samples have headings; a source has its own, so remove them");
        clip.options = read_import_options(place);
        clip.options.body = read_body(place);
        for (const std::string& key : applicable(clip.options, folder_ / *clip.source).left_out) {
            place.require(key).fail(does_not_apply(key, *clip.source) + "; leave it out");
        }
        if (const auto warp = place.find("warp")) clip.warp = read_warp(*warp);
        std::vector<ImportWarning> warnings;
        const ImportOptions overrides = overrides_for(folder_ / *clip.source, overrides_, warnings);
        try {
            const auto import = [&](const ImportOptions& options) {
                return importer_.clips(folder_ / *clip.source, options);
            };
            std::vector<ImportedClip> imported =
                import_warped(import, merged(clip.options, overrides), clip.warp.get());
            if (imported.size() > 1) refuse_several(*clip.source, imported);
            clip.clip = imported.front().clip;
            clip.facts = std::move(imported.front().facts);
            clip.skeleton = std::move(imported.front().skeleton);
            clip.start = imported.front().start;
            clip.body = std::move(imported.front().body);
            clip.headings = std::move(imported.front().headings);
            append(clip.facts.warnings, warnings);
        } catch (const InputError& error) {
            source.fail(error.what());
        } catch (const std::invalid_argument& error) {
            place.require("warp").fail(error.what());
        }
        count_samples(source, clip);
        if (const auto turn = place.find("turn")) read_turn(*turn, clip);
    }

    /// One source may be named any number of times.
    void count_samples(const JsonPlace& source, const SceneClip& clip) {
        const std::size_t joints =
            clip.skeleton ? clip.skeleton->joints.size() : static_cast<std::size_t>(clip.facts.joints);
        if (sources_.insert({*clip.source, clip.facts.animation, clip.options.id.value_or("")}).second)
            made_.add_stored(static_cast<std::size_t>(clip.facts.frames), joints);
        if (made_.add(static_cast<std::size_t>(clip.clip->count()), joints)) return;
        source.fail("with this one the scene's clips " + MadeSamples::too_many() + ", or take clips out");
    }

    WarpEnd read_warp_end(const JsonPlace& place) const {
        place.require_size(2, "[pose, heading in degrees]");
        const int pose = pose_names_.find(place[0], "pose");
        return {place[0].string(), poses_[static_cast<std::size_t>(pose)], place[1].number(-1e9, 1e9)};
    }

    std::shared_ptr<const ClipWarp> read_warp(const JsonPlace& place) const {
        place.allow_only({"seconds", "begin", "end"});
        const JsonPlace seconds = place.require("seconds");
        if (seconds.number(0, mobb::kMaxTime) == 0) seconds.fail("must be over 0");
        return std::make_shared<const ClipWarp>(
            ClipWarp{seconds.number(), read_warp_end(place.require("begin")), read_warp_end(place.require("end"))});
    }

    [[noreturn]] void refuse_several(const std::string& source, const std::vector<ImportedClip>& imported) const {
        const ImportedClip& first = imported.front();
        const auto differs = [&](std::string ImportedClip::*key) {
            return std::ranges::any_of(imported, [&](const ImportedClip& clip) { return clip.*key != first.*key; });
        };
        const auto name_one = [](const char* option, const std::string& such) {
            return "name one with " + std::string(option) + ", such as " + in_quotes(such);
        };
        const bool of_animations = differs(&ImportedClip::animation);
        const std::string animation = name_one("animation", first.animation);
        const std::string root = name_one("root", first.root);
        const std::string how = !first.id.empty()              ? " tracks; " + name_one("id", first.id)
                                : !of_animations               ? " characters; " + root
                                : differs(&ImportedClip::root) ? " clips; " + animation + ", and " + root
                                                               : " animations; " + animation;
        throw InputError(folder_ / source, "has " + std::to_string(imported.size()) + how);
    }

    Agent read_agent(const JsonPlace& place) {
        place.allow_only({"name", "clip", "translate", "rotate_deg", "start", "color", "floor"});
        const JsonPlace name = place.require("name");
        if (name.string().empty()) name.fail("an agent needs a name");
        if (!agent_names_.add(name.string()))
            name.fail("another agent is named " + in_quotes(name.string()) + "; rename one");
        Agent agent;
        agent.name = name.string();
        agent.clip = clip_names_.find(place.require("clip"), "clip");
        agent.placement = read_placement(place, clip_at(agent.clip));
        if (const auto color = place.find("color")) agent.color = read_color(*color);
        if (const auto floor = place.find("floor")) {
            agent.floor = floor->is_number() ? format_double(floor->number()) : floor->string();
            if (agent.floor.empty()) floor->fail("a floor has a name or a number; remove it, or give one");
        }
        return agent;
    }

    SceneQuery read_query(const JsonPlace& place) {
        place.allow_only({"a", "b", "expect", "trace", "events"});
        SceneQuery query;
        query.a = read_placed_agent(place.require("a"));
        query.b = read_placed_agent(place.require("b"));
        check_floors(place, query);
        const int samples_a = clip_of(query.a).count();
        const int samples_b = clip_of(query.b).count();
        if (const auto expect = place.find("expect")) query.expect = read_expectation(*expect, samples_a, samples_b);
        if (const auto trace = place.find("trace")) {
            query.trace = read_stored_trace(place, *trace, samples_a, samples_b);
        } else if (const auto events = place.find("events")) {
            events->fail("it counts the events of a trace; give the trace, or remove this");
        }
        return query;
    }

    void check_floors(const JsonPlace& place, const SceneQuery& query) const {
        if (query.a.agent < 0 || query.b.agent < 0) return;
        const Agent& a = scene_.agents[static_cast<std::size_t>(query.a.agent)];
        const Agent& b = scene_.agents[static_cast<std::size_t>(query.b.agent)];
        if (!are_apart(a, b)) return;
        place.fail(in_quotes(query.a.name) + " is on floor " + in_quotes(a.floor) + " and " + in_quotes(query.b.name) +
                   " on floor " + in_quotes(b.floor) + ": they never meet; remove the query");
    }

    /// Of a recording that stopped, `events` says how many there were.
    static std::shared_ptr<const mobb::Trace> read_stored_trace(const JsonPlace& query, const JsonPlace& place,
                                                                int samples_a, int samples_b) {
        mobb::Trace trace = read_trace(place, samples_a, samples_b);
        if (const auto events = query.find("events")) trace.leave_out(events->count(trace.size()) - trace.size());
        return std::make_shared<const mobb::Trace>(std::move(trace));
    }

    PlacedAgent read_placed_agent(const JsonPlace& place) {
        if (place.is_string()) {
            const int index = agent_names_.find(place, "agent");
            const Agent& agent = scene_.agents[static_cast<std::size_t>(index)];
            return {agent.name, agent.clip, agent.placement, index};
        }
        place.allow_only({"clip", "translate", "rotate_deg", "start"});
        const JsonPlace name = place.require("clip");
        const int clip = clip_names_.find(name, "clip");
        return {name.string(), clip, read_placement(place, clip_at(clip)), -1};
    }

    static Expectation read_expectation(const JsonPlace& place, int samples_a, int samples_b) {
        place.allow_only({"collides", "contact", "tests"});
        Expectation expect;
        const auto contact = place.find("contact");
        const auto tests = place.find("tests");
        if (tests) expect.tests = read_expected_tests(*tests);
        // Tests alone are enough.
        if (!tests || contact || place.find("collides")) expect.collides = place.require("collides").boolean();
        if (contact) {
            expect.contact = read_contact(*contact, samples_a, samples_b);
            if (expect.contact && !*expect.collides)
                contact->fail("there is no contact without a collision; give null");
        }
        return expect;
    }

    static ExpectedTests read_expected_tests(const JsonPlace& place) {
        if (place.members() == 0) place.fail("no kind of test is named; name one or more, such as time, or remove it");
        return read_test_counts(place);
    }

    void check_viewed_query(const JsonPlace& view) const {
        if (!scene_.view.query) return;
        const std::size_t count = query_count(scene_);
        if (static_cast<std::size_t>(*scene_.view.query) >= count) {
            view.require("query").fail("the scene has " + std::to_string(count) + " queries, counted from 0");
        }
    }

    void check_viewed_names(const JsonPlace& view) const {
        if (!names_agents(scene_.view)) return;
        NameTable known;
        for (const std::string& name : names_in_view(scene_)) known.add(name);
        for (const ViewOption& option : view_options()) {
            const auto names = option.names ? view.find(option.key) : std::nullopt;
            for (int i = 0; names && i < names->size(); ++i) known.find((*names)[i], "agent");
        }
    }

    void warn_of_plays() {
        for (const CrowdAgent& agent : scene_.crowd->agents) {
            for (const Play& play : agent.plays) {
                SceneClip& clip = clip_at(scene_.graph->moves[static_cast<std::size_t>(play.move)].clip);
                warn_of_coarse_times(*clip.clip, play.placement.start, clip.facts.warnings);
            }
        }
    }

    bool clip_has_body(int index) const { return !scene_.clips[static_cast<std::size_t>(index)].body.empty(); }
    SceneClip& clip_at(int index) { return scene_.clips[static_cast<std::size_t>(index)]; }
    const mobb::Clip& clip_of(const PlacedAgent& who) const {
        return *scene_.clips[static_cast<std::size_t>(who.clip)].clip;
    }

    const JsonPlace& root_;
    std::filesystem::path folder_;
    const ImportOptions& overrides_;
    const Progress& progress_;
    Importer& importer_;
    NameTable pose_names_;
    std::vector<std::shared_ptr<const MovingPose>> poses_;  ///< by their place among the names
    NameTable clip_names_;
    NameTable agent_names_;
    std::set<std::array<std::string, 3>> sources_;  ///< file, animation and id
    Spent bodies_;                                  ///< what members take
    MadeSamples made_;                              ///< of clips with a source
    Scene scene_;
};

Scene scene_of_clips(const std::filesystem::path& file, const ImportOptions& overrides) {
    Scene scene;
    each_scene_clip(file, overrides, [&](SceneClip&& clip, Agent&& agent) {
        if (clip.facts.t0) {
            agent.clip = static_cast<int>(scene.clips.size());
            scene.agents.push_back(std::move(agent));
        }
        scene.clips.push_back(std::move(clip));
    });
    lay_out_clips(scene);
    return scene;
}

}  // namespace

bool is_scene_file(const std::filesystem::path& file) {
    if (!is_standard_input(file)) {
        // A file may be called like a link to a step, and what is no scene like one.
        const std::filesystem::path plain = without_link(file);
        return unpacked_extension(plain) == ".json" && !contents_of(plain);
    }
    constexpr std::size_t kHead = 100;  // bytes
    const std::string begin = read_beginning(file, kHead);
    const std::size_t first = begin.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    return first != std::string::npos && begin[first] == '{' && !contents_of(file);
}

void each_scene_clip(const std::filesystem::path& file, const ImportOptions& overrides,
                     const std::function<void(SceneClip&& clip, Agent&& agent)>& sink) {
    std::vector<ImportWarning> warnings;
    const ImportOptions options = overrides_for(file, overrides, warnings);
    Spent bodies;
    import_each(file, options, [&](ImportedClip&& imported) {
        SceneClip clip{imported.name,
                       file.filename().string(),
                       options,
                       std::move(imported.clip),
                       std::move(imported.facts),
                       std::move(imported.skeleton),
                       imported.start};
        clip.body = std::move(imported.body);
        clip.headings = std::move(imported.headings);
        if (!bodies.try_add(clip.body.size() * clip.clip->samples().size_bytes()))
            throw InputError(file, "its bodies take too much memory; give --trim or --id");
        at_place(file.string(), "clip " + in_quotes(clip.name), [&] { make_members(clip); });
        append(clip.facts.warnings, warnings);
        if (!imported.id.empty()) clip.options.id = imported.id;
        if (!imported.animation.empty()) clip.options.animation = imported.animation;
        if (!imported.root.empty()) clip.options.root = imported.root;
        name_own_radius(clip);
        Agent agent{clip.name, 0, {.start = clip.start}, std::nullopt};
        agent.floor = std::move(imported.floor);
        sink(std::move(clip), std::move(agent));
    });
}

Scene load_scene(const std::filesystem::path& file, const ImportOptions& overrides, const Progress& progress,
                 Importer* importer) {
    check_file_name(file);
    const bool is_scene = is_scene_file(file);
    if (!is_scene && progress) progress(0, 1);
    const InputBytes input = is_scene ? read_input(file) : InputBytes();
    Scene scene = is_scene ? parse_scene(input.bytes, file.string(), file.parent_path(), overrides, progress, importer)
                           : scene_of_clips(file, overrides);
    scene.file = file;
    return scene;
}

Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                  const ImportOptions& overrides, const Progress& progress, Importer* importer) {
    const JsonText value = parse_json(text, name);
    const JsonPlace root(value, name);
    if (!SceneReader::may_be(root)) throw InputError(name, "", foreign_kind(text).value_or("is no scene"));
    Importer own;
    return SceneReader(root, folder, overrides, progress, importer ? *importer : own).read();
}

Scene read_scene(const JsonPlace& place, const std::filesystem::path& folder) {
    Importer importer;
    return SceneReader(place, folder, {}, {}, importer).read();
}

}  // namespace mobbscope
