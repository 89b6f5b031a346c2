/// The backends behind GlContext::open.
#pragma once

#include <render/gl_context.h>

namespace mobbscope {

/// Each throws std::runtime_error saying why it cannot be had here.
std::unique_ptr<GlContext> open_osmesa();
std::unique_ptr<GlContext> open_egl();

}  // namespace mobbscope
