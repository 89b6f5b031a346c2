/// The part of OpenGL's state that passes rely on without setting it themselves.
#pragma once

namespace mobbscope {

/// As in a new context, except that rows of pixels are packed without gaps: whatever else draws in the context, a
/// picture begins with the same state. Passes set depth test, blending and culling as they need them; the rest stays as
/// it is here.
void reset_state();

/// Colours over what is there, by their opacity. What is there is opaque and stays so.
void blend_over();

}  // namespace mobbscope
