#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/clip/sampling.h>
#include <import/skeleton/disk_sampler.h>
#include <import/skeleton/motion_clips.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace mobbscope {

namespace {

constexpr mobb::Motion kMotionOfSkeletons = mobb::Motion::held;
constexpr double kBodyHeight = 1.7;  // metres: the contract's, for the unit "auto"
// The units that motion capture comes in; the last is that of CMU's ASF/AMC files.
constexpr std::array<double, 5> kBodyUnits{1, 0.01, 0.001, 0.0254, 0.0564444};
constexpr std::array<double, 6> kUnitsByLimbs{1, 0.01, 0.001, 0.0254, 0.0564444, 0.1};
// A median height tells the unit where it is so many metres then, and so much of what the limbs make it.
constexpr double kShort = 1.4, kTall = 2, kStanding = 0.6;
// More samples of a body than that are a wrong time, and would take minutes to pose.
constexpr std::size_t kMaxMotionSamples = 1'000'000;
// Joints times frames or samples, of a clip and of all clips of a file. A file of real captures has no room for more;
// one of names and zeros would take hours.
constexpr double kMaxJointPoses = 1e8;
constexpr double kMaxJointPosesOfFile = 1e9;
constexpr std::size_t kMaxSkeletonPositions = 8'000'000;  // 224 MB; longer clips go without a skeleton

/// Units as options, and what they are called.
constexpr std::pair<const char*, const char*> kUnitChoices[] = {
    {"m", "m"}, {"cm", "cm"}, {"0.001", "mm"}, {"in", "in"}, {"0.0564444", "0.0564444 (CMU's ASF/AMC)"}};

/// Metres with two decimals, or as many digits as it takes.
std::string brief_length(double metres) {
    return (metres >= 0.1 ? format_double(std::round(metres * 100) / 100) : formatted("%.1g", metres)) + " m";
}

/// How a body tells the unit of its file.
struct BodySize {
    double height = 0;  ///< file units
    double limbs = 0;   ///< its height by them
};

BodySize body_size(const GroundedMotion& grounded, int root) {
    return {median_height(grounded, root), height_of_limbs(grounded, root)};
}

struct GuessedUnit {
    double metres = 1;
    double height = 0;  ///< of the body, metres
    bool by_limbs = false;
};

/// The unit of `units` that makes a height in file units most nearly 1.7 m.
GuessedUnit nearest_unit(double height, std::span<const double> units) {
    const double unit = *std::ranges::min_element(
        units, {}, [height](double metres) { return std::abs(metres * height - kBodyHeight); });
    return {unit, unit * height};
}

/// By the height; but of who hardly stands, or has no usual height in any unit, by the limbs if that is nearer.
GuessedUnit guessed_unit(const BodySize& body) {
    const GuessedUnit by_height = nearest_unit(body.height, kBodyUnits);
    const bool stands = body.height >= kStanding * body.limbs;
    if (stands && by_height.height >= kShort && by_height.height <= kTall) return by_height;
    GuessedUnit by_limbs = nearest_unit(body.limbs, kUnitsByLimbs);
    by_limbs.by_limbs = true;
    const auto off = [](const GuessedUnit& unit) { return std::abs(unit.height - kBodyHeight); };
    return by_limbs.metres != by_height.metres && off(by_limbs) < off(by_height) ? by_limbs : by_height;
}

/// How the axes of a file lead to those of its clips.
struct ChosenUp {
    glm::dmat3 ground{1};
    std::string why;    ///< empty where an option says it
    std::string doubt;  ///< see MotionFile::up_doubt
};

ChosenUp chosen_up(const MotionFile& file, const ImportOptions& options) {
    if (options.up == "y") return {kYUp, "", ""};
    if (options.up == "z") return {kZUp, "", ""};
    if (file.ground) return {*file.ground, file.up_why, file.up_doubt};
    return {kYUp, "as in most files", file.up_doubt};
}

/// The axis of a file that leads to z: "y", "-x".
std::string up_axis(const glm::dmat3& ground) {
    const glm::dvec3 up(ground[0].z, ground[1].z, ground[2].z);
    for (int axis = 0; axis < 3; ++axis) {
        if (up[axis] != 0) return std::string(up[axis] < 0 ? "-" : "") + "xyz"[axis];
    }
    return "";
}

/// Of the tallest character, where the unit is to be guessed for several: a file has one unit, and a child or a ball
/// tells less of it. None where it is not needed, or would take hours.
std::optional<BodySize> tallest_body(const MotionFile& file, const ImportOptions& options) {
    if (file.unit || file.characters.size() < 2) return std::nullopt;
    const ChosenUp up = chosen_up(file, options);
    BodySize tallest;
    double poses = 0;
    for (std::size_t i = 0; i < file.characters.size(); ++i) {
        const std::shared_ptr<const Motion> motion = file.motion(0, i);
        const GroundedMotion grounded(*motion, up.ground);
        poses += static_cast<double>(motion->posed()) * motion->times().frames;
        if (poses > kMaxJointPoses) return std::nullopt;
        const BodySize size = body_size(grounded, motion->topmost());
        if (size.height > tallest.height) tallest = size;
    }
    return tallest;
}

/// One animation of one character to one clip; messages are for import of one file.
class MotionImport {
  public:
    /// `body`: tells the unit; none: the one below the root does.
    MotionImport(const MotionFile& file, const RootedMotion& it, std::optional<BodySize> body,
                 const ImportOptions& options)
        : file_(file),
          motion_(*it.motion),
          up_(chosen_up(file, options)),
          grounded_(motion_, up_.ground),
          root_(it.root),
          body_(body),
          options_(options) {}

    /// `poses_left`: of joints, for this clip and those after it; `made`: of this file.
    ImportedClip make(double& poses_left, MadeSamples& made) {
        const MotionTimes& times = motion_.times();
        const SampleGrid grid = grid_of(times), all = has_body() ? whole_around(grid) : grid;
        const std::size_t stored = times.frames_only ? static_cast<std::size_t>(times.frames) : 0;
        const std::size_t frames = std::max(all.count, stored);
        const double poses = static_cast<double>(frames) * static_cast<double>(motion_.posed());
        if (poses > kMaxJointPoses) {
            throw std::invalid_argument("needs " + std::to_string(motion_.posed()) +
                                        " joints and layers of curves for each of " + std::to_string(frames) +
                                        " frames, which is too much; check the file, or lower fps");
        }
        poses_left -= poses;
        const auto posed = static_cast<std::size_t>(motion_.posed());
        made.add_stored(static_cast<std::size_t>(times.frames), posed);
        if (poses_left < 0 || !made.add(grid.count, posed)) {
            throw std::invalid_argument("its clips " + MadeSamples::too_many() +
                                        ", or name one with animation or root");
        }
        ImportedClip out;
        SourceFacts& facts = out.facts;
        const int root = root_ ? *root_ : take_default_root(facts);
        facts.format = file_.format;
        facts.frames = times.frames;
        facts.dt = times.dt;
        facts.duration = times.last - times.first;
        facts.first_key = times.first;
        facts.root = name_of(root);
        facts.joints = joints_below(root);
        facts.rig = rig_of(motion_.joints()[static_cast<std::size_t>(root)].name);
        facts.up = up_axis(up_.ground);
        facts.up_why = up_.why;
        choose_unit(root, facts);
        for (std::string& warning : motion_.warnings()) facts.warnings.push_back({std::move(warning)});
        if (!times.doubt.empty()) facts.warnings.push_back({times.doubt});
        if (!up_.doubt.empty()) facts.warnings.push_back({up_.doubt, "up"});
        if (!options_.unit && !file_.unit_doubt.empty()) facts.warnings.push_back({file_.unit_doubt, "unit"});

        auto skeleton = std::make_shared<Skeleton>();
        std::vector<mobb::Disk> samples = sample(grid, root, facts.unit, skeleton.get());
        if (options_.radius) {
            const double radius = metres_of(*options_.radius, "", "");
            for (mobb::Disk& disk : samples) disk.r = radius;
        }
        if (has_body()) {
            out.body = *options_.body;
            const mobb::Clip whole(1, options_.trim ? sample(all, root, facts.unit, nullptr) : samples);
            warn_of_no_heading(whole, out.body, facts.warnings);
            if (options_.trim) out.headings = headings_in(grid, all, whole);
        }
        const mobb::Rotation turn = put_at_origin(samples, options_.origin.value_or(Origin::keep));
        turn_headings(out.headings, turn);
        for (glm::vec3& p : skeleton->positions) {
            const glm::dvec2 turned = turn({p.x, p.y});
            p = {turned.x, turned.y, p.z};
        }
        if (turn.s != 0 || turn.c != 1) {
            const glm::quat about(about_up(turn));
            for (glm::quat& rotation : skeleton->rotations) rotation = about * rotation;
        }
        out.clip =
            std::make_shared<mobb::Clip>(grid.step, std::move(samples), options_.motion.value_or(kMotionOfSkeletons));
        if (!skeleton->positions.empty()) out.skeleton = std::move(skeleton);
        const auto cut_at = options_.trim ? std::optional(options_.trim->first) : std::nullopt;
        add_motion_warnings(*out.clip, cut_at, out.skeleton.get(), facts);
        return out;
    }

    ImportOffer offer() {
        const MotionTimes& times = motion_.times();
        const DefaultRoot taken = default_root(grounded_);
        const bool several = file_.characters.size() > 1;
        OptionOffer roots{"root", several ? "" : name_of(taken.joint),
                          several ? "the file has several characters: name one" : taken.why, several};
        for (const NamedJoint& joint : file_.joints) {
            if (!joint.name.empty()) roots.choices.push_back({joint.name, joint.name});
        }
        const double rate = times.dt ? 1 / *times.dt : 0;
        const std::string frames = rate > 0 ? "the file has " + brief(std::round(rate * 100) / 100) + " frames a second"
                                            : "the file's frames are not uniform in time";
        const double seconds = times.last - times.first;
        return {seconds,
                {std::move(roots),
                 {"fps", format_double(kDefaultFps), "as usual; " + frames},
                 unit_offer(root_.value_or(taken.joint)),
                 up_offer(),
                 {"trim", "", "all of it"},
                 origin_offer(),
                 {"radius", "", "up to the joint that is farthest from the root"},
                 motion_option_offer(kMotionOfSkeletons, "as usual of motion files: samples are close")}};
    }

  private:
    SampleGrid grid_of(const MotionTimes& times) const {
        try {
            return sample_grid(times.first, times.last, options_.trim, 1 / options_.fps.value_or(kDefaultFps),
                               kMaxMotionSamples);
        } catch (const std::invalid_argument& error) {
            if (times.doubt.empty()) throw;
            throw std::invalid_argument(times.doubt + "; " + error.what());
        }
    }

    std::string name_of(int joint) const { return file_.joints[motion_.in_file(joint)].name; }

    OptionOffer up_offer() const {
        ImportOptions of_file = options_;
        of_file.up.reset();
        const ChosenUp up = chosen_up(file_, of_file);
        return {"up", up_axis(up.ground), up.why, false, {{"y", "y"}, {"z", "z"}}};
    }

    OptionOffer unit_offer(int root) const {
        const std::optional<double>& file_unit = file_.unit;
        const BodySize body = body_ ? *body_ : body_size(grounded_, root);
        const GuessedUnit guess = guessed_unit(body);
        const double height = guess.by_limbs ? body.limbs : body.height;
        const auto tall = [height](double unit) { return "a body " + brief_length(height * unit) + " tall"; };
        OptionOffer out{"unit", unit_word(file_unit.value_or(guess.metres)),
                        file_unit ? "as the file says: " + tall(*file_unit)
                                  : "guessed: " + tall(guess.metres) +
                                        (guess.by_limbs ? " (by its limbs)" : " (its median height)")};
        if (file_unit) out.choices.push_back({"auto", "auto: " + tall(guess.metres)});
        for (const auto& [value, label] : kUnitChoices) {
            out.choices.push_back({value, label + std::string(": ") + tall(*metres_per_unit(value))});
        }
        return out;
    }

    int take_default_root(SourceFacts& facts) const {
        DefaultRoot taken = default_root(grounded_);
        facts.root_why = std::move(taken.why);
        return taken.joint;
    }

    int joints_below(int root) const {
        const std::vector<bool> inside = subtree(motion_.joints(), root);
        int count = 0;
        for (std::size_t i = 0; i < inside.size(); ++i) count += inside[i] && !motion_.joints()[i].end_site ? 1 : 0;
        return count;
    }

    std::size_t rig_of(std::string names) const {
        for (const Joint& joint : motion_.joints()) names += '\n' + joint.name;
        return std::max<std::size_t>(std::hash<std::string>{}(names), 1);
    }

    void choose_unit(int root, SourceFacts& facts) const {
        if (options_.unit && *options_.unit != "auto") {
            facts.unit = *metres_per_unit(*options_.unit);
        } else if (!options_.unit && file_.unit) {
            facts.unit = *file_.unit;
        } else {
            const GuessedUnit guess = guessed_unit(body_ ? *body_ : body_size(grounded_, root));
            facts.unit = guess.metres;
            facts.guessed_from_height = guess.height;
        }
    }

    /// The disks in metres; fills the skeleton, unless it is null, if it is not too much.
    std::vector<mobb::Disk> sample(const SampleGrid& grid, int root, double unit, Skeleton* skeleton) {
        const std::span<const Joint> joints = motion_.joints();
        const bool keep_skeleton = skeleton && grid.count <= kMaxSkeletonPositions / joints.size();
        if (keep_skeleton) {
            skeleton->joints.assign(joints.begin(), joints.end());
            skeleton->root = root;
            skeleton->positions.reserve(grid.count * joints.size());
            skeleton->rotations.reserve(grid.count * joints.size());
            for (const glm::dquat& rotation : grounded_.rest()) skeleton->rest.emplace_back(rotation);
        }
        DiskSampler sampler(grounded_, root, grid.step);
        PosedDisk posed;
        std::vector<mobb::Disk> samples;
        samples.reserve(grid.count);
        for (std::size_t k = 0; k < grid.count; ++k) {
            sampler.sample(grid.time(k), posed);
            samples.push_back({posed.disk.x * unit, posed.disk.y * unit, posed.disk.r * unit});
            if (!keep_skeleton) continue;
            const glm::dvec3 centre{posed.disk.x, posed.disk.y, 0};
            for (const glm::dvec3& p : posed.positions) skeleton->positions.emplace_back((p - centre) * unit);
            for (const glm::dquat& rotation : posed.rotations) skeleton->rotations.emplace_back(rotation);
        }
        return samples;
    }

    bool has_body() const { return options_.body && !options_.radius; }

    /// All times of the motion of which a grid is a part.
    SampleGrid whole_around(const SampleGrid& part) const {
        const MotionTimes& times = motion_.times();
        const double before = sample_count(times.first, part.begin, part.step) - 1;
        SampleGrid all =
            sample_grid(part.begin - before * part.step, times.last, std::nullopt, part.step, kMaxMotionSamples);
        // Rounded otherwise, the end may be a sample nearer.
        all.count = std::max(all.count, static_cast<std::size_t>(before) + part.count);
        return all;
    }

    /// Of a body in a part of a motion: ImportedClip::headings, as the whole motion tells them.
    std::vector<double> headings_in(const SampleGrid& part, const SampleGrid& all, const mobb::Clip& whole) const {
        const std::vector<double> headings = mobb::headings_of(whole, *options_.body);
        const auto first = headings.begin() + std::lround((part.begin - all.begin) / part.step);
        return {first, first + static_cast<std::ptrdiff_t>(part.count)};
    }

    const MotionFile& file_;
    const Motion& motion_;
    ChosenUp up_;
    GroundedMotion grounded_;
    std::optional<int> root_;
    std::optional<BodySize> body_;
    const ImportOptions& options_;
};

/// What ImportOptions::animation says for one of several: its name, unless others share it or it is a number and so an
/// index.
std::string animation_key(const std::vector<std::string>& names, std::size_t index) {
    const bool leads_here = std::count(names.begin(), names.end(), names[index]) == 1 && !parse_int(names[index]);
    return leads_here ? names[index] : std::to_string(index);
}

/// Which animations are asked for.
std::vector<std::size_t> chosen_animations(const std::vector<std::string>& names,
                                           const std::optional<std::string>& wanted) {
    std::vector<std::size_t> out;
    if (const std::optional<int> index = wanted ? parse_int(*wanted) : std::nullopt) {
        if (*index < 0 || static_cast<std::size_t>(*index) >= names.size()) {
            throw std::invalid_argument("there is no animation " + *wanted + "; it has " +
                                        std::to_string(names.size()) + ", counted from 0");
        }
        return {static_cast<std::size_t>(*index)};
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!wanted || names[i] == *wanted) out.push_back(i);
    }
    if (out.empty()) {
        throw std::invalid_argument("there is no animation " + in_quotes(*wanted) + "; it has " +
                                    std::to_string(names.size()) + ", the nearest is " +
                                    in_quotes(nearest(*wanted, names)));
    }
    if (wanted && out.size() > 1) {
        throw std::invalid_argument("there are " + std::to_string(out.size()) + " animations named " +
                                    in_quotes(*wanted) + "; give the index, such as " + std::to_string(out.front()));
    }
    return out;
}

/// One clip to be made of a file.
struct WantedClip {
    std::size_t animation;
    std::size_t who;  ///< a character; where an option names the root, that joint
};

struct WantedClips {
    std::vector<WantedClip> clips;      ///< at least one
    std::vector<std::string> left_out;  ///< animations of several that make no clip, and why
};

/// So many sentences stand for all: a file may have thousands.
void keep_a_few(std::vector<std::string>& left_out) {
    constexpr std::size_t kMostNamed = 3;
    if (left_out.size() <= kMostNamed + 1) return;
    const std::size_t more = left_out.size() - kMostNamed;
    left_out.resize(kMostNamed);
    left_out.push_back(std::to_string(more) + " more animations are left out");
}

/// Throws InputError; std::invalid_argument for options that name what the file has not.
WantedClips wanted_clips(const MotionFile& motions, const std::string& file, const ImportOptions& options) {
    const std::vector<std::size_t> animations = chosen_animations(motions.animations, options.animation);
    std::optional<std::size_t> root;
    if (options.root) root = root_by_name(motions.joints, *options.root);
    WantedClips out;
    for (const std::size_t i : animations) {
        const MovedCharacters moved = motions.moved(i);
        std::string why_none = moved.nothing;
        if (why_none.empty() && !root && moved.characters.empty()) {
            why_none = "moves none of the file's " + std::to_string(motions.characters.size()) +
                       " characters; give root to follow another joint";
        }
        if (!why_none.empty()) {
            const std::string place = "animation " + in_quotes(motions.animations[i]);
            if (animations.size() == 1) throw InputError(file, place, why_none);
            out.left_out.emplace_back(place).append(" is left out: it ").append(why_none);
        } else if (root) {
            const int character = motions.joints[*root].character;
            const auto is_it = [character](std::size_t of) { return static_cast<int>(of) == character; };
            // Of several animations only those count that move it.
            if (character < 0 || animations.size() == 1 || std::ranges::any_of(moved.characters, is_it))
                out.clips.push_back({i, *root});
        } else {
            for (const std::size_t character : moved.characters) out.clips.push_back({i, character});
        }
    }
    keep_a_few(out.left_out);
    if (!out.clips.empty()) return out;
    if (!out.left_out.empty()) throw InputError(file, "", out.left_out.front() + "; none of the others does more");
    throw std::invalid_argument("no animation moves " + in_quotes(*options.root) + "; name one with animation");
}

/// One of the wanted clips, and its root where an option names it.
RootedMotion motion_of(const MotionFile& motions, const WantedClip& clip, bool rooted) {
    if (rooted) return motions.rooted(clip.animation, clip.who);
    return {motions.motion(clip.animation, clip.who), std::nullopt};
}

}  // namespace

std::vector<ImportedClip> motion_clips(const MotionFile& motions, const std::filesystem::path& file,
                                       const ImportOptions& options) {
    const std::string path = file.string();
    const auto refuse = [&](bool given, const char* option) {
        if (given)
            throw InputError(path, "",
                             std::string(option) + " applies to tracks (CSV, trajectories) alone; leave it out");
    };
    refuse(options.id.has_value(), "id");
    refuse(options.dt.has_value(), "dt");

    const std::vector<std::string>& names = motions.animations;
    const WantedClips wanted = at_place(path, "", [&] { return wanted_clips(motions, path, options); });
    const std::optional<BodySize> body = at_place(path, "", [&] { return tallest_body(motions, options); });
    double poses_left = kMaxJointPosesOfFile;
    MadeSamples made;
    std::vector<ImportedClip> clips;
    for (const WantedClip& of : wanted.clips) {
        const std::size_t i = of.animation;
        const std::string place = names.size() > 1 ? "animation " + in_quotes(names[i]) : "";
        ImportedClip& clip = clips.emplace_back(at_place(path, place, [&] {
            const RootedMotion it = motion_of(motions, of, options.root.has_value());
            return MotionImport(motions, it, body, options).make(poses_left, made);
        }));
        clip.facts.animation = names[i];
        for (const std::string& warning : wanted.left_out) clip.facts.warnings.push_back({warning});
        const bool several = motions.characters.size() > 1;
        clip.name = names.size() > 1 || several ? names[i] : input_stem(file);
        if (names.size() > 1) {
            clip.animation = animation_key(names, i);
            if (clip.animation != names[i]) clip.name += " #" + std::to_string(i);
        }
        if (!several) continue;
        clip.root = clip.facts.root;
        clip.name += " · " + clip.root;
    }
    const auto begin_of = [](const ImportedClip& clip) { return *clip.facts.first_key; };
    const double earliest = begin_of(*std::ranges::min_element(clips, {}, begin_of));
    for (ImportedClip& clip : clips) clip.start = begin_of(clip) - earliest;
    return clips;
}

ImportOffer motion_offer(const MotionFile& motions, const std::filesystem::path& file, const ImportOptions& options) {
    return at_place(file.string(), "", [&] {
        const std::vector<std::string>& names = motions.animations;
        const WantedClip first = wanted_clips(motions, file.string(), options).clips.front();
        const RootedMotion it = motion_of(motions, first, options.root.has_value());
        ImportOffer out = MotionImport(motions, it, tallest_body(motions, options), options).offer();
        if (names.size() > 1) {
            OptionOffer animations{"animation", "", "the file has several: name one", true};
            for (std::size_t i = 0; i < names.size(); ++i) {
                if (!motions.moved(i).nothing.empty()) continue;
                const std::string key = animation_key(names, i);
                animations.choices.push_back({key, key == names[i] ? key : key + ": " + names[i]});
            }
            // What has one choice alone is no choice.
            if (animations.choices.size() > 1 || options.animation)
                out.options.insert(out.options.begin(), std::move(animations));
        }
        return out;
    });
}

}  // namespace mobbscope
