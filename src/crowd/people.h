/// The people of a run as agents of an ordinary scene.
#pragma once

#include <scene/scene.h>

namespace mobbscope {

/// A scene with one agent for each person of the run, whose clip is the chain of all that the person plays, from the
/// begin of the first play. Names and the fit are the run's. The scene must have a crowd and its graph. Throws
/// InputError if a person plays clips of different dt, as no chain does.
Scene scene_of_people(const Scene& run);

}  // namespace mobbscope
