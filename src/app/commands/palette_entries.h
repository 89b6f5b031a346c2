/// What the palette offers for what was typed.
#pragma once

#include <app/commands/command.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

struct PaletteEntry {
    const Command* command = nullptr;
    std::string argument;  ///< that it is run with; the palette asks for one if it is needed and empty
    std::string title;
    std::string detail;    ///< the kind of thing: a menu, "Agent", "Node" ...
    std::string says;      ///< what the command does; empty where the title has all that was looked for
    std::string shortcut;  ///< ... of the command
    std::string why_not;   ///< why it cannot be done now; empty: it can
};

/// The best first, what cannot be done now last. Without text every command in the order of the menus; with text also
/// the choices of commands, agents, clips, queries, a node by its agent and place ("A 2.1"), and commands with what
/// they take ("step 400"). Commands are found by their other words (Command::also) too. Fuzzy matches (letters
/// scattered in order) count only where no word is found.
std::vector<PaletteEntry> palette_entries(const Session& session, const std::string& text);

/// The choices of a command that fit what was typed, the best first.
std::vector<std::string> matching_choices(const Session& session, const Command& command, const std::string& text);

/// The letters of `word` must stand in `text` in their order, whatever their case; starts of words and runs count more,
/// and scattered letters do not match. Higher is better; 0 for an empty word.
std::optional<double> fuzzy_score(std::string_view word, std::string_view text);

/// The same where `word` is the beginning of a word of `text`, or, which is higher, all of it.
std::optional<double> word_score(std::string_view word, std::string_view text);

}  // namespace mobbscope::app
