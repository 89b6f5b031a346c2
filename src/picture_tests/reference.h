/// What the goldens of a folder were drawn with, if that is told: `reference.json` beside the cases,
///
///     {"mobbscope_reference": 1,
///      "fonts": {"Inter-Medium.otf": "<SHA-256>", "JetBrainsMono-Regular.ttf": "<SHA-256>"},
///      "imgui": "1.86",
///      "opengl": "Mesa 22.3.6, llvmpipe"}
///
/// Pixels of text are the same only with the same fonts, Dear ImGui and rasteriser. So each case of such a folder has a
/// second golden, which holds on any system: NAME.plain.png, the case without text, small and coarse (coarse_picture),
/// compared with the loose tolerance; with a NAME.draw.json also NAME.plain.draw.json, the draw list without text; for
/// a window also NAME.plain.state.json, its state. On the reference both goldens are compared, elsewhere the second.
#pragma once

#include <render/gl/renderer.h>
#include <render/image/image.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace mobbscope::picture_tests {

struct Reference {
    std::map<std::string, std::string> fonts;  ///< file name to SHA-256, 64 hexadecimal digits
    std::string imgui;                         ///< version of Dear ImGui
    std::string opengl;                        ///< the driver's version and what draws; the processor does not matter
};

/// What this program draws with here.
Reference reference_of(const Renderer& renderer);

/// The file in a folder of cases.
std::filesystem::path reference_file(const std::filesystem::path& folder);

/// What it says; nothing if there is none. Throws InputError.
std::optional<Reference> read_reference(const std::filesystem::path& folder);

/// Throws MachineError.
void write_reference(const std::filesystem::path& folder, const Reference& reference);

/// The differences, "Dear ImGui 1.90.1 for 1.86, Inter-Medium.otf 5f2a0c11 for 8d3e90b4"; empty if there are none.
std::string what_is_other(const Reference& here, const Reference& reference);

/// Half as wide and high, each pixel the mean of four, in 64 levels a channel: a picture that is a tenth as large on
/// the disk, and still shows what is drawn where.
Image coarse_picture(const Image& image);

}  // namespace mobbscope::picture_tests
