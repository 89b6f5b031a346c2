/// What an exported picture is asked to be, beside what the viewport shows.
#pragma once

#include <render/drawlist/picture_options.h>
#include <render/image/image.h>
#include <scene/view_state.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
class FittedScene;  // scene/fitted_scene.h
}

namespace mobbscope::app {

/// As it is at first, an exported picture is the viewport's.
struct PictureExport {
    std::optional<PictureSize> size;  ///< pixels; none: the viewport's
    bool keeps_shape = true;          ///< a side that is changed in the dialog takes the other one along
    double scale = 0;  ///< of text and lines; 0: the viewport's at its own size, at another what suits that
    int samples = kPictureSamples;
    bool transparent = false;       ///< the background; else the theme's
    std::optional<Theme> theme;     ///< none: the view's
    std::set<std::string> without;  ///< what is left out: keys of view options
    bool film_turns = false;        ///< a film goes around the scene; else through the motion or the query's steps
    int turntable = 120;            ///< pictures once around
    double rate = 0;                ///< of a film, pictures a second; 0: the usual
    friend bool operator==(const PictureExport&, const PictureExport&) = default;
};

/// Of a film once around, pictures; and of any a second, the least of which is one by that.
inline constexpr double kMostTurntable = 100'000;
inline constexpr double kMostFilmRate = 1000;

/// One of them by name: its command is "picture." and the key, and settings keep it under the key.
struct ExportOption {
    std::string_view key;
    std::string_view title, doc;
    std::string_view argument;  ///< as Command has it
    std::vector<std::string> choices{};
    std::vector<std::string> choice_titles{};  ///< what menus and the dialog call them; empty: the choices
    /// Throws std::invalid_argument saying what is allowed.
    std::function<void(const std::string&, PictureExport&)> parse{};
    std::function<std::string(const PictureExport&)> text{};  ///< what `parse` reads
};

/// The table, in the order of the dialog.
std::span<const ExportOption> export_options();

/// What the dialog holds beside them.
struct ExportDialog {
    std::string file;                ///< as typed
    bool film = false;               ///< a name without an extension is a film's
    int opening = -1;                ///< of the document that the file's name was made for (Document::opening)
    std::filesystem::path agreed{};  ///< that may be overwritten: the person said so, or it was written here
    PictureSize shape{};             ///< that keeps_shape keeps
    PictureSize made{};              ///< ... the size that was last made from it

    /// A scene that no file has, written for a command line.
    struct TemporaryScene {
        std::shared_ptr<const FittedScene> of;
        ViewState view;
        std::filesystem::path file;
    };
    std::optional<TemporaryScene> temporary{};

    /// The picture, small. It is made anew once nothing has changed for about as long as it takes.
    struct Preview {
        std::shared_ptr<const FittedScene> of;
        ViewState view;
        PictureOptions options;
        std::string select;
        int divisor = 1;
        std::int64_t counted = 0;  ///< SceneFigures::revision
        bool same_picture(const Preview& other) const {
            return of == other.of && view == other.view && options.size == other.options.size &&
                   options.scale == other.options.scale && options.background == other.options.background &&
                   select == other.select && divisor == other.divisor && counted == other.counted;
        }
    };
    Preview wanted{}, shown{};
    double wanted_since = 0;               ///< seconds of the window's clock
    double seconds = 0;                    ///< that the last one took
    std::shared_ptr<const Image> image{};  ///< of `shown`; null: none
    std::string why_not{};                 ///< there is none
};

}  // namespace mobbscope::app
