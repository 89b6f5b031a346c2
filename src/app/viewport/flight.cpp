#include <app/viewport/flight.h>
#include <render/drawlist/camera.h>

#include <algorithm>

namespace mobbscope::app {

Camera Flight::at(double now) const {
    const double t = std::clamp((now - start_) / kSeconds, 0.0, 1.0);
    return between(from_, to_, t * t * (3 - 2 * t));
}

}  // namespace mobbscope::app
