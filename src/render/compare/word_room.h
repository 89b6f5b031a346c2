/// What the width of words decides in a picture, so that it may be other with other fonts.
#pragma once

#include <render/compare/elements.h>
#include <render/image/rect.h>

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::compare {

/// Whether two texts may be one that is cut by other widths: "a long na\u2026" and "a long n\u2026".
bool are_cut_alike(const std::string& a, const std::string& b);

/// Whose words are compared with all of the caption.
bool is_caption(const JsonValue& text);

/// Whether a panel has room, how a caption's lines break, and whether a label finds a free place.
class WordRoom {
  public:
    WordRoom(const JsonValue& actual, const JsonValue& golden);

    /// "caption: 'A misses' instead of 'A meets'", if the words of both may not be the same ones.
    std::optional<std::string> caption_words() const;

    /// It may be missing or elsewhere, or be anything.
    enum class Excuse { none, place, all };
    enum Side { in_actual, in_golden };

    /// Of an element of one list that the other one has not, or not there.
    Excuse excuse(const ElementKind& kind, const JsonValue& element, Side side) const;

  private:
    struct Text {
        std::string words;
        bool is_label = false;
        Rect rect;
    };
    struct List {
        List(const JsonValue& list, std::set<std::string>& without_room);

        Rect picture;
        std::string headline;
        bool roles = false;                ///< some texts have a role
        std::vector<std::string> caption;  ///< lines
        float caption_height = 0;
        std::vector<Text> texts;
        std::vector<Rect> panels;
        std::vector<std::pair<std::string, Rect>> overlays;
    };

    bool is_in_panel(const List& list, const Rect& rect) const;
    bool is_beside_label(Side side, const Rect& rect, bool is_line) const;
    static bool is_crowded(const List& list, const Text& label);

    std::set<std::string> without_room_;  ///< overlays, in one list or the other
    std::array<List, 2> lists_;
};

}  // namespace mobbscope::compare
