#include <base/file.h>
#include <render/image/picture_names.h>

#include <algorithm>

namespace mobbscope {

bool is_picture_name(const std::filesystem::path& file) {
    return std::ranges::find(kPictureExtensions, lower_extension(file)) != kPictureExtensions.end();
}

bool is_vector_name(const std::filesystem::path& file) {
    return is_picture_name(file) && lower_extension(file) != ".png";
}

bool is_film_name(const std::filesystem::path& file) {
    return std::ranges::find(kFilmExtensions, lower_extension(file)) != kFilmExtensions.end();
}

}  // namespace mobbscope
