/// The picture in the middle of the window, and what the mouse does in it.
#pragma once

#include <app/ui.h>
#include <render/draw_list.h>

#include <memory>

namespace mobbscope::app {

class Viewport {
  public:
    Viewport();
    ~Viewport();

    /// Draws picture, handles and what is under the mouse into the current ImGui child window.
    void draw(Ui& ui);

    /// What it showed last; null before the first frame or for an empty scene.
    const DrawList* shown() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mobbscope::app
