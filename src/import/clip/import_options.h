/// The import options as a table: their keys in a scene, their words for people, what they mean something for; and what
/// a file offers to each.
#pragma once

#include <import/clip/imported_clip.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace mobbscope {

/// What the files of a format hold, which decides what options mean something for them.
enum class Contents : std::uint8_t {
    skeletons,     ///< joints that move: clips of one body
    table,         ///< rows of numbers: clips without joints
    trajectories,  ///< a crowd by one clock: every track is a clip, placed in time
};

struct ImportOption {
    const char* key;    ///< in a scene
    const char* label;  ///< for people: "Root joint"
    const char* help;   ///< one sentence
    const char* unit;   ///< of a number: "m"
    std::variant<std::optional<std::string> ImportOptions::*, std::optional<double> ImportOptions::*,
                 std::optional<std::pair<double, double>> ImportOptions::*, std::optional<Origin> ImportOptions::*,
                 std::optional<mobb::Motion> ImportOptions::*, std::optional<Radius> ImportOptions::*,
                 std::optional<bool> ImportOptions::*>
        member;
    bool for_skeletons, for_tracks;  ///< of both kinds: tables and trajectories
    bool of_file;                    ///< what holds for one clip of a file usually holds for all of them

    bool means_something_for(Contents contents) const {
        return contents == Contents::skeletons ? for_skeletons : for_tracks;
    }
    bool is_number() const {
        return std::holds_alternative<std::optional<double> ImportOptions::*>(member) ||
               std::holds_alternative<std::optional<Radius> ImportOptions::*>(member);
    }
    bool is_given(const ImportOptions& options) const {
        return std::visit([&](auto of) { return (options.*of).has_value(); }, member);
    }
};

/// Every option, in the order of files.
inline constexpr ImportOption kImportOptions[] = {
    {"animation", "Animation", "Which of the file's animations is taken", "", &ImportOptions::animation, true, false,
     false},
    {"root", "Root joint", "The joint whose way over the ground is the path", "", &ImportOptions::root, true, false,
     true},
    {"fps", "Sample rate", "How often the motion is sampled, times a second", "/s", &ImportOptions::fps, true, true,
     true},
    {"unit", "Unit", "How long a unit of the file is: m, cm, in, auto or metres", "m", &ImportOptions::unit, true, true,
     true},
    {"up", "Up axis", "The axis of the file that points up", "", &ImportOptions::up, true, false, true},
    {"trim", "Trim", "Only this part of the file, in seconds from its first key or earliest row", "s",
     &ImportOptions::trim, true, true, false},
    {"origin", "Origin", "Where the path is put", "", &ImportOptions::origin, true, true, true},
    {"id", "Track", "Which of the file's tracks is taken", "", &ImportOptions::id, false, true, false},
    {"radius", "Radius", "Of every sample, or the column of a CSV that holds it, in place of what the file says", "m",
     &ImportOptions::radius, true, true, true},
    {"dt", "Frame time", "Seconds between rows without times, or from one frame number to the next", "s",
     &ImportOptions::dt, false, true, true},
    {"columns", "Columns", "Which columns of a table are id, t, x, y, r and others: id=trackId,t=frame/25", "",
     &ImportOptions::columns, false, true, true},
    {"motion", "Motion", "What a disk does until the next sample: it stays, or runs straight to it", "",
     &ImportOptions::motion, true, true, true},
    {"keep_jumps", "Jumps", "Whether tracks stay whole where they jump or pause as nobody does", "",
     &ImportOptions::keep_jumps, false, true, true},
};

/// Null if there is none.
const ImportOption* import_option(std::string_view key);

/// Calls `visit` with the key in a scene of every option, and the option as a member.
template <class Visit>
void for_each_import_option(const Visit& visit) {
    for (const ImportOption& option : kImportOptions) {
        std::visit([&](auto member) { visit(option.key, member); }, option.member);
    }
}

/// An option as text: "cm", "0.5 3.2"; empty if it is left out.
std::string option_text(const ImportOptions& options, const ImportOption& option);

/// The option read from such text; an empty one leaves it out. Throws std::invalid_argument, naming the option, if the
/// text is none or out of range.
void set_option(ImportOptions& options, const ImportOption& option, std::string_view text);

/// A value that an option can take for a file.
struct OfferedChoice {
    std::string value;  ///< as option_text
    std::string label;  ///< for people: "cm: a body 1.72 m tall"
};

/// What a file has for one option.
struct OptionOffer {
    std::string key;
    std::string taken;  ///< where the option is left out: "0.01", "Hips"; empty: nothing that fits one word
    std::string why;    ///< "a body 1.72 m tall"; of what must be given, what is missing
    bool required = false;
    std::vector<OfferedChoice> choices{};  ///< empty: any value within its range
};

/// A unit as an option says it: "cm" where it has a name.
std::string unit_word(double metres);

/// That of the origin, which is every file's.
OptionOffer origin_offer();

/// Likewise that of the motion between samples, with the one that is taken and why.
OptionOffer motion_option_offer(mobb::Motion taken, const std::string& why);

/// What a file has for the options that mean something for it, in the order of the table; options that it gives no
/// choice are left out.
struct ImportOffer {
    double seconds = 0;  ///< that trim may take a part of
    std::vector<OptionOffer> options{};

    const OptionOffer* find(std::string_view key) const;
};

}  // namespace mobbscope
