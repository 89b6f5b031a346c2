/// PNG files.
#pragma once

#include <render/image/image.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace mobbscope {

/// The most pixels of a picture that is read: those of the largest that is drawn, 7680x4320, and a few more. To hold
/// one against another takes up to 30 bytes for each.
inline constexpr long long kMostPngPixels = 1LL << 25;

/// The bytes of a PNG file. Throws MachineError if libpng refuses, std::bad_alloc if there is no memory.
std::string png_bytes(const Image& image);

/// Whole or not at all, as write_file does; a pipe or a device that is there gets the bytes. Throws MachineError if
/// that cannot be done.
void write_png(const std::filesystem::path& file, const Image& image);

/// Grey, palettes and 16 bits (their upper 8) become RGBA; what a file says of its colours' gamma is ignored. Throws
/// InputError if the file is missing, no PNG, damaged, cut short or of more than kMostPngPixels.
Image read_png(const std::filesystem::path& file);
/// The same of the bytes of a file; `name` stands for it in messages.
Image read_png_bytes(std::string_view bytes, const std::string& name = "a picture");
/// By its header alone, of any number of pixels; else throws likewise.
PictureSize png_size(std::string_view bytes, const std::string& name);

}  // namespace mobbscope
