/// Films: pictures handed to the ffmpeg of the machine, which another process is.
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

/// For a film of that name (is_film_name). Throws MachineError, saying what to install, if PATH has no ffmpeg, or that
/// one has no encoder for such films.
FilmMaker find_film_maker(const std::filesystem::path& film);

/// The sizes that films have: both sides even. The least that is no smaller.
PictureSize film_size(PictureSize size);

/// A film in the making. It stands in its place once it is finished; else nothing is left of it.
class Film {
  public:
    /// `size`: as film_size has it; `rate`: pictures a second. Throws MachineError.
    Film(const FilmMaker& maker, const std::filesystem::path& file, PictureSize size, double rate);
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// The next picture, of the film's size; its alpha is not looked at. Returns before it is encoded, unless several
    /// are waiting. Throws MachineError, in ffmpeg's words, if that has failed.
    void add(Image picture);

    /// All pictures are there. Returns how many bytes the film has. Throws MachineError as `add` does.
    std::size_t finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mobbscope
