/// What the goldens of a folder were drawn with, if that is told: `reference.json` beside the cases,
///
///     {"mobbscope_reference": 1,
///      "fonts": {"OpenSans-Regular.ttf": "<SHA-256>", "FiraCode-Regular.ttf": "<SHA-256>"},
///      "imgui": "1.86",
///      "opengl": "Mesa 22.3.6, llvmpipe"}
///
/// On a system where all of this is the same, the reference, pixels and draw lists must be the goldens'. Elsewhere the
/// pixels are compared too; where they differ, the draw list decides (with other fonts, which are as wide as they like,
/// positions of words count for little). Where words are drawn with the same fonts, the draw list must be the golden's
/// in any case, and a picture whose pixels differ may lose little structural similarity (similarity_loss), which alone
/// decides of what has no draw list. With other fonts that is decided by a second golden, NAME.plain.png, without text,
/// small and coarse (coarse_picture), with the loose tolerance, and of a window by its state, NAME.plain.state.json.
#pragma once

#include <cases/case_result.h>
#include <render/gl/renderer.h>
#include <render/image/image.h>

#include <filesystem>
#include <optional>
#include <string>

namespace mobbscope::picture_tests {

/// What this program draws with here.
Reference reference_of(const Renderer& renderer);

/// The file in a folder of cases.
std::filesystem::path reference_file(const std::filesystem::path& folder);

/// What it says; nothing if there is none. Throws InputError.
std::optional<Reference> read_reference(const std::filesystem::path& folder);

/// The text of the file.
std::string reference_text(const Reference& reference);
/// Throws MachineError.
void write_reference(const std::filesystem::path& folder, const Reference& reference);

/// The differences, "Dear ImGui 1.90.1 for 1.86, OpenSans-Regular.ttf 5f2a0c11 for e64e508b"; empty if there are none.
std::string what_is_other(const Reference& here, const Reference& reference);

/// Whether words have the same pixels here, of a window (in_window) or of a scene: the rasteriser aside.
bool same_text(const Reference& here, const Reference& reference, bool in_window);

/// Half as wide and high, each pixel the mean of four, in 64 levels a channel: a picture that is a tenth as large on
/// the disk, and still shows what is drawn where.
Image coarse_picture(const Image& image);

}  // namespace mobbscope::picture_tests
