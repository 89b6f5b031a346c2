/// Which widget has the keys, and what they do there: Tab, arrows, Enter, Escape; in lists and menus too. Dear ImGui's
/// own keyboard navigation is off: it differs between versions, knows no lists longer than they are drawn, and takes
/// the arrows that step through a query.
#pragma once

#include <app/input/key.h>
#include <app/session/session.h>
#include <app/ui/style.h>
#include <render/drawlist/draw_list.h>

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// Keys that a widget wants for itself while it has the focus (Focus::take). Of all others Enter and Space press it,
/// and arrows go to the next widget in their direction. `text`: Tab alone is enough to type into it.
enum class OwnKeys { none, up_down, left_right, menu, text };

class Focus {
  public:
    explicit Focus(Session& session) : session_(session) {}

    // --- between frames

    /// A key went down; true if it was for the focus: nobody else gets it then.
    bool press(const Chord& chord, bool repeated);
    /// What a command asked for.
    void follow_commands();

    // --- while panels are drawn, from NewFrame to Render

    void begin_frame();
    /// Widgets that follow stand in this panel.
    void panel(std::string_view name) { panel_ = name; }
    /// The last widget, an item of Dear ImGui, can have the focus; one of id 0 or that is disabled cannot.
    /// `label`: by whose first letters it is found in a menu; empty: the end of its name.
    void add(const std::string& name, const Rect& rect, ImGuiID id, OwnKeys own, std::string_view label);
    /// In a list or menu that the focus comes into, it begins with the widget added last.
    void begin_here();
    /// A menu, whether its popup is open and drawn from now on or not.
    void add_menu(const std::string& name, const Rect& rect, ImGuiID id, std::string_view label, bool open);
    /// Keys that were pressed for this widget since the last frame: Enter, and its own.
    std::vector<Chord> take(std::string_view name);
    /// Gives the keys to an item as a person does who presses it: a field is typed into.
    void activate(ImGuiID id) { activated_ = id; }
    /// Whether an arrow has just led to the row of the list whose widget was added last.
    bool arrived_at_last() const { return !arrived_.empty() && !added_.empty() && added_.back().name == arrived_; }
    /// Whether the widget added last, which has a menu of its own, is asked for that now by a key.
    bool opens_menu_of_last();
    /// The same of the picture, which is no widget: it is asked where nothing has the focus, or what has none itself.
    bool opens_menu_of_picture() { return std::exchange(picture_menu_asked_, false); }
    /// An item that was pressed by Enter has done its work, and the picture has the keys; Space stays on it.
    void done_with(const std::string& name);
    /// The field that is typed into has a use for Tab in this frame.
    void keep_tab() { tab_is_kept_ = true; }
    /// Rows of equal height, of which not all are drawn. Between the two, `row` says which one the next widgets are of.
    void begin_list(ImGuiID list, int count);
    void row(int index) { row_ = index; }
    void end_list() { list_ = 0; }
    /// The row of this list to which the focus goes: it must be drawn, whether it is seen or not.
    std::optional<int> wanted_row() const;
    void end_frame(const Style& style);

    /// Where a widget stood in the last frame: an open menu hides its own place.
    std::optional<Rect> last_place(std::string_view name) const;

  private:
    struct Stop {
        std::string name;
        std::string panel;
        std::string label;  ///< lower case
        Rect rect, clip;
        ImGuiID id = 0;
        OwnKeys own = OwnKeys::none;
        int level = 0;     ///< in so many popups
        ImGuiID list = 0;  ///< 0: none
        int row = 0, column = 0;
        bool begins = false;
        bool open = false;      ///< a menu
        bool has_menu = false;  ///< of its own
    };
    struct WantedRow {
        ImGuiID list;
        int row, column;
    };

    void add(Stop stop, const std::string& name, const Rect& rect, ImGuiID id, std::string_view label);
    int level() const { return static_cast<int>(at_.size()) - 1; }
    bool reachable(const Stop& stop) const;
    const Stop* find(std::string_view name) const;
    const Stop* here() const { return find(at_.back()); }
    void go(const Stop& stop);
    void show();
    void leave();
    void press_stop(const Stop& stop);
    bool in_text(const Chord& chord);
    bool in_popup(const Chord& chord);
    bool in_window(const Chord& chord);
    void tab(bool back);
    void next_panel(bool back);
    void open_menus();
    void open_menu(const Stop& menu);
    void ask_for_menu();
    void search(char letter);
    void beside_in_menu_bar(int way);
    void along(int by);
    bool in_list(const Stop& from, Key key);
    const Stop* towards(const Stop& from, Key key) const;
    /// The next Tab stop, forwards or backwards.
    const Stop* from_order(std::size_t begin, bool back, const Stop* left) const;
    const Stop& entered(const Stop& stop) const;
    const Stop* where_popup_begins() const;
    void follow_popups();
    void follow_dialog();
    void draw_ring(const Style& style) const;

    Session& session_;
    std::vector<Stop> stops_;  ///< of the last frame
    std::vector<Stop> added_;  ///< of this one
    /// Where the focus is: in the window, and in each popup over it.
    std::vector<std::string> at_{""};
    std::size_t order_ = 0;  ///< of the last one in the window, among all
    std::string left_;       ///< from where it went back to the viewport
    bool visible_ = false;   ///< the last thing used was a key, not the mouse
    bool typing_ = false;    ///< a field is typed into
    bool ends_typing_ = false;
    bool reveals_ = false;  ///< what has the focus is scrolled to
    std::optional<WantedRow> wanted_;
    int wanted_for_ = 0;   ///< frames
    std::string arrived_;  ///< the row that was wanted, in the frame in which it is there
    std::vector<std::pair<std::string, Chord>> pressed_;
    std::string entered_;     ///< pressed by Enter in this frame
    std::string menu_asked_;  ///< the widget whose own menu a key asks for
    bool picture_menu_asked_ = false;
    std::string searched_;  ///< letters that were typed in a menu, one shortly after the other
    double searched_at_ = 0;
    ImGuiID activated_ = 0;
    bool tab_is_kept_ = false;
    std::string panel_;
    ImGuiID list_ = 0;
    int list_count_ = 0;
    int row_ = 0;
    std::vector<std::pair<ImGuiID, int>> counts_, added_counts_;  ///< of lists
    Dialog dialog_ = Dialog::none;
    std::pair<std::string, bool> behind_dialog_;
    int opening_ = 0;
};

}  // namespace mobbscope::app
