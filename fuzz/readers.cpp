#include "readers.h"

#include <app/document/settings.h>
#include <app/script/script.h>
#include <base/descriptor.h>
#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <cases/case_file.h>
#include <cases/case_report.h>
#include <cases/result_line.h>
#include <explain/certificate_file.h>
#include <explain/proof_words.h>
#include <import/bvh/bvh.h>
#include <import/clip/import_options.h>
#include <import/clip/radii.h>
#include <import/fbx/fbx.h>
#include <import/import.h>
#include <import/nodes/gltf.h>
#include <import/skeleton/motion.h>
#include <import/skeleton/motion_clips.h>
#include <mobb/tree.h>
#include <picture_tests/held_answers.h>
#include <picture_tests/picture_state.h>
#include <picture_tests/shot.h>
#include <picture_tests/test_case.h>
#include <render/image/png.h>
#include <scene/fitted_scene.h>
#include <scene/scene.h>
#include <scene/view_options.h>
#include <support/temp_folder.h>

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::fuzz {

namespace {

const std::filesystem::path kSeedFolder = MOBBSCOPE_SOURCE_DIR "/fuzz/seeds";

void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}

/// A file in memory, for readers that take a name.
class MemoryFile {
  public:
    explicit MemoryFile(const std::string& bytes) : file_(::memfd_create("fuzz", MFD_CLOEXEC)) {
        if (!file_.is_open() || ::write(file_.get(), bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            throw std::runtime_error("no file in memory");
    }

    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_.get()); }

  private:
    Descriptor file_;
};

/// Of this process, for what is written and for files whose names are given.
const std::filesystem::path& scratch_folder() {
    static const testing::TempFolder folder;
    return folder.path();
}

std::uint32_t hash_of(std::string_view bytes) {
    std::uint32_t hash = 2166136261;
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619;
    return hash >> 8;
}

/// Options that depend on the bytes alone: half of the time none.
ImportOptions some_options(std::string_view bytes, Contents contents) {
    const std::uint32_t hash = hash_of(bytes);
    ImportOptions out;
    if (hash % 2 == 0) return out;
    if (hash % 3 == 0) out.fps = hash % 9 == 0 ? 1000 : 12;
    if (hash % 5 == 0) out.trim = {0.05, 0.4};
    if (hash % 5 == 1) out.origin = Origin::start_heading;
    if (hash % 7 == 0) out.unit = contents == Contents::skeletons ? "auto" : "cm";
    if (hash % 11 == 0) out.motion = mobb::Motion::linear;
    if (contents == Contents::skeletons) return out;
    if (hash % 13 == 0) out.dt = 0.1;
    if (hash % 17 == 0) out.radius = 0.3;
    if (hash % 19 == 0) out.id = "1";
    if (contents == Contents::table && hash % 23 == 0) out.columns = "id=id,frame=t,x=x,y=y";
    return out;
}

/// Poses beyond its keys too.
void pose_everything(const MotionFile& file) {
    for (std::size_t animation = 0; animation < file.animations.size(); ++animation) {
        for (std::size_t character = 0; character < file.characters.size(); ++character) {
            const std::shared_ptr<const Motion> motion = file.motion(animation, character);
            std::vector<glm::dvec3> positions(motion->joints().size());
            std::vector<glm::dquat> rotations(positions.size());
            const MotionTimes& times = motion->times();
            for (const double share : {-1.0, 0.0, 0.3, 1.0, 2.0})
                motion->pose(times.first + share * (times.last - times.first), positions, rotations);
            motion->rest();
        }
    }
}

void use_clips(const std::vector<ImportedClip>& clips) {
    require(!clips.empty(), "a file without clips was let in");
    for (const ImportedClip& clip : clips) {
        require(clip.clip && clip.clip->count() > 0, "a clip without samples was let in");
        if (clip.clip->count() < 200) mobb::Tree(clip.clip, {});
    }
}

void use_motions(const MotionFile& file, const std::string& bytes) {
    const ImportOptions options = some_options(bytes, Contents::skeletons);
    pose_everything(file);
    motion_offer(file, "fuzz", options);
    use_clips(motion_clips(file, "fuzz", options));
}

std::string view_text(const ViewState& view) {
    std::ostringstream out;
    JsonWriter json(out);
    write_view(json, view);
    return out.str();
}

ViewState view_in(const std::string& text) {
    const std::string name = "fuzz.json";
    const JsonText value = parse_json(text, name);
    return read_view(JsonPlace(value, name));
}

/// The one case that results are of.
std::vector<picture_tests::CaseFile> the_case() { return {{"a", kSeedFolder / "case/a.case.json"}}; }

}  // namespace

void read_fbx(const std::string& bytes) { use_motions(parse_fbx(bytes, "fuzz.fbx"), bytes); }
void read_gltf(const std::string& bytes) { use_motions(parse_gltf(bytes, kSeedFolder / "gltf/fuzz.gltf"), bytes); }
void read_bvh(const std::string& bytes) { use_motions(bvh_motion(parse_bvh(bytes, "fuzz.bvh")), bytes); }

void read_tracks(const FileReader& reader, const std::string& bytes) {
    const ImportOptions options = some_options(bytes, reader.contents);
    // What lies beside a file does so beside the folder of seeds.
    const ParsedFile parsed = reader.parse(kSeedFolder / reader.name, bytes);
    parsed.offer(options);
    use_clips(parsed.clips(options));
}

void read_radius_table(const std::string& bytes) {
    const MemoryFile file(bytes);
    const RadiusTable table = read_radii(file.path());
    for (const auto& [key, radius] : table.radii) require(table.of(key) == radius, "a radius is another one");
}

void read_any_file(const std::string& bytes) {
    const MemoryFile file(bytes);
    const ParsedFile parsed = parse_clip_file(file.path());
    parsed.offer({});
    use_clips(parsed.clips({}));
}

void read_scene(const std::string& bytes) {
    const Scene scene = parse_scene(bytes, "fuzz.json", kSeedFolder);
    const std::string written = to_json(scene, true);
    const std::string again = [&] {
        try {
            return to_json(parse_scene(written, "again.json", kSeedFolder), true);
        } catch (const InputError& error) {
            throw std::logic_error(std::string("a scene that was written is refused: ") + error.what());
        }
    }();
    require(written == again, "a scene that was written is read as another one");
    std::size_t samples = 0;
    for (const SceneClip& clip : scene.clips) samples += static_cast<std::size_t>(clip.clip->count());
    if (samples > 500) return;
    const FittedScene fitted(scene, scene.fit);
    for (std::size_t i = 0; i < std::min<std::size_t>(fitted.queries().size(), 20); ++i)
        record(fitted, fitted.queries()[i]);
}

void read_certificate_file(const std::string& bytes) {
    // The scene that the seeds are about.
    static const FittedScene scene(parse_scene(R"({"clips": {
        "walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.5], [2, 0.5, 0.4], [3, 0.5, 0.4]]},
        "stand": {"dt": 2, "motion": "linear", "samples": [[0, 0, 0.3]]}},
        "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "stand", "translate": [0, 3]},
                   {"name": "C", "clip": "stand", "translate": [2, 0]}]})",
                                               "scene.json", kSeedFolder),
                                   {});
    for (const QueryCertificate& each : read_certificates(bytes, "fuzz.json", scene)) {
        const SceneQuery query = scene.queries()[static_cast<std::size_t>(each.query)];
        const mobb::PlacedTree a = scene.placed(query.a), b = scene.placed(query.b);
        const bool collide = mobb::direct_search(a.placed_clip(), b.placed_clip()).has_value();
        const std::string why = why_not_proven(a.placed_clip(), b.placed_clip(), each.proof);
        require(!why.empty() || collide == each.proof.contact.has_value(), "what is false was proven");
        proof_words(each.proof, {});
    }
}

void read_case(const std::string& bytes) {
    const std::string name = "fuzz.case.json";
    const std::filesystem::path folder = kSeedFolder / "case";
    const JsonText value = parse_json(bytes, name);
    const JsonPlace root(value, name);
    picture_tests::read_terms(root, folder);
    picture_tests::read_shot(root, folder);
}

void read_golden(const std::string& bytes) {
    using picture_tests::Held;
    static const picture_tests::Case tested =
        picture_tests::read_case(MOBBSCOPE_SOURCE_DIR "/tests/goldens/answers.case.json");
    static const picture_tests::HeldAnswers held(tested.shot, tested.terms);
    const auto is_of = [&](Held what) { return bytes.find(picture_tests::name(what)) != std::string::npos; };
    const Held what = is_of(Held::trace) ? Held::trace : is_of(Held::fit) ? Held::fit : Held::answers;
    held.differences(what, bytes, "fuzz.golden.json");
}

void read_script(const std::string& bytes) {
    app::Script::parse(bytes, "fuzz.script");
    app::Script::parse(bytes, "fuzz.script", app::ScriptOutput::refused);
}

void read_view_state(const std::string& bytes) {
    const ViewState view = view_in(bytes);
    const std::string written = view_text(view);
    try {
        require(view_in(written) == view, "a view that was written is read as another one");
    } catch (const InputError& error) {
        throw std::logic_error(std::string("a view that was written is refused: ") + error.what());
    }
}

void read_settings(const std::string& bytes) {
    const std::filesystem::path file = scratch_folder() / "settings.json";
    std::ofstream(file, std::ios::binary) << bytes;
    app::Settings settings = app::load_settings(file);
    app::SettingsFile(file).save(settings);
    require(app::load_settings(file) == settings, "settings that were saved are read as others");
}

void read_png_file(const std::string& bytes) {
    const Image image = read_png_bytes(bytes);
    if (image.rgba.size() < 1'000'000)
        require(read_png_bytes(png_bytes(image)).rgba == image.rgba, "a picture that was written is another one");
}

void read_state(const std::string& bytes) {
    static const std::string other = read_file(MOBBSCOPE_SOURCE_DIR "/tests/app/review_cases/moved.state.json");
    require(picture_tests::compare_states(bytes, bytes, "a").lines.empty(), "a state is not what it is");
    picture_tests::compare_states(bytes, other, "a");
    picture_tests::compare_states(other, bytes, "b");
}

void read_result_line(const std::string& bytes) { picture_tests::read_result_line(bytes, the_case()); }

void read_request_line(const std::string& bytes) {
    const picture_tests::CaseRequest request = picture_tests::read_request_line(bytes);
    const std::string written = picture_tests::request_line(request);
    require(picture_tests::request_line(picture_tests::read_request_line(written)) == written,
            "a request that was written is read as another one");
}

void read_report(const std::string& bytes) {
    const MemoryFile file(bytes);
    const picture_tests::CaseReport report =
        picture_tests::read_case_report(file.path(), kSeedFolder / "case", the_case());
    for (const picture_tests::CaseResult& result : report.results)
        picture_tests::check_bytes(result.fresh, report.file);
}

}  // namespace mobbscope::fuzz
