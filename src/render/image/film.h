/// Films: pictures handed to the ffmpeg of the machine, which works in a process of its own.
#pragma once

#include <render/image/image.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {

/// What makes the films of one kind here.
struct FilmMaker {
    std::filesystem::path program;      ///< ffmpeg
    std::vector<std::string> encoding;  ///< its arguments about encoder and quality
};

/// The ffmpeg of PATH. Throws MachineError, naming the film and what to install, if there is none.
std::filesystem::path find_ffmpeg(const std::filesystem::path& film);

/// For a film of that name (is_film_name). Throws as find_ffmpeg does, and if ffmpeg has no encoder for such films.
FilmMaker find_film_maker(const std::filesystem::path& film);

/// A film in the making. The file appears under its name when it is finished; if it is not, nothing is left of it.
class Film {
  public:
    /// `size`: both sides even; `rate`: pictures a second. Throws MachineError.
    Film(const FilmMaker& maker, const std::filesystem::path& file, PictureSize size, double rate);
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// The next picture, of the film's size, shown so many times; its alpha is not looked at. Returns before it is
    /// encoded, unless several are waiting. Throws MachineError, in ffmpeg's words, if that has failed.
    void add(Image picture, std::size_t times = 1);

    /// All pictures are there. Returns how many bytes the film has. Throws MachineError as `add` does.
    std::size_t finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mobbscope
