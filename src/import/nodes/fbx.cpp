#include <base/error.h>
#include <base/text.h>
#include <import/nodes/child_process.h>
#include <import/nodes/fbx.h>
#include <import/nodes/node_scene.h>
#include <import/nodes/scene_packet.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace mobbscope {

namespace {

namespace fs = std::filesystem;

// A wall clock, so that a reader that sleeps ends too; it limits its own processor time more closely.
constexpr double kSeconds = 60;
constexpr double kSecondsPerByte = 2e-6;
constexpr std::size_t kMostOutput = std::size_t{1} << 30;

/// Where the reader's program is: named by the environment, as installed, beside this program, or as built.
fs::path reader_program() {
    std::vector<fs::path> places;
    if (const char* named = std::getenv("MOBBSCOPE_FBX_READER")) places.emplace_back(named);
    std::error_code error;
    const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
    places.push_back(here / MOBBSCOPE_FBX_READER_FROM_BIN);
    places.push_back(here / fs::path(MOBBSCOPE_FBX_READER_FROM_BIN).filename());
    places.emplace_back(MOBBSCOPE_FBX_READER_AS_BUILT);
    const auto found = std::find_if(places.begin(), places.end(),
                                    [](const fs::path& place) { return ::access(place.c_str(), X_OK) == 0; });
    if (found == places.end()) {
        throw MachineError("FBX files need the program " + places[places.size() - 2].filename().string() +
                           ", which is not installed; install it, or name it in MOBBSCOPE_FBX_READER");
    }
    return *found;
}

/// Assimp would try its other readers on what is no FBX.
void check_header(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    const std::string name = file.string();
    if (status.type() == fs::file_type::not_found) throw InputError(name, "", "no such file; check the path");
    if (status.type() != fs::file_type::regular) throw InputError(name, "", "is no regular file; give an FBX file");
    std::array<char, 4096> start{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(name, "", "cannot be read; check its permissions");
    stream.read(start.data(), start.size());
    const std::string_view text(start.data(), static_cast<std::size_t>(stream.gcount()));
    const bool is_fbx = text.starts_with("Kaydara FBX Binary") || text.find("FBXHeaderExtension") != text.npos;
    if (!is_fbx)
        throw InputError(name, "header", "is neither binary nor text FBX; the file is damaged or of another kind");
}

std::string what_happened(const ChildResult& result) {
    if (result.end == ChildEnd::timed_out || (result.end == ChildEnd::signalled && result.code == SIGXCPU)) {
        return "reading it takes too long";
    }
    if (result.end == ChildEnd::too_much_output) return "it holds more than can be read";
    if (result.end == ChildEnd::signalled)
        return "the FBX reader crashed on it (signal " + std::to_string(result.code) + ")";
    return "the FBX reader gave up on it";
}

/// On one line, in printable characters.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    return text.substr(0, 200);
}

}  // namespace

std::unique_ptr<MotionFile> read_fbx(const fs::path& file) {
    const std::string name = file.string();
    constexpr std::string_view kRemedy = "; export it again as binary FBX 2014/2015, or as glTF";
    check_header(file);
    const fs::path program = reader_program();
    ChildResult result;
    std::error_code error;
    const auto size = static_cast<double>(fs::file_size(file, error));
    try {
        // An absolute path cannot be mistaken for anything else.
        result = run_child(program, {fs::absolute(file).string()}, kSeconds + kSecondsPerByte * size, kMostOutput);
    } catch (const std::system_error& failure) {
        throw MachineError(program.string() + ": " + failure.what());
    }
    if (result.end != ChildEnd::exited || result.code != 0) {
        throw InputError(name, "", what_happened(result) + std::string(kRemedy));
    }
    NodeScene scene;
    try {
        scene = unpack(result.output);
    } catch (const std::length_error&) {
        throw InputError(name, "", "holds numbers that no clip can have" + std::string(kRemedy));
    } catch (const std::runtime_error& refusal) {
        throw InputError(name, "", "cannot be read (" + one_line(refusal.what()) + ")" + std::string(kRemedy));
    }
    scene.file = name;
    scene.format = "fbx";
    scene.has_pivots = true;
    for (std::size_t i = 0; i < scene.animations.size(); ++i) {
        NodeAnimation& animation = scene.animations[i];
        animation.name = animation.name.empty() ? "#" + std::to_string(i) : one_line(animation.name);
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        std::string& node = scene.nodes[i].name;
        node = node.empty() ? "node" + std::to_string(i) : one_line(node);
    }
    if (scene.animations.empty()) {
        throw InputError(name, "", "holds no animation; export the clip with its animation");
    }
    return node_motion_file(std::move(scene));
}

}  // namespace mobbscope
