/// Clips that are imported anew, one change after the other.
#pragma once

#include <app/session/dialogs.h>
#include <app/session/edits.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

class Imports {
  public:
    Imports(Workspace& workspace, Jobs& jobs, Edits& edits, Dialogs& dialogs, Notifications& notifications)
        : workspace_(workspace), jobs_(jobs), edits_(edits), dialogs_(dialogs), notifications_(notifications) {}

    ClipImport edited;  ///< in Dialog::import_clip
    /// Opens the dialog for a clip with a source; `field`: the option that it is about, empty: none.
    void open(int clip, const std::string& field = "");
    /// Gives an import option of a clip, or of all clips of its file, another value; an empty text leaves it to the
    /// file. The clip is made anew, in a job if that takes long; the document changes when that is done, and changes
    /// asked for meanwhile follow. What cannot be imported leaves the document as it was: it is said at the field if
    /// the dialog is open, else in a message. Throws std::invalid_argument for a value out of range where there is no
    /// dialog.
    void set(int clip, bool whole_file, const std::string& option, const std::string& text);
    /// How a clip moves between its samples, from a file (set) or in the scene.
    void set_motion(int clip, bool whole_file, mobb::Motion motion);
    /// Begins the next change, unless one is under way.
    void next();
    /// What the file of the clip in the dialog has to offer, for the options that it has now.
    void ask_for_offer();
    /// Tells of the warnings that options mend, of the clips from that index on: each option once.
    void tell_of_warnings(std::size_t from);

  private:
    /// The clips that a change is of, with their options then; those that have them already are left out. Throws
    /// std::invalid_argument for a value out of range.
    std::vector<std::pair<int, ImportOptions>> options_wanted(const ImportChange& change) const;
    void start(const ImportChange& change);
    void refuse(const ImportChange& change, const std::string& why);

    Workspace& workspace_;
    Jobs& jobs_;
    Edits& edits_;
    Dialogs& dialogs_;
    Notifications& notifications_;
};

}  // namespace mobbscope::app
