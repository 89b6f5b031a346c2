/// The program's sign, drawn: two paths that cross.
#pragma once

#include <render/image/image.h>

namespace mobbscope::app {

Image window_icon(int side);

}  // namespace mobbscope::app
