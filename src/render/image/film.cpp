#include <base/error.h>
#include <base/file.h>
#include <base/process.h>
#include <base/text.h>
#include <base/work_queue.h>
#include <render/image/film.h>

#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <exception>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace mobbscope {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostUnsent = 2;       // pictures
constexpr std::size_t kMostSaid = 64 << 10;  // bytes of what ffmpeg says
constexpr double kPatience = 120;            // seconds that ffmpeg may take no picture
constexpr double kPatienceAtTheEnd = 600;    // ... and that it may take to end
constexpr double kPatienceWithAnswer = 20;   // ... to say which encoders it has

/// Encoders of one kind of film: the first that an ffmpeg has is taken.
struct Encoder {
    std::string_view extension;
    std::string_view name;
    std::vector<std::string> arguments;
};

/// With each a line or a letter looks as in a PNG, and to encode takes less time than to draw.
const std::vector<Encoder>& encoders() {
    static const std::vector<Encoder> table{
        {".mp4", "libx264", {"-preset", "veryfast", "-crf", "18", "-movflags", "+faststart"}},
        {".mp4", "libopenh264", {"-rc_mode", "quality", "-qmin", "10", "-qmax", "20", "-movflags", "+faststart"}},
        {".webm", "libvpx-vp9", {"-deadline", "realtime", "-cpu-used", "6", "-row-mt", "1", "-crf", "10", "-b:v", "0"}},
        {".webm", "libvpx", {"-deadline", "realtime", "-cpu-used", "8", "-crf", "8", "-b:v", "20M", "-qmax", "24"}}};
    return table;
}

/// The lines, without the part of ffmpeg and the address that each comes from.
std::vector<std::string> lines_said(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream lines(text);
    for (std::string whole; std::getline(lines, whole);) {
        std::string_view line = trimmed(whole);
        const std::size_t end = line.starts_with('[') ? line.find("] ") : std::string_view::npos;
        if (end != std::string_view::npos) line.remove_prefix(end + 2);
        out.emplace_back(line);
    }
    return out;
}

/// Whether ffmpeg's list of encoders has one.
bool lists(const std::string& list, std::string_view encoder) {
    std::istringstream lines(list);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind, name;
        if (words >> kind >> name && name == encoder) return true;
    }
    return false;
}

/// ffmpeg's list of encoders. Throws MachineError.
std::string listed_encoders(const fs::path& film, const fs::path& program) {
    const Descriptor said = memory_file();
    Process process(program, {"-hide_banner", "-encoders"}, {-1, said.get(), -1});
    const std::optional<int> status = process.wait(kPatienceWithAnswer);
    if (status == 0) return beginning_of(said, kMostSaid);
    throw MachineError(film.string() + ": " + program.string() + " does not say which encoders it has: it " +
                       (status ? how_it_ended(*status) : "does not answer"));
}

/// Thrown where ffmpeg takes no more pictures; what to say of it is found out where the film is added to.
struct NotTaken : std::exception {
    const char* what() const noexcept override { return "a picture of a film was not taken"; }
};

}  // namespace

fs::path find_ffmpeg(const fs::path& film) {
    if (std::optional<fs::path> program = program_in_path("ffmpeg")) return *std::move(program);
    throw MachineError(film.string() +
                       ": films need ffmpeg, which is not in PATH; install it (Debian: apt install ffmpeg), or "
                       "write pictures, such as -o " +
                       shell_word(fs::path(film).replace_extension(".png").string()));
}

FilmMaker find_film_maker(const fs::path& film) {
    const fs::path program = find_ffmpeg(film);
    const std::string list = listed_encoders(film, program);
    const std::string extension = lower_extension(film);
    std::vector<std::string_view> tried;
    for (const Encoder& encoder : encoders()) {
        if (encoder.extension != extension) continue;
        tried.push_back(encoder.name);
        if (!lists(list, encoder.name)) continue;
        FilmMaker out{program, {"-c:v", std::string(encoder.name)}};
        out.encoding.insert(out.encoding.end(), encoder.arguments.begin(), encoder.arguments.end());
        return out;
    }
    throw MachineError(film.string() + ": " + program.string() + " has no encoder for " + extension + " films (" +
                       either(tried) + "); install an ffmpeg that has, or name the film " +
                       (extension == ".mp4" ? ".webm" : ".mp4"));
}

/// ffmpeg, and what hands it the pictures.
struct Film::State {
    State(const FilmMaker& maker, const fs::path& name, PictureSize size, double rate)
        : file(name),
          program(maker.program),
          written(name),
          process(program, arguments(maker, name, size, rate),
                  {pictures.there.get(), written.descriptor(), said.get()}) {
        pictures.there.close();
    }

    static std::vector<std::string> arguments(const FilmMaker& maker, const fs::path& name, PictureSize size,
                                              double rate) {
        std::vector<std::string> out{"-hide_banner", "-nostdin", "-loglevel", "error", "-xerror", "-f", "rawvideo"};
        const auto add = [&out](std::initializer_list<std::string> words) {
            out.insert(out.end(), words.begin(), words.end());
        };
        add({"-pixel_format", "rgb0", "-video_size", size_word(size), "-framerate", format_double(rate)});
        add({"-i", "pipe:0"});
        // Players take large films to have these colours, whatever is written; so they are written.
        add({"-vf", "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-colorspace", "bt709"});
        add({"-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"});
        out.insert(out.end(), maker.encoding.begin(), maker.encoding.end());
        // Its standard output is a file, in which it may go back, under no name yet.
        add({"-f", lower_extension(name).substr(1), "-y", "file:/dev/stdout"});
        return out;
    }

    /// On the thread that sends, which does not touch `process`.
    void send(const Image& picture, std::size_t times) const {
        const char* bytes = static_cast<const char*>(static_cast<const void*>(picture.rgba.data()));
        for (std::size_t i = 0; i < times; ++i) {
            if (!send_all(pictures.here, {bytes, picture.rgba.size()}, kPatience)) throw NotTaken();
        }
    }

    bool tells_of_error() const {
        const std::vector<std::string> lines = lines_said(beginning_of(said, kMostSaid));
        return std::ranges::any_of(lines, [](const std::string& line) { return line.starts_with("Error"); });
    }

    /// What to say depends on how far ffmpeg is: it ended well, or works on.
    [[noreturn]] void refuse(const char* ended_well, const char* works_on) {
        constexpr double kDying = 2;  // seconds
        const std::optional<int> status = process.wait(kDying);
        const std::vector<std::string> lines = lines_said(beginning_of(said, kMostSaid));
        std::string why = works_on;
        if (status) why = *status == 0 ? ended_well : how_it_ended(*status);
        if (!lines.empty() && !lines.front().empty()) why += " (" + lines.front() + ")";
        throw MachineError(file.string() + ": cannot be written: " + program.string() + ' ' + why);
    }

    [[noreturn]] void refuse_pictures() { refuse("ended before it had all pictures", "takes no more pictures"); }

    fs::path file, program;
    NewFile written;
    Descriptor said = memory_file();
    Connection pictures = Connection::make();
    Process process;
    WorkQueue sending{kMostUnsent};
};

Film::Film(const FilmMaker& maker, const fs::path& file, PictureSize size, double rate)
    : state_(std::make_unique<State>(maker, file, size, rate)) {}

Film::~Film() {
    // The thread that waits for it to take a picture then goes on.
    state_->process.kill();
    ::shutdown(state_->pictures.here.get(), SHUT_RDWR);
}

void Film::add(Image picture, std::size_t times) {
    try {
        state_->sending.add([&state = *state_, picture = std::move(picture), times] { state.send(picture, times); });
    } catch (const NotTaken&) {
        state_->refuse_pictures();
    }
}

std::size_t Film::finish() {
    State& state = *state_;
    try {
        state.sending.finish();
    } catch (const NotTaken&) {
        state.refuse_pictures();
    }
    send_end(state.pictures.here);
    struct stat written {};
    // Some versions end with status 0 although the disk is full, and only say so.
    const bool ended_well = state.process.wait(kPatienceAtTheEnd) == 0 && !state.tells_of_error();
    if (!ended_well || ::fstat(state.written.descriptor(), &written) != 0 || written.st_size == 0)
        state.refuse("did not write all", "has all pictures and does not end");
    return state.written.take_place();
}

}  // namespace mobbscope
