/// Work that no file has, as a copy of it is kept and read again.
#pragma once

#include <app/document/workspace.h>

#include <ctime>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

struct UnsavedWork {
    Document document;  ///< no excerpt: one that was edited is a work of its own
    Selection selection;
    std::string title;                                         ///< "crossing.json"
    std::optional<std::filesystem::path> file;                 ///< where Save writes; none: Save asks
    std::optional<std::filesystem::file_time_type> file_time;  ///< of it, when it was opened or saved
    std::vector<std::filesystem::path> opened;                 ///< what it was made of
};

/// What is modified in a workspace: the scene, as "scene", and an excerpt of it that was edited, as "excerpt".
std::map<std::string, UnsavedWork> unsaved_works(const Workspace& workspace);

/// Whether they are one state, seen alike: they share what they are made of.
bool same_scene(const UnsavedWork& a, const UnsavedWork& b);
bool same_state(const UnsavedWork& a, const UnsavedWork& b);

/// What a copy says of itself at its beginning.
struct UnsavedHead {
    std::string title;
    std::time_t time = 0;  ///< when it was written
};

/// A copy: a line about the work, then its scene as a scene file has it.
std::string unsaved_text(const UnsavedWork& work, std::time_t now);
// Throw InputError.
UnsavedHead read_unsaved_head(const std::filesystem::path& copy);
/// Sources are read from where they were.
UnsavedWork read_unsaved(const std::filesystem::path& copy, const Progress& progress = {});

/// What was open is modified, and nothing that undo leads to is saved.
void put_in(Workspace& workspace, const UnsavedWork& work);

}  // namespace mobbscope::app
