/// The people of a run as agents of an ordinary scene.
#pragma once

#include <scene/scene.h>

namespace mobbscope {

/// A scene with one agent for each person of the run, whose clip is the chain of all that the person plays, from the
/// begin of the first play. A chain has one dt: where a person goes on with a clip of another, a further agent begins,
/// called "17 from 4.2 s". Agent::run_agent says who it is, counting those who play anything. Names and the fit are the
/// run's. The scene must have a crowd and its graph. Throws InputError if a person plays more than a chain can hold.
Scene scene_of_people(const Scene& run);

}  // namespace mobbscope
