/// A small picture that shows whether a driver draws at all.
#pragma once

#include <render/gl/renderer.h>

namespace mobbscope {

/// With all that pictures are made of: disks, boxes, lines, words and ids. Throws MachineError if OpenGL reports an
/// error.
void draw_a_little(Renderer& renderer);

}  // namespace mobbscope
