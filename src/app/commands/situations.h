/// What a person is in the midst of, and what can be done then: the help begins with it.
#pragma once

#include <app/commands/command.h>

#include <span>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// What a key does that is no command's.
struct KeyHelp {
    std::string_view keys;
    std::string_view what;
};

struct Situation {
    std::string_view title;
    std::string_view words;  ///< a sentence or two
    OfParts<bool, const Session> holds;
    std::vector<std::string_view> commands{};  ///< that matter now, by id
    std::vector<KeyHelp> keys{};               ///< of a dialog
};

/// The one that the session is in: the first of the table that holds. Of a dialog under the help: that dialog.
const Situation& present_situation(const Session& session);
/// The table; the last one always holds.
std::span<const Situation> situations();

/// Keys that go through panels, lists, menus and fields.
std::span<const KeyHelp> focus_help();

}  // namespace mobbscope::app
