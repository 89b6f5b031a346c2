/// Options that several commands share, and what they mean for a scene.
#pragma once

#include <base/number_options.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <render/gl/gl_context.h>
#include <render/image/image.h>
#include <scene/fitted_scene.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace mobbscope::cli {

/// The fit options as given; an empty one leaves the scene's.
struct FitArguments {
    std::optional<mobb::TreeKind> tree;
    bool brute = false;  ///< `--tree brute`: no tree, the direct search
    std::optional<int> leaf;
    std::optional<int> levels;
    std::optional<mobb::Axes> axes;
    std::optional<double> time_scale;

    /// The scene's options with those given over them.
    mobb::FitOptions over(mobb::FitOptions fit) const;
};

/// What the commands share that ask something of a scene with trees.
struct FittedArguments {
    std::filesystem::path file;
    bool json = false;
    FitArguments fit;
    ImportOptions import_options;
};

/// Whether `--tree brute` is among the choices.
enum class Brute { refused, allowed };

/// Adds --tree --leaf --levels --axes --time-scale. `arguments` must live until the command has run.
void add_fit_options(Command& command, FitArguments& arguments, Brute brute = Brute::refused);

/// Adds --fps --unit --up --root --trim --dt --radius --columns --motion --id --animation. `options` must live until
/// the command has run.
void add_import_options(Command& command, ImportOptions& options);

/// Adds an option for each row; `options` must live until the command has run.
template <class Options>
void add_number_options(Command& command, std::span<const NumberOption<Options>> rows, Options& options) {
    for (const NumberOption<Options>& row : rows) {
        command.add_option(
            std::string("--").append(row.key),
            [&row, &options](const std::string& text) { row.set(options, parse_numbers(row, text)); }, help_of(row),
            std::string(row.placeholder));
    }
}

/// Adds FILE, --json and the options of fits and imports; gives --json. `arguments` must live until the command has
/// run.
Option add_fitted_options(Command& command, FittedArguments& arguments, const std::string& json_help,
                          Brute brute = Brute::refused);

/// The scene with the trees that it or the arguments ask for.
FittedScene fitted(Scene scene, const FitArguments& arguments);

/// Throws InputError, naming the file, if the scene has no queries.
void check_asks(const FittedScene& scene, const std::filesystem::path& file);

/// Throws std::invalid_argument if the text is empty, as an unset variable leaves it.
std::filesystem::path parse_file_name(const std::string& text);
/// The same of a file that is written. "-" is refused.
std::filesystem::path parse_output_name(const std::string& text);

/// Adds the FILE that a command works on: a scene or a clip.
void add_scene_file(Command& command, std::filesystem::path& file);

/// Reads a finite number within [low, high]; throws std::invalid_argument.
std::function<double(const std::string&)> number_within(double low, double high);

/// Reads a whole number within [least, most]; throws std::invalid_argument.
std::function<int(const std::string&)> whole_number_within(int least, int most);

/// Reads what begins random numbers: a whole number up to kMaxSeed, as files keep it; throws std::invalid_argument.
std::uint64_t parse_seed(const std::string& text);

/// Reads text that stands for one of a few values, as `find` finds it; throws std::invalid_argument.
template <class Find>
auto one_of(Find find, const char* allowed) {
    return [find, allowed](const std::string& text) {
        const auto value = find(text);
        if (!value) throw std::invalid_argument(in_quotes(text) + " is not one of " + allowed);
        return *value;
    };
}

/// Adds --backend by its name, which another process, or a later one, draws with.
void add_backend_name(Command& command, std::string& backend, const std::string& help);

/// How a diagram is drawn.
struct DrawingArguments {
    PictureSize size{1280, 720};
    double scale = 0;  ///< of text and lines; 0: the usual
    Theme theme = Theme::dark;
    Backend backend = Backend::automatic;
};

/// Adds --size --scale --theme --backend. `drawing` has what holds without them, and must live until the command has
/// run.
void add_drawing_options(Command& command, DrawingArguments& drawing);

/// What is said of clips: one line a text, whatever the number of clips it holds for.
class ClipWarnings {
  public:
    void add(const SceneClip& clip);
    /// To standard error; `file`: its name for messages.
    void print(const std::string& file) const;

  private:
    struct Told {
        ImportWarning warning{};  ///< its line is the first clip's, its samples are those of all
        std::string first{};      ///< the name of that clip
        std::size_t clips = 0;
    };
    std::size_t clips_ = 0;
    Told held_;  ///< held steps that are too long; the first clip is the worst
    double most_ = 0;
    std::vector<Told> all_;
    std::unordered_map<std::string, std::size_t> by_text_;  ///< indices of all_
};

/// Tells how far the work is, after each pause: a person's is 2 s, a script's 8 s.
Progress tell(const std::string& doing, const std::string& things, std::optional<std::chrono::milliseconds> pause = {});

/// load_scene, with its warnings on standard error. Throws InputError.
Scene load(const std::filesystem::path& file, const ImportOptions& options);
/// The same, or the clips of all files in a folder.
Scene load_file_or_folder(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace mobbscope::cli
