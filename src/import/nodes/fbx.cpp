#include <base/error.h>
#include <base/text.h>
#include <import/nodes/node_files.h>
#include <import/nodes/node_scene.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
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

[[noreturn]] void fail_call(int error, const char* what) {
    throw std::system_error(error, std::generic_category(), what);
}

class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int get() const { return value_; }
    void close() {
        if (value_ >= 0) ::close(value_);
        value_ = -1;
    }

  private:
    int value_;
};

class FileActions {
  public:
    FileActions() { ::posix_spawn_file_actions_init(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
    posix_spawn_file_actions_t* get() { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_{};
};

int wait_for(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        // Where the program ignores SIGCHLD there is no status to collect; the output says enough.
        if (errno != EINTR) return 0;
    }
    return status;
}

}  // namespace

MotionFile read_fbx(const fs::path& file) {
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

ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments, double seconds,
                      std::size_t most_output) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail_call(errno, "no pipe");
    Descriptor from(ends[0]);
    Descriptor to(ends[1]);

    FileActions actions;
    ::posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(actions.get(), to.get(), STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(actions.get(), STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::string name = program.string();
    std::vector<std::string> copies = arguments;  // the interface wants writable strings
    std::vector<char*> argv{name.data()};
    for (std::string& argument : copies) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    const int error = ::posix_spawn(&child, name.c_str(), actions.get(), nullptr, argv.data(), environ);
    if (error != 0) fail_call(error, "cannot be started");
    to.close();

    ChildResult result;
    const auto kill_as = [&](ChildEnd end) {
        ::kill(child, SIGKILL);
        wait_for(child);
        result.end = end;
        return result;
    };
    using Clock = std::chrono::steady_clock;
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    std::array<char, 65536> buffer{};
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd wanted{from.get(), POLLIN, 0};
        const int ready = left <= 0 ? 0 : ::poll(&wanted, 1, static_cast<int>(std::min<long long>(left, 60'000)));
        if (ready < 0 && errno == EINTR) continue;
        if (ready == 0 && Clock::now() < deadline) continue;
        if (ready <= 0) return kill_as(ChildEnd::timed_out);
        const ssize_t size = ::read(from.get(), buffer.data(), buffer.size());
        if (size < 0 && errno == EINTR) continue;
        if (size <= 0) break;
        result.output.append(buffer.data(), static_cast<std::size_t>(size));
        if (result.output.size() > most_output) return kill_as(ChildEnd::too_much_output);
    }
    const int status = wait_for(child);
    if (WIFSIGNALED(status)) {
        result.end = ChildEnd::signalled;
        result.code = WTERMSIG(status);
    } else {
        result.code = WEXITSTATUS(status);
    }
    return result;
}

}  // namespace mobbscope
