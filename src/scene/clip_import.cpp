#include <base/text.h>
#include <import/clip/held_steps.h>
#include <import/clip/sampling.h>
#include <import/skeleton/warp.h>
#include <scene/clip_import.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <unordered_map>

namespace mobbscope {

namespace {

/// Of a file with several, the one that the options name: of tracks all are made at once, so that the file is gone
/// through once however many are asked for.
ImportOptions without_id(ImportOptions options) {
    options.id.reset();
    return options;
}

const ImportedClip& one_of(const std::vector<ImportedClip>& all, const ImportOptions& options,
                           const std::filesystem::path& file) {
    const auto is_it = [&](const ImportedClip& clip) { return !options.id || clip.id == *options.id; };
    const auto at = std::ranges::find_if(all, is_it);
    if (at == all.end()) {
        throw InputError(file, "track " + in_quotes(*options.id) + " is not there, or not in this time");
    }
    if (std::count_if(at, all.end(), is_it) > 1) {
        throw InputError(file, at->id.empty()
                                   ? "it has several animations or characters: name one with animation and root"
                                   : "it has several tracks: name one");
    }
    return *at;
}

}  // namespace

std::shared_ptr<const SourceFile> source_file(const std::filesystem::path& path,
                                              const std::shared_ptr<const SourceFile>& known) {
    std::error_code ignored;
    const auto written = std::filesystem::last_write_time(path, ignored);
    const std::uintmax_t size = std::filesystem::file_size(path, ignored);
    if (known && known->path == path && known->written == written && known->size == size) return known;
    return std::make_shared<const SourceFile>(SourceFile{path, written, size, parse_clip_file(path)});
}

void name_own_radius(SceneClip& clip) {
    std::optional<Radius>& radius = clip.options.radius;
    if (radius && std::holds_alternative<std::shared_ptr<const RadiusTable>>(*radius))
        radius = metres_of(*radius, clip.options.id.value_or(""), clip.facts.label);
}

std::filesystem::path source_path(const Scene& scene, const SceneClip& clip) {
    return scene.file.parent_path() / *clip.source;
}

std::vector<int> clips_of_same_source(const Scene& scene, int clip) {
    std::vector<int> out;
    const std::optional<std::string>& source = scene.clips.at(static_cast<std::size_t>(clip)).source;
    for (int i = 0; i < static_cast<int>(scene.clips.size()); ++i) {
        if (scene.clips[static_cast<std::size_t>(i)].source == source) out.push_back(i);
    }
    return out;
}

std::vector<ImportedClip> import_warped(const ImportFile& import, const ImportOptions& options, const ClipWarp* warp) {
    if (!warp) return import(options);
    if (!options.trim || options.origin.value_or(Origin::keep) != Origin::keep)
        throw std::invalid_argument(
            "a warped clip is a part of its source and stays in its place: give trim, and no origin");
    const double dt = 1 / options.fps.value_or(kDefaultFps);
    ImportOptions longer = options;
    longer.trim->second += dt;
    std::vector<ImportedClip> out = import(longer);
    for (ImportedClip& clip : out) {
        if (!clip.skeleton) throw std::invalid_argument("only motion of joints can be warped; leave it out");
        if (clip.clip->count() < sample_count(longer.trim->first, longer.trim->second, dt) || clip.clip->count() < 2)
            throw std::invalid_argument("the source has no frame behind the part that is warped; trim it earlier");
        WarpedClip made = warped(*clip.clip, *clip.skeleton, *warp, options.radius.has_value());
        clip.clip = std::move(made.clip);
        clip.skeleton = std::move(made.skeleton);
        clip.headings.clear();  // it moves otherwise now
    }
    return out;
}

std::vector<ReimportedClip> reimport(const Scene& scene, const SourceFile& file,
                                     const std::vector<std::pair<int, ImportOptions>>& wanted) {
    std::vector<ReimportedClip> out;
    std::optional<ImportOptions> made_with;
    std::vector<ImportedClip> made;
    for (const auto& [index, options] : wanted) {
        const SceneClip& was = scene.clips.at(static_cast<std::size_t>(index));
        const bool alone = wanted.size() == 1 || was.warp;
        const ImportOptions common = alone ? options : without_id(options);
        if (was.warp || made_with != common) {
            made = at_place(file.path, "", [&] {
                return import_warped([&](const ImportOptions& of) { return file.parsed.clips(of); }, common,
                                     was.warp.get());
            });
            made_with = was.warp ? std::nullopt : std::optional(common);
        }
        const ImportedClip& imported = one_of(made, options, file.path);
        out.push_back({index,
                       {was.name, was.source, options, imported.clip, imported.facts, imported.skeleton, imported.start,
                        was.warp}});
        SceneClip& is = out.back().is;
        if (options.radius) is.options.body.reset();
        is.body = imported.body;
        is.headings = imported.headings;
        name_own_radius(is);
        at_place(file.path, "", [&] {
            if (was.turn) bend(is, *was.turn);
            make_members(is);
        });
    }
    return out;
}

ReimportedClip with_motion(const Scene& scene, int clip, mobb::Motion motion) {
    ReimportedClip made{clip, scene.clips.at(static_cast<std::size_t>(clip))};
    const mobb::Clip& was = *made.is.clip;
    made.is.clip = std::make_shared<const mobb::Clip>(
        was.dt(), std::vector<mobb::Disk>(was.samples().begin(), was.samples().end()), motion);
    make_members(made.is);
    made.is.digest.reset();
    made.is.facts.warnings.clear();
    warn_of_long_held_step(*made.is.clip, made.is.facts.warnings);
    if (made.is.headings.empty()) warn_of_no_heading(*made.is.clip, made.is.body, made.is.facts.warnings);
    return made;
}

void replace_clips(Scene& scene, const std::vector<ReimportedClip>& clips) {
    std::unordered_map<int, double> started;  // by clip: when it did before
    for (const ReimportedClip& made : clips) {
        if (static_cast<std::size_t>(made.clip) >= scene.clips.size()) continue;
        SceneClip& clip = scene.clips[static_cast<std::size_t>(made.clip)];
        if (clip.name != made.is.name || clip.source != made.is.source) continue;
        started[made.clip] = clip.start;
        clip = made.is;
    }
    const auto follow = [&](int clip, mobb::Placement& placement) {
        const auto at = started.find(clip);
        if (at == started.end()) return false;
        const SceneClip& now = scene.clips[static_cast<std::size_t>(clip)];
        if (placement.start == at->second) placement.start = now.start;
        mobb::checked(placement, now.clip->most_start());
        return true;
    };
    for (Agent& agent : scene.agents) follow(agent.clip, agent.placement);
    for (SceneQuery& query : scene.queries) {
        const bool a = follow(query.a.clip, query.a.placement);
        const bool b = follow(query.b.clip, query.b.placement);
        if (!a && !b) continue;
        query.trace.reset();
        if (!query.expect) continue;
        query.expect->contact.reset();
        query.expect->tests = {};
        if (!query.expect->collides) query.expect.reset();
    }
}

}  // namespace mobbscope
