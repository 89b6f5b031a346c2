/// A step of a query as it is quoted: "crossing.json#q3@412" is step 412 of query 3 of that scene, both from 0.
#pragma once

#include <scene/scene.h>

#include <filesystem>
#include <optional>
#include <string>

namespace mobbscope {

struct StepLink {
    int query = 0;
    int step = 0;
    friend bool operator==(const StepLink&, const StepLink&) = default;
};

/// "#q3@412", as it stands behind the file's name.
std::string to_string(const StepLink& link);

struct LinkedFile {
    std::filesystem::path file;
    std::optional<StepLink> link{};  ///< none: the file alone is meant
};

/// Whether "#q" stands behind the name of a file, whatever follows. A file that is called so wins.
bool quotes_step(const std::filesystem::path& name);

/// What a person has named. Throws InputError if it quotes a step that is not written so.
LinkedFile linked_file(const std::filesystem::path& name);

/// The name without the link behind it, whether there are such files or not.
std::filesystem::path without_link(const std::filesystem::path& name);

/// The scene is seen at that step. Throws InputError, naming its file, if it has no such query.
void show_step(Scene& scene, const StepLink& link);

/// Throws InputError, likewise, if the query has no such step with the trees that the scene says. Requires the query.
void check_step(const Scene& scene, const StepLink& link);

}  // namespace mobbscope
