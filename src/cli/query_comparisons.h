/// Answers and traces of a scene's queries beside others: those that its file has, and those of other trees.
#pragma once

#include <scene/fitted_scene.h>

#include <filesystem>

namespace mobbscope::cli {

/// Compares expected answers and stored traces with fresh ones; the exit status.
int check_queries(const FittedScene& fitted, const std::filesystem::path& file, bool json);

/// Compares the traversals of each query under the scene's fit and another one; the exit status.
int compare_queries(const FittedScene& fitted, const mobb::FitOptions& other, bool json);

}  // namespace mobbscope::cli
