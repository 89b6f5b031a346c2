/// What the window can show in place of the scene.
#pragma once

#include <string>

namespace mobbscope::app {

class Screen {
  public:
    virtual ~Screen() = default;
    /// For the window's title.
    virtual std::string title() const = 0;
};

}  // namespace mobbscope::app
