/// The clip that is in the import dialog, and how its options change.
#pragma once

#include <scene/clip_import.h>

#include <map>
#include <memory>
#include <string>

namespace mobbscope::app {

/// A value that could not be imported.
struct RefusedImport {
    std::string text;
    std::string why;  ///< one line
};

struct ClipImport {
    int clip = -1;            ///< index into Scene::clips
    std::string field{};      ///< the option that the dialog was opened for: it is lit
    bool scroll = true;       ///< ... and not in sight yet
    bool whole_file = false;  ///< what is changed of a file's options changes for all clips of the file
    std::shared_ptr<const ImportOffer> offer{};  ///< null until the file has been read
    bool asked = false;                          ///< the offer was asked for: it is there, or comes, or cannot be had
    ImportOptions offered_for{};                 ///< what the offer depends on
    std::string unreadable{};                    ///< why there is no offer; empty: it is being made
    std::map<std::string, RefusedImport> refused{};  ///< by option
    double time = 0;                                 ///< seconds of the clip: of the skeleton in the preview
    std::string search{};                            ///< in an open list of choices
};

/// A change of an import option that somebody asked for.
struct ImportChange {
    int clip = 0;
    bool whole_file = false;
    std::string option;
    std::string text;
    bool goes_on = false;  ///< with the last edit, as FitEdit has it
};

}  // namespace mobbscope::app
