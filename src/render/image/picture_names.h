/// What files of pictures are called.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

namespace mobbscope {

inline constexpr std::array<std::string_view, 3> kPictureExtensions{".png", ".svg", ".pdf"};

inline constexpr std::array<std::string_view, 2> kFilmExtensions{".mp4", ".webm"};

/// What is said to a name that is no picture's.
inline constexpr std::string_view kPictureNames = "pictures are written as .png, .svg or .pdf; rename the output";

inline constexpr std::string_view kPictureAndFilmNames =
    "pictures are written as .png, .svg or .pdf, films as .mp4 or .webm; rename the output";

/// By its extension, in capitals too.
bool is_picture_name(const std::filesystem::path& file);
/// SVG or PDF.
bool is_vector_name(const std::filesystem::path& file);
/// MP4 or WebM: no picture, but many (film.h).
bool is_film_name(const std::filesystem::path& file);

}  // namespace mobbscope
