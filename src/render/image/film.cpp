#include <base/error.h>
#include <base/file.h>
#include <base/process.h>
#include <base/text.h>
#include <base/work_queue.h>
#include <render/image/film.h>

#include <sys/socket.h>
#include <sys/stat.h>

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

/// The first line, without the part of ffmpeg and the address that it comes from.
std::string first_line(const std::string& text) {
    std::string_view line = trimmed(std::string_view(text).substr(0, text.find('\n')));
    if (line.starts_with('[')) {
        const std::size_t end = line.find("] ");
        if (end != std::string_view::npos) line.remove_prefix(end + 2);
    }
    return std::string(line);
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

}  // namespace

FilmMaker find_film_maker(const fs::path& film) {
    const std::optional<fs::path> program = program_in_path("ffmpeg");
    if (!program) {
        throw MachineError(film.string() +
                           ": films need ffmpeg, which is not in PATH; install it (Debian: apt install ffmpeg), or "
                           "write pictures, such as -o " +
                           shell_word(fs::path(film).replace_extension(".png").string()));
    }
    const std::string list = listed_encoders(film, *program);
    const std::string extension = lower_extension(film);
    std::vector<std::string_view> tried;
    for (const Encoder& encoder : encoders()) {
        if (encoder.extension != extension) continue;
        tried.push_back(encoder.name);
        if (!lists(list, encoder.name)) continue;
        FilmMaker out{*program, {"-c:v", std::string(encoder.name)}};
        out.encoding.insert(out.encoding.end(), encoder.arguments.begin(), encoder.arguments.end());
        return out;
    }
    throw MachineError(film.string() + ": " + program->string() + " has no encoder for " + extension + " films (" +
                       either(tried) + "); install an ffmpeg that has, or name the film " +
                       (extension == ".mp4" ? ".webm" : ".mp4"));
}

PictureSize film_size(PictureSize size) { return {size.width + size.width % 2, size.height + size.height % 2}; }

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

    void send(const Image& picture) {
        const char* bytes = static_cast<const char*>(static_cast<const void*>(picture.rgba.data()));
        if (!send_all(pictures.here, {bytes, picture.rgba.size()}, kPatience))
            refuse("ended before it had all pictures");
    }

    bool tells_of_error() const { return beginning_of(said, kMostSaid).find("rror") != std::string::npos; }

    /// `unexpected`: what happened where ffmpeg says that all went well.
    [[noreturn]] void refuse(const char* unexpected) {
        constexpr double kDying = 2;  // seconds
        const std::optional<int> status = process.wait(kDying);
        const std::string line = first_line(beginning_of(said, kMostSaid));
        std::string why = "takes no more pictures";
        if (status) why = *status == 0 ? unexpected : how_it_ended(*status);
        if (!line.empty()) why += " (" + line + ")";
        throw MachineError(file.string() + ": cannot be written: " + program.string() + ' ' + why);
    }

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
    // Who waits for it to take a picture hears of its end.
    state_->process.kill();
    ::shutdown(state_->pictures.here.get(), SHUT_RDWR);
}

void Film::add(Image picture) {
    state_->sending.add([&state = *state_, picture = std::move(picture)] { state.send(picture); });
}

std::size_t Film::finish() {
    State& state = *state_;
    state.sending.finish();
    send_end(state.pictures.here);
    struct stat written {};
    // Some end well although they could not write all, and yet say so.
    const bool ended_well = state.process.wait(kPatienceAtTheEnd) == 0 && !state.tells_of_error();
    if (!ended_well || ::fstat(state.written.descriptor(), &written) != 0 || written.st_size == 0)
        state.refuse("did not write all");
    return state.written.take_place();
}

}  // namespace mobbscope
