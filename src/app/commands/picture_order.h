/// A picture as `render` is asked for it: what the viewport shows, or as the export dialog says; and the command line
/// that asks for it.
#pragma once

#include <app/session/session.h>
#include <explain/scene_figures.h>
#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/parts/highlights.h>
#include <render/parts/measured_line.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace mobbscope::app {

/// A film instead of a picture.
struct FilmOrder {
    bool turns = false;  ///< around the scene
    int turntable = 0;   ///< pictures once around
    double rate = 0;     ///< pictures a second; 0: the usual
};

/// Of the session's document.
struct PictureOrder {
    ViewState view;
    PictureOptions options;
    std::optional<NamedPart> select;  ///< what is highlighted
    std::optional<MeasuredLine> measure{};
    std::optional<FilmOrder> film{};
};

/// What the active viewport shows.
PictureOrder order_of_viewport(const Workspace& workspace, const Views& views);

/// The same as the settings of the export dialog say. Its size may be one that `check` refuses.
PictureOrder order_to_export(const Settings& settings, const Workspace& workspace, const Views& views);

/// Makes it a film, as the settings say, where the file is called like one (is_film_name).
PictureOrder ordered_for(const std::filesystem::path& file, PictureOrder order, const Settings& settings);

/// What an ordered film will be, in the words that `render` has for what it made. Throws std::invalid_argument if these
/// are more pictures than are made at once.
std::string film_text(const Workspace& workspace, const PictureOrder& order);

/// As `render` draws it, which counts the scene's queries where that is shown; `figures`: of what these have. Throws
/// std::invalid_argument if it cannot be drawn.
DrawList draw_list_of(const Workspace& workspace, const PictureOrder& order,
                      std::shared_ptr<SceneFigures> figures = std::make_shared<SceneFigures>());

/// The bytes of its PNG file. Throws std::invalid_argument if it cannot be drawn, or there is no window to draw it;
/// MachineError if the machine cannot.
std::string png_of(const Session& session, const PictureOrder& order);

/// Writes it, and returns how many bytes that are. Throws as png_of does; InputError, MachineError if the file cannot
/// be written: nothing is left then.
std::size_t write_picture(const Session& session, const PictureOrder& order, const std::filesystem::path& file);

/// Where the export dialog writes to: a name alone goes beside the scene's file, else where a file was opened or
/// written last; without an extension it gets ".png", or a film's ".mp4". Of an empty field the scene's name.
std::filesystem::path export_file(const Workspace& workspace, const Settings& settings, const Dialogs& dialogs);

/// "mobbscope render ..." that draws the picture into `output`, quoted for a shell. None if no file holds the scene as
/// it is: neither that which was opened nor the temporary file that was written last.
std::optional<std::string> render_line(const Workspace& workspace, const Files& files, const Dialogs& dialogs,
                                       const PictureOrder& order, const std::string& output);

/// The same; where no file holds the scene it is written to a new one among the temporary files, and the session
/// remembers that. Throws MachineError if that cannot be written, InputError where nothing may be (may_write).
std::string render_line_with_scene(Workspace& workspace, Files& files, Dialogs& dialogs, const PictureOrder& order,
                                   const std::string& output);

/// A scene in a new folder among the temporary files, for another process; the folder goes with this.
class SceneCopy {
  public:
    /// As if it were saved, seen so and called like that. Throws MachineError. `of` must outlive it.
    SceneCopy(const FittedScene& of, const std::string& title, const ViewState& view);
    ~SceneCopy();
    SceneCopy(const SceneCopy&) = delete;
    SceneCopy& operator=(const SceneCopy&) = delete;

    const std::filesystem::path& file() const { return file_; }
    /// "mobbscope render ..." that draws what is ordered of it, seen as it is, into `output`.
    std::string render_line(const PictureOrder& order, const std::string& output) const;

  private:
    const Scene& scene_;
    ViewState view_;
    std::filesystem::path file_;
};

}  // namespace mobbscope::app
