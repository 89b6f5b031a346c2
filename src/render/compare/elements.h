/// Elements of a draw list's arrays (draw_list_json.h): what they stand for, what they are called, how alike two are.
#pragma once

#include <render/compare/json_values.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::compare {

/// What elements of one array are.
struct ElementKind {
    std::string_view list;                    ///< key of the array; empty: any other array
    std::string_view element;                 ///< for messages
    std::array<std::string_view, 2> name{};   ///< members that tell what an element stands for
    bool renamed = false;                     ///< one whose name alone differs is the same one
    bool in_order = true;                     ///< their order is seen
    std::array<std::string_view, 2> loose{};  ///< members that follow from the width of words

    /// Disks and boxes: what has an id.
    bool is_object() const { return name[0] == "participant"; }
    bool is_text() const { return list == "texts"; }
};

/// Null if it is no array of a draw list.
const ElementKind* kind_of(std::string_view list);
/// Whether it is an object with such an array.
bool is_draw_list(const JsonValue& value);

/// How elements of one array are compared.
struct ElementTerms {
    ElementKind kind;
    bool other_fonts = false;
    double bound = 0;   ///< of loose members, pixels
    bool roles = true;  ///< all texts have a role

    /// Whether a member tells which elements belong together, or what differs in one.
    bool counts(std::string_view key) const {
        if (kind.is_object()) return key != "id" && key != "pixels";
        if (kind.list == "camera") return key != "clip_from_world";
        if (!kind.is_text()) return true;
        return key == "role" ? roles : key != "on_screen" || !other_fonts;
    }
    double bound_of(std::string_view key) const {
        return other_fonts && std::ranges::find(kind.loose, key) != kind.loose.end() ? bound : 0;
    }
};

/// What the participants of a draw list are called, by index; empty: it has no name.
std::vector<std::string> participants_of(const JsonValue& list);

/// What an element stands for, as bytes; empty: nothing by itself.
std::string key_of(const ElementTerms& terms, const JsonValue& element, std::size_t index,
                   const std::vector<std::string>& participants);

/// "box of A, node 3", "tick label '20 s'", "line 4 of the rings from (0, 0) to (1, 0)".
std::string element_words(const ElementKind& kind, const JsonValue& element, std::size_t index,
                          const std::vector<std::string>& participants);

/// All of an element that counts, as bytes. `rounded`: numbers to three digits or so, so that what differs in its last
/// one most often is equal too.
std::string fingerprint(const ElementTerms& terms, const JsonValue& element, bool rounded);

/// How much of two elements has to agree for them to be the same one.
enum class Agreeing { any, half, all_but_one, all };

/// How alike two elements are.
struct Likeness {
    std::size_t agreeing = 0;  ///< members
    std::size_t unlike = 0;
    double apart = 0;

    bool enough(Agreeing least) const {
        if (least == Agreeing::half) return agreeing >= unlike;
        return least == Agreeing::any || unlike <= (least == Agreeing::all ? 0u : 1u);
    }
    bool operator>(const Likeness& other) const {
        return agreeing > other.agreeing || (agreeing == other.agreeing && apart < other.apart);
    }
};
Likeness likeness(const ElementTerms& terms, const JsonValue& actual, const JsonValue& golden);

}  // namespace mobbscope::compare
