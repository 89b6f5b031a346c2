/// What one command, or one line of a batch, asks to be drawn: planned and checked in full, then drawn.
#pragma once

#include <cli/render/render_options.h>
#include <render/drawlist/draw_list.h>
#include <render/image/film.h>
#include <render/pictures/kept_paths.h>
#include <render/pictures/played.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mobbscope::cli {

/// Scenes read once, and their trees fitted once for each set of options.
class SceneStore {
  public:
    /// The paths of a fitted scene, for all of its pictures. Warns of what loading warns of. Throws InputError.
    std::shared_ptr<KeptPaths> paths(const RenderArguments& arguments);

  private:
    struct Loaded {
        std::filesystem::path name;  ///< with the step that it quotes
        ImportOptions options;
        Scene scene;
        std::vector<std::shared_ptr<KeptPaths>> paths;
    };
    Loaded& loaded(const RenderArguments& arguments);

    std::vector<std::unique_ptr<Loaded>> scenes_;
};

/// One view as pictures: itself, or a numbered sequence.
struct RenderPicture {
    ViewState view;
    RenderOutputs outputs;
    std::optional<DrawList> list{};  ///< once it is made: of this view
};

/// Whether --follow says where the camera is: it does unless there is a target.
bool is_near_followed(const ViewState& view, const RenderArguments& arguments);

/// All pictures, seen by one camera, but those near the followed. Throws InputError if there are none such, or too
/// many; std::invalid_argument if the scene lacks what the view names.
std::vector<RenderPicture> pictures_of(KeptPaths& kept, const ViewState& view, const RenderArguments& arguments);

struct RenderJob {
    RenderArguments arguments;
    std::shared_ptr<KeptPaths> paths;
    std::vector<RenderPicture> pictures;
    std::optional<FilmMaker> film_maker{};  ///< of a film, once the outputs are checked
    FilmPace pace{};                        ///< of a film
};

/// Plans jobs, and remembers what their pictures have in common.
class RenderPlan {
  public:
    /// `progress`: says often how far it is.
    explicit RenderPlan(bool progress) : progress_(progress) {}

    /// Throws InputError unless every picture of the job can be drawn.
    void add(RenderArguments arguments);

    /// Throws as OutputCheck::writes does for the files of one job, and as find_film_maker does for its film; `outputs`
    /// is the plan's.
    void check_outputs(std::size_t job, OutputCheck& outputs);

    /// Draws and writes all pictures, once. Throws MachineError; pictures and films before that are whole.
    void draw(Backend backend);

  private:
    void check_and_frame(RenderJob& job);
    void note_glyphs(const DrawList& list);
    void keep(RenderPicture& picture, DrawList list);

    bool progress_;
    SceneStore scenes_;
    std::vector<RenderJob> jobs_;
    std::map<std::string, FilmMaker> film_makers_;  ///< by the extension of the films
    std::set<char32_t> missing_glyphs_;             ///< that the fonts of pictures lack
    std::size_t kept_ = 0;                          ///< disks, boxes and lines of the lists that are kept
};

/// Many pictures at once: draws all of a list of what `render` takes, one picture or sequence a line; "-" is standard
/// input.
///
///     # the arguments as one would type them; words with blanks stand in double quotes
///     crossing.json --view top -o top.png
///     crossing.json --query 0 --play --background "#14181D" -o query.png
///
/// Names are relative to the working directory. `defaults` hold for every line that does not say otherwise. Nothing is
/// written unless every line can be drawn. Throws InputError and MachineError naming the line.
void render_batch(const std::filesystem::path& list, const RenderArguments& defaults, bool progress);

/// By the file's name.
bool is_case(const std::filesystem::path& file);

/// Draws it as `mobbscope test` does. Throws InputError if `command` was given options that the case decides on.
void render_case(const Command& command, const RenderArguments& arguments);

}  // namespace mobbscope::cli
