#include <app/viewport.h>

namespace mobbscope::app {

struct Viewport::State {};

Viewport::Viewport() : state_(std::make_unique<State>()) {}
Viewport::~Viewport() = default;
void Viewport::draw(Ui& ui) { static_cast<void>(ui); }
const DrawList* Viewport::shown() const { return nullptr; }

}  // namespace mobbscope::app
