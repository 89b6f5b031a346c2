#include <render/image/png.h>

#include <base/error.h>
#include <base/file.h>

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

namespace {

constexpr long long kMostPngPixels = 1LL << 27;

std::vector<std::uint8_t> without_alpha(const Image& image) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        rgb.insert(rgb.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                   image.rgba.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    return rgb;
}

/// Reads a picture with libpng. What libpng refuses leaves its functions by a jump, which destroys nothing: they are
/// called where no local variable needs to be destroyed.
class PngReader {
  public:
    explicit PngReader(std::string_view bytes) : bytes_(bytes) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, refuse, take_warning);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    /// All up to the pixels; false where that is refused.
    bool read_header() {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_read_fn(png_, this, give_bytes);
        png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
        // The caller checks the size, and speaks of it in pixels.
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        // Pixels alone are wanted; a text of a few bytes can unpack to megabytes.
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        png_read_info(png_, info_);
        return true;
    }

    long long width() const { return png_get_image_width(png_, info_); }
    long long height() const { return png_get_image_height(png_, info_); }

    /// The pixels, and what follows them; false where that is refused.
    bool read_pixels(Image& image) {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_expand(png_);  // palettes, fewer bits than 8, a transparent colour
        png_set_strip_16(png_);
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 255, PNG_FILLER_AFTER);
        const int passes = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        const std::size_t row = static_cast<std::size_t>(image.width) * 4;
        for (int pass = 0; pass < passes; ++pass) {
            for (int y = 0; y < image.height; ++y) {
                png_read_row(png_, image.rgba.data() + static_cast<std::size_t>(y) * row, nullptr);
            }
        }
        png_read_end(png_, nullptr);
        return true;
    }

    /// Bytes that are read.
    std::size_t at() const { return at_; }
    /// Why something was refused.
    const std::string& reason() const { return reason_; }

  private:
    static void refuse(png_structp png, png_const_charp reason) {
        auto& self = *static_cast<PngReader*>(png_get_error_ptr(png));
        // For a bad header libpng's error only says that it is bad; the warning just before says why.
        if (self.warning_.empty() || self.warned_at_ != self.at_)
            self.reason_ = reason;
        else
            self.reason_ = self.warning_;
        png_longjmp(png, 1);
    }

    static void take_warning(png_structp png, png_const_charp warning) {
        auto& self = *static_cast<PngReader*>(png_get_error_ptr(png));
        self.warning_ = warning;
        self.warned_at_ = self.at_;
    }

    static void give_bytes(png_structp png, png_bytep to, std::size_t size) {
        auto& self = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (size > self.bytes_.size() - self.at_) {
            self.warning_.clear();  // of something else
            png_error(png, "it is cut short");
        }
        std::memcpy(to, self.bytes_.data() + self.at_, size);
        self.at_ += size;
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
    std::string reason_;
    std::string warning_;
    std::size_t warned_at_ = 0;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace

std::string png_bytes(const Image& image) {
    // Opaque pictures, as all of ours are, do without alpha: a quarter less to write.
    bool opaque = true;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) opaque = opaque && image.rgba[i] == 255;
    const std::vector<std::uint8_t> rgb = opaque ? without_alpha(image) : std::vector<std::uint8_t>{};
    png_image written{};
    written.version = PNG_IMAGE_VERSION;
    written.width = static_cast<png_uint_32>(image.width);
    written.height = static_cast<png_uint_32>(image.height);
    written.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(written);
    std::string bytes(size, '\0');
    const void* const pixels = opaque ? rgb.data() : image.rgba.data();
    if (!png_image_write_to_memory(&written, bytes.data(), &size, 0, pixels, 0, nullptr)) {
        throw MachineError(std::string("a picture could not be packed as PNG: ") + written.message);
    }
    bytes.resize(size);
    return bytes;
}

void write_png(const std::filesystem::path& file, const Image& image) { write_file(file, png_bytes(image)); }

Image read_png(const std::filesystem::path& file) { return read_png_bytes(read_file(file), file.string()); }

Image read_png_bytes(std::string_view bytes, const std::string& name) {
    if (png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, std::min<std::size_t>(bytes.size(), 8)) != 0) {
        throw InputError(name, "", "is no PNG picture; give a .png file");
    }
    PngReader reader(bytes);
    const auto refuse = [&] {
        throw InputError(name, "byte " + std::to_string(reader.at()),
                         "the PNG picture cannot be read up to here: " + reader.reason() + "; write or copy it again");
    };
    if (!reader.read_header()) refuse();
    const long long width = reader.width();
    const long long height = reader.height();
    if (width > kMostPngPixels / height) {
        throw InputError(name, "",
                         "the picture of " + std::to_string(width) + "x" + std::to_string(height) +
                             " pixels is too large; up to 134 million pixels are read");
    }
    Image image(static_cast<int>(width), static_cast<int>(height));
    if (!reader.read_pixels(image)) refuse();
    return image;
}

}  // namespace mobbscope
