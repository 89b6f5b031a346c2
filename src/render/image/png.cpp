#include <render/image/png.h>

#include <base/error.h>
#include <base/file.h>

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

namespace mobbscope {

namespace {

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

[[noreturn]] void refuse(const PngReader& reader, const std::string& name) {
    throw InputError(name, "byte " + std::to_string(reader.at()),
                     "the PNG picture cannot be read up to here: " + reader.reason() + "; write or copy it again");
}

/// Packs a picture row by row: beside the picture only what is packed takes memory. Jumps as in PngReader.
class PngWriter {
  public:
    PngWriter() {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, refuse, nullptr);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) {
            png_destroy_write_struct(&png_, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    /// False where that is refused.
    bool write(const Image& image) {
        // Opaque pictures, as all of ours are, do without alpha: a quarter less to write.
        opaque_ = is_opaque(image);
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_write_fn(png_, this, take_bytes, nullptr);
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                     opaque_ ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        // Measured on pictures of scenes: a quarter of the time of libpng's own choice, and files a little smaller.
        png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
        png_set_compression_level(png_, 3);
        png_write_info(png_, info_);
        if (opaque_) png_set_filler(png_, 0, PNG_FILLER_AFTER);  // libpng leaves it out row by row
        for (int y = 0; y < image.height; ++y) png_write_row(png_, image.at(0, y));
        png_write_end(png_, nullptr);
        return true;
    }

    std::string take() { return std::move(bytes_); }
    bool out_of_memory() const { return out_of_memory_; }
    const std::string& reason() const { return reason_; }

  private:
    static bool is_opaque(const Image& image) {
        for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
            if (image.rgba[i] != 255) return false;
        }
        return true;
    }

    static void refuse(png_structp png, png_const_charp reason) {
        static_cast<PngWriter*>(png_get_error_ptr(png))->reason_ = reason;
        png_longjmp(png, 1);
    }

    static void take_bytes(png_structp png, png_bytep from, std::size_t size) {
        auto& self = *static_cast<PngWriter*>(png_get_io_ptr(png));
        try {
            self.bytes_.append(reinterpret_cast<const char*>(from), size);
        } catch (const std::bad_alloc&) {
            self.out_of_memory_ = true;
        }
        if (self.out_of_memory_) png_error(png, "there is no memory");
    }

    std::string bytes_;
    std::string reason_;
    bool opaque_ = false;
    bool out_of_memory_ = false;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

/// Reads the header; throws InputError where the bytes are no PNG, or damaged.
PictureSize read_header(PngReader& reader, std::string_view bytes, const std::string& name) {
    if (png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, std::min<std::size_t>(bytes.size(), 8)) != 0) {
        throw InputError(name, "", "is not a PNG picture; give a .png file");
    }
    if (!reader.read_header()) refuse(reader, name);
    return {static_cast<int>(reader.width()), static_cast<int>(reader.height())};
}

}  // namespace

std::string png_bytes(const Image& image) {
    PngWriter writer;
    if (!writer.write(image)) {
        if (writer.out_of_memory()) throw std::bad_alloc();
        throw MachineError("a picture could not be packed as PNG: " + writer.reason());
    }
    return writer.take();
}

void write_png(const std::filesystem::path& file, const Image& image) { write_file(file, png_bytes(image)); }

Image read_png(const std::filesystem::path& file) { return read_png_bytes(read_file(file), file.string()); }

PictureSize png_size(std::string_view bytes, const std::string& name) {
    PngReader reader(bytes);
    return read_header(reader, bytes, name);
}

Image read_png_bytes(std::string_view bytes, const std::string& name) {
    PngReader reader(bytes);
    const PictureSize size = read_header(reader, bytes, name);
    if (size.width > kMostPngPixels / size.height) {
        throw InputError(name, "",
                         "the picture of " + size_word(size) + " pixels is too large; up to " +
                             std::to_string(kMostPngPixels) + " pixels are read");
    }
    constexpr std::size_t kOfRow = 32;  // bytes that take as long as a row takes by itself
    auto spent = std::make_shared<Spent>();
    spent->add((static_cast<std::size_t>(size.width) * 4 + kOfRow) * static_cast<std::size_t>(size.height),
               "the picture", name);
    Image image(size.width, size.height);
    image.spent = std::move(spent);
    if (!reader.read_pixels(image)) refuse(reader, name);
    return image;
}

}  // namespace mobbscope
