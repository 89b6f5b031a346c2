/// Draw lists as files: pixels, or for papers SVG and PDF with lines as lines and text as text.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/renderer.h>

#include <filesystem>
#include <functional>
#include <string>

namespace mobbscope {

/// The bytes of a picture file with such a name (is_picture_name), which are the same for the same list and renderer.
/// In SVG and PDF what lies over the world is vectors, and so are its lines and the edges of boxes, unless there are
/// very many; disks and faces are one picture below them. `renderer` is asked for where pixels are needed. Throws
/// MachineError as Renderer::draw does.
std::string picture_bytes(const std::filesystem::path& file, const DrawList& list, int samples,
                          const std::function<Renderer&()>& renderer);

/// The same with a renderer of its own.
std::string picture_bytes(const std::filesystem::path& file, const DrawList& list, int samples, Backend backend);

}  // namespace mobbscope
