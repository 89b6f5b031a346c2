/// The small parts that panels with words and numbers are put together from.
#pragma once

#include <app/ui/ui.h>
#include <base/name_list.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// A quiet heading with room above it; `right` stands at the other end of its line if there is room.
void heading(Ui& ui, const char* text, const std::string& right = "");

/// Whether the section with that title in small letters is folded; `at_first`: until somebody folds or unfolds it.
bool is_folded(const Settings& settings, const std::string& title, bool at_first = false);
/// A heading that folds what stands below it at a click: whether that is to be drawn. Settings remember it by the
/// title, which is not made of names that change; `section.<title in small letters>` for scripts.
[[nodiscard]] bool section(Ui& ui, const std::string& title, const std::string& right = "",
                           bool folded_at_first = false);

/// A line of text in a colour, and in a font; null: the present one.
void text_line(ImU32 color, const std::string& text, ImFont* font = nullptr);

/// Text in a colour, wrapped between words: ImGui would break numbers at their points.
void words(ImU32 color, const std::string& text);

/// A text in lines as wide as `room`, in the present font: broken between words, and in a word that is longer than a
/// line, as a path, behind its slashes.
std::string wrapped(const std::string& text, float room);

/// The same text with the middle of each path left out that does not fit `room`: "/home/…/scenes/crossing.json".
std::string with_short_paths(const std::string& text, float room);

/// A number that copies itself: under the mouse it is underlined, and its tooltip has all its digits.
struct CopiedNumber {
    double value = 0;
    std::string unit{};
    std::string tip{};       ///< what else its tooltip says, above
    bool with_ctrl = false;  ///< a click alone does something else
};
/// It stands in this part of the last item. Whether a click there is for it now.
bool copies(Ui& ui, const Rect& place, const CopiedNumber& number);
/// Likewise all numbers of a text that the last item shows from a place on, in lines. `exact`: those of them that are
/// known with all their digits.
bool copies_numbers(Ui& ui, const std::string& text, ImVec2 at, const ImFont& font, std::vector<double> exact = {},
                    bool with_ctrl = false);
/// Words whose numbers copy themselves.
void words(Ui& ui, ImU32 color, const std::string& text, std::vector<double> exact = {});

/// A number as shown, which copies itself.
void number(Ui& ui, const std::string& shown, double value, const char* unit, ImU32 color);

/// A label at the left and, at the right edge, a number; for scripts "number.<label>", in small letters.
void number_row(Ui& ui, const char* label, const std::string& shown, double value, const char* unit);

/// A row of a form: the label at the left, the next widget takes the rest. `help` is its tooltip; null: none.
void form_label(Ui& ui, const char* label, const char* help);

/// A frame around what `draw` draws, as wide as there is room.
void framed(Ui& ui, ImU32 fill, ImU32 border, const std::function<void()>& draw);

/// The next widget, `width` pixels wide, goes on the same line if it fits there.
void flow(float width);

/// "+0.183"
std::string signed_metres(double metres);

/// Disabled as the command is; its tooltip says what the command does and by which key. `mark` names it for scripts.
void command_button(Ui& ui, const char* label, const char* command, const std::string& mark);

/// A small button with a mark for scripts, and a tooltip; empty: none.
bool small_button(Ui& ui, const char* label, const std::string& mark, const char* help = "");

/// One of a few words to choose from.
struct ChoiceWord {
    std::string name;  ///< for scripts, behind the mark of the choice
    std::string word;
    const char* help = "";
};
/// Words of which one is chosen, which is lit; in several lines where they have to. Returns the index of one that is
/// pressed; -1: none is.
int word_choice(Ui& ui, const std::string& mark, std::span<const ChoiceWord> all, int chosen);

/// Text of a font where it is told, in a picture.
void draw_text(ImDrawList& list, const ImFont& font, ImVec2 at, ImU32 color, const std::string& text);
ImVec2 text_size(const ImFont& font, const std::string& text);

/// Numbers along a side of a chart.
struct ChartAxis {
    double from = 0, to = 1;    ///< at the two ends, not equal
    float first = 0, last = 1;  ///< pixels there

    float pixel(double value) const {
        return first + static_cast<float>((value - from) / (to - from)) * (last - first);
    }
    double value(float pixel) const {
        return from + static_cast<double>((pixel - first) / (last - first)) * (to - from);
    }
};

/// Pixels of a button with this label, in the present font and style.
float button_width(const char* label);

/// A text on one line that fits `room` pixels in the present font: its end becomes an ellipsis.
std::string fitted_text(const std::string& text, float room);

/// A name on one line that fits `room` pixels: an ellipsis stands for what the names of its list have in common, or for
/// its middle.
std::string fitted_name(const std::string& name, float room);
std::string fitted_name(const std::string& name, float room, const NameList& list);

/// "A against B", likewise, as "07_05 \u2013 07_06": each of the two has its share of the room.
std::string fitted_pair(const std::string& a, const char* between, const std::string& b, float room,
                        const NameList& list);

/// Under the mouse the last item says all of a text that is shown shorter.
void tell_whole(const Ui& ui, const std::string& shown, const std::string& whole);

/// A line of text that fits `room` pixels, of which the mouse tells the rest.
void fitted_line(const Ui& ui, ImU32 color, const std::string& text, float room, ImFont* font = nullptr);
/// ... of a name.
void name_line(const Ui& ui, ImU32 color, const std::string& name, float room, const NameList& list);

/// A field that opens a list to choose from, as wide as the next item is to be; ends with ImGui::EndCombo() if it is
/// open. `label`: by whose letters it is found.
[[nodiscard]] bool begin_dropdown(Ui& ui, const std::string& mark, const std::string& shown, std::string_view label,
                                  ImGuiComboFlags flags = 0);
/// A text to edit in place. Returns what was typed once that is done, by Enter, Tab or a click elsewhere, and it is
/// another text; Escape takes it back.
std::optional<std::string> text_edit(Ui& ui, const std::string& mark, const std::string& now);

/// A number that is dragged, stepped with Up and Down, and typed after Enter or a click. Shift makes steps and drags
/// finer, Ctrl coarser.
struct NumberField {
    std::string mark;  ///< its name for scripts
    std::string what;  ///< "The samples of a leaf", for what is said of a number that is out of range
    double now = 0;
    std::string before{};   ///< shown in front of it
    std::string unit{};     ///< ... and behind it, as "m" or "\u00B0"
    std::string instead{};  ///< shown until it is another number: nobody has given it; empty: the number is
    int decimals = 0;       ///< shown; of a whole number 0
    double step = 1;        ///< of an arrow key; a pixel of a drag is a tenth of it
    double least = -std::numeric_limits<double>::max(), most = std::numeric_limits<double>::max();
    bool by_factors = false;  ///< steps are of a tenth of the number, which is shown with three digits
    bool live = true;         ///< the number follows a drag, not only where it ends
};
/// As wide as the next item is to be. Returns the number that is wanted now, within its range, where it is another.
std::optional<double> number_field(Ui& ui, const NumberField& field);

/// A list with a row of equal height for each item: as high as its rows, at most `most_rows` before it scrolls.
/// `present`: the row that a list which scrolls opens at.
void rows(Ui& ui, const char* name, int count, int most_rows, int present, const std::function<void(int)>& draw);
/// Of a list without a present row.
inline void rows(Ui& ui, const char* name, int count, int most_rows, const std::function<void(int)>& draw) {
    rows(ui, name, count, most_rows, 0, draw);
}
/// Where in a list the first thing stands that `is` present; 0: nowhere.
template <class List, class Is>
int present_row(const List& list, const Is& is) {
    const auto at = std::ranges::find_if(list, is);
    return at == std::ranges::end(list) ? 0 : static_cast<int>(at - std::ranges::begin(list));
}

/// Rows alone, of which those are drawn that are seen or that the keys go to. `height`: of one, pixels. `shown_first`:
/// the row that is scrolled to where the list appears.
void clipped_rows(Ui& ui, const char* name, int count, float height, const std::function<void(int)>& draw,
                  int shown_first = 0);

/// A list's row across the panel: a name, and a short remark at its right end. Returns true when it is clicked.
struct Row {
    std::string mark;  ///< its name for scripts
    std::string name;
    std::string remark;
    bool selected = false;
    bool hovered = false;    ///< lit, as it is under the mouse elsewhere
    float indent = 0;        ///< pixels left of the name
    ImU32 remark_color = 0;  ///< 0: quiet
    bool quiet = false;      ///< the name too
    float buttons = 0;       ///< pixels at its right end that are left to buttons, which come next on the line
    float right = 0;         ///< pixels of them that the remark keeps free, <= buttons
    /// The name on so many pixels; by itself it loses its middle.
    std::function<std::string(float room)> fitted{};
    std::vector<double> exact{};  ///< numbers of the remark with all their digits; Ctrl and a click copies them
};
bool row(Ui& ui, const Row& row);

}  // namespace mobbscope::app
