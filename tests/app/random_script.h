/// Seeded random statements for the window (app/script/script.h): keys, mouse, commands, the palette, over whatever is
/// there.
#pragma once

#include <app/ui/ui.h>
#include <render/image/image.h>
#include <review/review_screen.h>

#include "mobb/random_motion.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {
inline namespace testing {

class RandomScript {
  public:
    /// For a window of `size`, which is made `least` to `most` large.
    RandomScript(std::uint64_t seed, PictureSize size, PictureSize least, PictureSize most)
        : random_(seed), least_(least), most_(most), size_(size) {
        for (const Command& command : commands_with_review()) {
            // Another file has another past.
            if (command.id.starts_with("file.")) continue;
            commands_.push_back(&command);
            for (const std::string_view shortcut : words(command.shortcut)) keys_.emplace_back(shortcut);
        }
        for (const char* key : {"Escape", "Enter", "Tab", "Up", "Down", "Ctrl+Z", "Ctrl+Y", "Space"}) {
            keys_.emplace_back(key);
        }
    }

    /// What is done next in a window that shows `marks`; some things take several lines.
    std::string next(const Session& session, const Marks& marks) {
        switch (random_.integer(0, 18)) {
            case 0:
            case 1:
            case 2:
                return "key " + any(keys_);
            case 3:
            case 4:
            case 5:
                return run(session);
            case 6:
            case 7:
                return "click " + place(marks) + (random_.chance(0.2) ? " double" : "");
            case 8:
            case 9:
                return drag(marks);
            case 10:
                return "scroll " + place(marks) + ' ' + std::to_string(random_.integer(-3, 3));
            case 11:
                return "key Ctrl+P\ntype " + std::string(1, letter()) + letter() + "\nkey Enter\nkey Escape";
            case 12:
                return "frames " + std::to_string(random_.integer(1, 8));
            case 13:
                return random_.chance(0.3) ? resize() : "key Ctrl+Z";
            case 14:
                return "key Space\nframes 2\n" + drag(marks) + (random_.chance(0.5) ? "\nkey Space" : "");
            case 15:
            case 16:
            case 17:
                return edit(session);
            default:
                return "type " + std::string(1, letter()) + std::to_string(random_.integer(-3, 9));
        }
    }

  private:
    static std::vector<std::string_view> words(std::string_view text) {
        std::vector<std::string_view> out;
        while (!text.empty()) {
            const std::size_t end = std::min(text.find(' '), text.size());
            if (end > 0) out.push_back(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        return out;
    }

    template <class List>
    typename List::value_type any(const List& of) {
        return of[static_cast<std::size_t>(random_.integer(0, static_cast<int>(of.size()) - 1))];
    }

    char letter() { return static_cast<char>('a' + random_.integer(0, 25)); }

    std::string resize() {
        size_ = {random_.integer(least_.width, most_.width), random_.integer(least_.height, most_.height)};
        return "size " + std::to_string(size_.width) + 'x' + std::to_string(size_.height);
    }

    std::string pixel() {
        return std::to_string(random_.integer(0, size_.width - 1)) + ' ' +
               std::to_string(random_.integer(0, size_.height - 1));
    }

    /// Every other time a widget, as pixels.
    std::string place(const Marks& marks) {
        if (marks.all().empty() || random_.chance(0.5)) return pixel();
        std::vector<glm::vec2> middles;
        for (const auto& [name, rect] : marks.all()) middles.push_back(rect.center());
        const glm::vec2 at = any(middles);
        return std::to_string(static_cast<int>(at.x)) + ' ' + std::to_string(static_cast<int>(at.y));
    }

    std::string drag(const Marks& marks) {
        constexpr std::array<const char*, 4> kButtons{"", "", " right", " middle"};
        return "drag " + place(marks) + ' ' + pixel() + any(kButtons);
    }

    std::string run(const Session& session) {
        const Command& command = *any(commands_);
        std::string out = "run " + std::string(command.id);
        if (command.argument.empty() || (!command.needs_argument() && random_.chance(0.5))) return out;
        const std::vector<std::string> choices =
            command.choices ? command.choices(session) : std::vector<std::string>{};
        if (!choices.empty()) return out + ' ' + any(choices);
        constexpr std::array<const char*, 12> kArguments{"0", "1", "2",   "3",      "0.5", "2.5",
                                                         "7", "A", "1:2", "leaves", "3 1", "-20 15"};
        return out + ' ' + any(kArguments);
    }

    /// Of an agent, if there is one.
    std::string edit(const Session& session) {
        const std::vector<Agent>& agents = session.workspace.scene().agents;
        constexpr std::array<const char*, 8> kEdits{"agent.nudge 1 0.5",   "agent.turn 30",        "agent.duplicate",
                                                    "agent.remove",        "tree.leaf 3",          "tree.kind umobb",
                                                    "agent.color #1060a0", "agent.rename somebody"};
        return (agents.empty() ? "" : "run go.agent \"" + any(agents).name + "\"\n") + "run " + any(kEdits);
    }

    mobb::test::Random random_;
    PictureSize least_, most_, size_;
    std::vector<const Command*> commands_;
    std::vector<std::string> keys_;
};

}  // namespace testing
}  // namespace mobbscope::app
