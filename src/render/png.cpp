#include <render/png.h>

#include <import/error.h>
#include <import/file.h>
#include <render/png_chunks.h>

#include <stb_image.h>
#include <stb_image_write.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace mobbscope {

namespace {

std::vector<std::uint8_t> without_alpha(const Image& image) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        rgb.insert(rgb.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                   image.rgba.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    return rgb;
}

}  // namespace

std::string png_bytes(const Image& image) {
    // Opaque pictures, as all of ours are, do without alpha: a quarter less to write.
    bool opaque = true;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) opaque = opaque && image.rgba[i] == 255;
    const std::vector<std::uint8_t> rgb = opaque ? without_alpha(image) : std::vector<std::uint8_t>{};
    const int channels = opaque ? 3 : 4;
    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, channels,
                                opaque ? rgb.data() : image.rgba.data(), image.width * channels)) {
        throw MachineError("a picture could not be packed as PNG");
    }
    return bytes;
}

void write_png(const std::filesystem::path& file, const Image& image) {
    const std::string bytes = png_bytes(image);
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(file, ignored);
    const bool stream = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
                        !std::filesystem::is_directory(status);
    if (!stream) return write_file(file, bytes);
    // A pipe or a device takes the bytes; it must not be replaced by a file.
    std::ofstream out(file, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw MachineError(file.string() + ": cannot be written: " + std::generic_category().message(errno));
}

Image read_png(const std::filesystem::path& file) {
    const std::string bytes = read_file(file);
    check_png(bytes, file.string());
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw InputError(file.string(), "", "is 2 GiB large; write it smaller");
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width,
                              &height, &channels, 4),
        stbi_image_free);
    if (!pixels) {
        throw InputError(
            file.string(), "",
            std::string("cannot be read as a PNG picture (") + stbi_failure_reason() + "); write it again");
    }
    Image image(width, height);
    std::memcpy(image.rgba.data(), pixels.get(), image.rgba.size());
    return image;
}

}  // namespace mobbscope
