#include <app/ui/focus.h>
#include <base/text.h>

#include <imgui_internal.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

namespace mobbscope::app {

namespace {

constexpr int kPageOfRows = 8;
constexpr int kFramesForRow = 4;      // a row that is not drawn by then is gone
constexpr double kLettersBelong = 1;  // seconds within which letters are the beginning of one word
constexpr std::string_view kMenuBar = "menu";
constexpr std::string_view kDialog = "dialog";
constexpr std::string_view kMessages = "messages";

/// Dear ImGui has renamed the member.
template <class Data>
bool is_disabled(const Data& item) {
    if constexpr (requires { item.InFlags; }) {
        return (item.InFlags & ImGuiItemFlags_Disabled) != 0;
    } else {
        return (item.ItemFlags & ImGuiItemFlags_Disabled) != 0;
    }
}

/// Presses an item in this frame; a field is typed into. Until 1.89 that had an id of its own.
template <class Context>
void activate_now(Context& context, ImGuiID id) {
    context.NavActivateId = context.NavActivateDownId = id;
    context.NavActivateFlags = ImGuiActivateFlags_PreferInput;
    if constexpr (requires { context.NavActivateInputId; }) context.NavActivateInputId = id;
}

/// A text has the keys.
bool is_typing() {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    return context.ActiveId != 0 && context.ActiveId == context.InputTextState.ID;
}

bool is_arrow(Key key) { return key == Key::left || key == Key::right || key == Key::up || key == Key::down; }

bool wants(OwnKeys own, Key key) {
    const bool upright = key == Key::up || key == Key::down;
    const bool sideways = key == Key::left || key == Key::right;
    return (own == OwnKeys::up_down && upright) || (own == OwnKeys::left_right && sideways);
}

float gap(float min_a, float max_a, float min_b, float max_b) { return std::max({0.0f, min_b - max_a, min_a - max_b}); }

void close_popups_from(int level) {
    if (level < ImGui::GetCurrentContext()->OpenPopupStack.Size) ImGui::ClosePopupToLevel(level, false);
}

Rect rect_of(ImVec2 min, ImVec2 max) { return {{min.x, min.y}, {max.x, max.y}}; }

}  // namespace

// --- where the focus is

bool Focus::reachable(const Stop& stop) const {
    if (stop.level != level()) return false;
    // A dialog takes all keys; what went wrong in it is said beside it.
    return level() > 0 || session_.dialogs.now == Dialog::none || stop.panel == kDialog || stop.panel == kMessages;
}

const Focus::Stop* Focus::find(std::string_view name) const {
    if (name.empty()) return nullptr;
    const auto at = std::find_if(stops_.begin(), stops_.end(),
                                 [&](const Stop& stop) { return stop.name == name && reachable(stop); });
    return at == stops_.end() ? nullptr : &*at;
}

std::optional<Rect> Focus::last_place(std::string_view name) const {
    const auto at = std::find_if(stops_.begin(), stops_.end(), [&](const Stop& stop) { return stop.name == name; });
    return at == stops_.end() ? std::nullopt : std::optional(at->rect);
}

void Focus::go(const Stop& stop) {
    show();
    at_.back() = stop.name;
    reveals_ = true;
    wanted_.reset();
}

/// The keys are used from now on. Behind a popup they were not: what was clicked there does not get them by itself.
void Focus::show() {
    if (!visible_ && level() > 0) left_ = std::exchange(at_.front(), "");
    visible_ = true;
}

void Focus::leave() {
    left_ = std::exchange(at_.front(), "");
    visible_ = false;
    wanted_.reset();
}

void Focus::done_with(const std::string& name) {
    // Screens have no arrows that step: there one goes on where one is.
    if (entered_ == name && level() == 0 && session_.dialogs.now == Dialog::none && !session_.screen) leave();
}

void Focus::press_stop(const Stop& stop) {
    if (stop.own == OwnKeys::none || stop.own == OwnKeys::text) {
        activate(stop.id);
    } else {
        pressed_.emplace_back(stop.name, Chord{Key::enter});
    }
}

// --- keys

bool Focus::press(const Chord& chord, bool repeated) {
    if (is_typing() && !ends_typing_) return in_text(chord);
    if (repeated && (chord.key == Key::enter || chord.key == Key::space)) return visible_ && here();
    return level() > 0 ? in_popup(chord) : in_window(chord);
}

bool Focus::in_text(const Chord& chord) {
    if (chord == Chord{Key::down} && level() > 0) {
        // From a field of a popup into the list that it searches.
        ends_typing_ = true;
        along(1);
        return true;
    }
    if (chord.key != Key::tab || chord.ctrl || chord.alt || tab_is_kept_) return false;
    ends_typing_ = true;
    tab(chord.shift);
    return true;
}

bool Focus::in_popup(const Chord& chord) {
    if (chord == Chord{Key::alt}) {
        close_popups_from(0);
        return true;
    }
    if (chord.ctrl || chord.alt) return false;
    // A menu opens what the mouse rests on: it is away until it moves.
    ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
    // Of what the mouse has opened, keys go on from the row that is chosen.
    if (const Stop* chosen = here() ? nullptr : where_popup_begins(); chosen && chosen->begins) {
        at_.back() = chosen->name;
    }
    const Stop* stop = here();
    const std::string_view key = name(chord.key);
    if (key.size() != 1) searched_.clear();
    if (stop && stop->list != 0 && in_list(*stop, chord.key)) return true;
    switch (chord.key) {
        case Key::escape:
            close_popups_from(level() - 1);
            return true;
        case Key::enter:
        case Key::space:
            if (stop) press_stop(*stop);
            return true;
        case Key::down:
            along(1);
            return true;
        case Key::up:
            along(-1);
            return true;
        case Key::page_down:
            along(kPageOfRows);
            return true;
        case Key::page_up:
            along(-kPageOfRows);
            return true;
        case Key::home:
            along(-static_cast<int>(stops_.size()));
            return true;
        case Key::end:
            along(static_cast<int>(stops_.size()));
            return true;
        case Key::tab:
            along(chord.shift ? -1 : 1);
            return true;
        case Key::right:
            if (stop && stop->own == OwnKeys::menu) {
                press_stop(*stop);
            } else {
                beside_in_menu_bar(1);
            }
            return true;
        case Key::left:
            if (level() > 1) {
                close_popups_from(level() - 1);
            } else {
                beside_in_menu_bar(-1);
            }
            return true;
        default:
            break;
    }
    if (key.size() != 1) return false;
    search(lower_letter(key[0]));
    return true;
}

/// Goes to what begins with the letters typed so far; the same letter again goes on to the next. Where nothing begins
/// so, nothing moves.
void Focus::search(char letter) {
    const double now = ImGui::GetTime();
    if (now - searched_at_ > kLettersBelong) searched_.clear();
    searched_at_ = now;
    searched_ += letter;
    const bool one_letter = searched_.find_first_not_of(letter) == std::string::npos;
    const std::string_view wanted = one_letter ? std::string_view(searched_).substr(0, 1) : searched_;
    const auto fits = [&](const Stop& s) { return reachable(s) && s.label.starts_with(wanted); };
    // A further letter may leave it where it is.
    const Stop* stop = here();
    const auto from = stops_.begin() + (stop ? stop - stops_.data() + (one_letter ? 1 : 0) : 0);
    if (const auto behind = std::find_if(from, stops_.end(), fits); behind != stops_.end()) return go(*behind);
    if (const auto before = std::find_if(stops_.begin(), from, fits); before != from) go(*before);
}

bool Focus::in_window(const Chord& chord) {
    if (chord.key == Key::tab && !chord.ctrl && !chord.alt) {
        tab(chord.shift);
        return true;
    }
    const bool in_menu_bar = chord.alt && !chord.ctrl && !chord.shift && session_.dialogs.now == Dialog::none;
    if (const std::string_view key = name(chord.key); in_menu_bar && key.size() == 1) {
        const auto menu = std::find_if(stops_.begin(), stops_.end(), [&](const Stop& stop) {
            return stop.panel == kMenuBar && stop.own == OwnKeys::menu &&
                   stop.label.starts_with(lower_letter(key[0])) && reachable(stop);
        });
        if (menu == stops_.end()) return false;
        open_menu(*menu);
        return true;
    }
    const Stop* stop = visible_ ? here() : nullptr;
    if (!stop) return false;
    if (wants(stop->own, chord.key)) {
        pressed_.emplace_back(stop->name, chord);
        return true;
    }
    if (chord.ctrl || chord.alt) return false;
    if (chord.key == Key::enter || chord.key == Key::space) {
        if (chord.key == Key::enter) entered_ = stop->name;
        press_stop(*stop);
        return true;
    }
    if (chord.key == Key::escape) {
        // A dialog is left as a whole.
        if (session_.dialogs.now != Dialog::none) return false;
        leave();
        return true;
    }
    if (stop->list != 0 && in_list(*stop, chord.key)) return true;
    if (!is_arrow(chord.key) || chord.shift) return false;
    if (const Stop* next = towards(*stop, chord.key)) {
        go(*next);
        return true;
    }
    // An arrow that leads nowhere here does what it does in the viewport.
    return false;
}

/// Through a popup, around its ends if by one.
void Focus::along(int by) {
    std::vector<const Stop*> all;
    int now = -1;
    for (const Stop& stop : stops_) {
        if (!reachable(stop)) continue;
        if (stop.name == at_.back()) now = static_cast<int>(all.size());
        all.push_back(&stop);
    }
    if (all.empty()) return;
    const int count = static_cast<int>(all.size());
    int next = now < 0 ? (by > 0 ? 0 : count - 1) : now + by;
    next = std::abs(by) == 1 ? (next + count) % count : std::clamp(next, 0, count - 1);
    go(*all[static_cast<std::size_t>(next)]);
}

/// Where a menu of the bar is open, the one beside it opens instead.
void Focus::beside_in_menu_bar(int way) {
    std::vector<const Stop*> menus;
    for (const Stop& stop : stops_) {
        if (stop.level == 0 && stop.panel == kMenuBar && stop.own == OwnKeys::menu) menus.push_back(&stop);
    }
    const auto open = std::find_if(menus.begin(), menus.end(), [](const Stop* stop) { return stop->open; });
    if (open == menus.end()) return;
    const auto count = static_cast<int>(menus.size());
    const int next = (static_cast<int>(open - menus.begin()) + way + count) % count;
    open_menu(*menus[static_cast<std::size_t>(next)]);
}

void Focus::open_menu(const Stop& menu) {
    if (level() == 0 && !visible_) leave();
    show();
    at_.back() = level() > 0 ? "" : at_.back();
    press_stop(menu);
    ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
}

void Focus::open_menus() {
    if (level() > 0) {
        close_popups_from(0);
        return;
    }
    const auto menu = std::find_if(stops_.begin(), stops_.end(), [&](const Stop& stop) {
        return stop.panel == kMenuBar && stop.own == OwnKeys::menu && reachable(stop);
    });
    if (menu != stops_.end()) open_menu(*menu);
}

/// Of what has the focus, else of the picture.
void Focus::ask_for_menu() {
    if (level() > 0 || session_.dialogs.now != Dialog::none) return;
    const Stop* stop = visible_ ? here() : nullptr;
    if (!visible_) leave();
    show();
    if (stop && stop->has_menu) {
        menu_asked_ = stop->name;
    } else {
        picture_menu_asked_ = true;
    }
}

bool Focus::opens_menu_of_last() {
    if (added_.empty() || added_.back().id != ImGui::GetItemID()) return false;
    added_.back().has_menu = true;
    if (menu_asked_.empty() || added_.back().name != menu_asked_) return false;
    menu_asked_.clear();
    return true;
}

void Focus::follow_commands() {
    switch (std::exchange(session_.keys.move, FocusMove::none)) {
        case FocusMove::none:
            return;
        case FocusMove::next_panel:
            return next_panel(false);
        case FocusMove::previous_panel:
            return next_panel(true);
        case FocusMove::menu_bar:
            return open_menus();
        case FocusMove::menu_of_this:
            return ask_for_menu();
        case FocusMove::picture:
            behind_dialog_ = {};
            if (visible_ && level() == 0 && session_.dialogs.now == Dialog::none) leave();
            return;
    }
}

/// Of a list the row where it begins.
const Focus::Stop& Focus::entered(const Stop& stop) const {
    if (stop.list == 0) return stop;
    const auto begins =
        std::find_if(stops_.begin(), stops_.end(), [&](const Stop& s) { return s.list == stop.list && s.begins; });
    if (begins != stops_.end()) return *begins;
    // Its first row that is seen, also from behind.
    return *std::find_if(stops_.begin(), stops_.end(), [&](const Stop& s) { return s.list == stop.list; });
}

const Focus::Stop* Focus::from_order(std::size_t begin, bool back, const Stop* left) const {
    const std::size_t count = stops_.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Stop& stop = stops_[(back ? begin + count - i : begin + i) % count];
        if (!reachable(stop) || (left && left->list != 0 && stop.list == left->list)) continue;
        // The menu bar has keys of its own.
        if (stop.panel == kMenuBar && !(left && left->panel == kMenuBar)) continue;
        return &entered(stop);
    }
    return nullptr;
}

void Focus::tab(bool back) {
    if (stops_.empty()) return;
    const Stop* now = here();
    // Back to where it was left.
    if (!now && !visible_ && level() == 0) {
        if (const Stop* before = find(left_)) return go(*before);
    }
    const std::size_t count = stops_.size();
    // From what is gone it goes on where that stood.
    const std::size_t gone = std::min(order_, count);
    const std::size_t at = now ? static_cast<std::size_t>(now - stops_.data()) : (back ? gone : gone + count - 1);
    if (const Stop* next = from_order(back ? at + count - 1 : at + 1, back, now)) {
        go(*next);
        if (next->own == OwnKeys::text) activate(next->id);
    }
}

void Focus::next_panel(bool back) {
    std::vector<const Stop*> firsts;
    for (const Stop& stop : stops_) {
        if (!reachable(stop) || stop.panel == kMenuBar) continue;
        const bool known =
            std::any_of(firsts.begin(), firsts.end(), [&](const Stop* first) { return first->panel == stop.panel; });
        if (!known) firsts.push_back(&entered(stop));
    }
    const Stop* now = visible_ ? here() : nullptr;
    const auto at = std::find_if(firsts.begin(), firsts.end(),
                                 [&](const Stop* first) { return now && first->panel == now->panel; });
    // Behind the last panel comes the viewport.
    const auto count = static_cast<int>(firsts.size());
    const int present = at == firsts.end() ? count : static_cast<int>(at - firsts.begin());
    const int next = (present + (back ? count : 1)) % (count + 1);
    if (next == count) return leave();
    go(*firsts[static_cast<std::size_t>(next)]);
}

bool Focus::in_list(const Stop& from, Key key) {
    const auto count =
        std::find_if(counts_.begin(), counts_.end(), [&](const auto& list) { return list.first == from.list; });
    if (count == counts_.end()) return false;
    int row = from.row;
    switch (key) {
        case Key::up:
            --row;
            break;
        case Key::down:
            ++row;
            break;
        case Key::page_up:
            row -= kPageOfRows;
            break;
        case Key::page_down:
            row += kPageOfRows;
            break;
        case Key::home:
            row = 0;
            break;
        case Key::end:
            row = count->second - 1;
            break;
        default:
            return false;
    }
    row = std::clamp(row, 0, std::max(count->second - 1, 0));
    if (row == from.row) return level() == 0;  // in a popup it goes on to what stands above or below the list
    wanted_ = {from.list, row, from.column};
    wanted_for_ = 0;
    return true;
}

/// The nearest widget of the panel in the direction of an arrow; beside it only what stands on its line.
const Focus::Stop* Focus::towards(const Stop& from, Key key) const {
    const Stop* best = nullptr;
    float least = std::numeric_limits<float>::max();
    const Rect& a = from.rect;
    for (const Stop& stop : stops_) {
        if (&stop == &from || stop.panel != from.panel || !reachable(stop)) continue;
        const Rect& b = stop.rect;
        const glm::vec2 way = b.center() - a.center();
        const float across = gap(a.min.x, a.max.x, b.min.x, b.max.x);
        const float upright = gap(a.min.y, a.max.y, b.min.y, b.max.y);
        float distance = 0;
        if (key == Key::left || key == Key::right) {
            if (upright > 0 || (key == Key::right ? way.x : -way.x) <= 0) continue;
            distance = across;
        } else {
            const float overlap = std::min(a.max.y, b.max.y) - std::max(a.min.y, b.min.y);
            const float height = std::min(a.max.y - a.min.y, b.max.y - b.min.y);
            if ((key == Key::down ? way.y : -way.y) <= 0 || overlap > 0.5f * height) continue;
            distance = upright + 2 * across + 0.01f * std::abs(way.x);
        }
        if (distance >= least) continue;
        least = distance;
        best = &stop;
    }
    return best;
}

// --- frames

void Focus::begin_frame() {
    added_.clear();
    added_counts_.clear();
    tab_is_kept_ = false;
    typing_ = false;
    panel_.clear();
    list_ = 0;
    if (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2)) visible_ = false;
    // Within the frame: the field is to see that it has lost the keys.
    if (std::exchange(ends_typing_, false)) ImGui::ClearActiveID();
    if (const ImGuiID id = std::exchange(activated_, 0)) activate_now(*ImGui::GetCurrentContext(), id);
}

void Focus::begin_list(ImGuiID list, int count) {
    list_ = list;
    list_count_ = count;
    row_ = 0;
    added_counts_.emplace_back(list, count);
}

std::optional<int> Focus::wanted_row() const {
    if (!wanted_ || wanted_->list != list_ || wanted_->row >= list_count_) return std::nullopt;
    return wanted_->row;
}

void Focus::add(const std::string& name, const Rect& rect, ImGuiID id, OwnKeys own, std::string_view label) {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (id == 0 || is_disabled(context.LastItemData)) return;
    Stop stop;
    stop.own = own;
    stop.level = context.BeginPopupStack.Size;
    add(std::move(stop), name, rect, id, label);
}

void Focus::add(Stop stop, const std::string& name, const Rect& rect, ImGuiID id, std::string_view label) {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    stop.name = name;
    stop.panel = panel_;
    if (label.empty()) label = std::string_view(name).substr(name.rfind('.') + 1);
    std::ranges::transform(label, std::back_inserter(stop.label), lower_letter);
    stop.rect = rect;
    const ImDrawList& draw = *ImGui::GetWindowDrawList();
    stop.clip = rect_of(draw.GetClipRectMin(), draw.GetClipRectMax());
    stop.id = id;
    stop.list = list_;
    stop.row = list_ != 0 ? row_ : 0;
    if (!added_.empty() && added_.back().list == stop.list && added_.back().row == stop.row && list_ != 0) {
        stop.column = added_.back().column + 1;
    }
    const bool wanted = wanted_ && list_ == wanted_->list && row_ == wanted_->row && stop.column <= wanted_->column;
    if (wanted && stop.level == level()) {
        at_.back() = arrived_ = name;
        visible_ = true;
        reveals_ = true;
    }
    const bool active = context.ActiveId == id;
    if (active && stop.level == level()) {
        if (is_typing()) {
            at_.back() = name;
            typing_ = true;
        } else if (ImGui::IsMouseClicked(0)) {
            at_.back() = name;  // Tab goes on from here
        }
    }
    if (reveals_ && visible_ && stop.level == level() && at_.back() == name) {
        ImGui::ScrollToRect(ImGui::GetCurrentWindow(), {{rect.min.x, rect.min.y}, {rect.max.x, rect.max.y}},
                            ImGuiScrollFlags_KeepVisibleEdgeY);
    }
    added_.push_back(std::move(stop));
}

void Focus::begin_here() {
    if (!added_.empty()) added_.back().begins = true;
}

void Focus::add_menu(const std::string& name, const Rect& rect, ImGuiID id, std::string_view label, bool open) {
    Stop stop;
    stop.own = OwnKeys::menu;
    stop.open = open;
    stop.level = ImGui::GetCurrentContext()->BeginPopupStack.Size - (open ? 1 : 0);
    if (id != 0) add(std::move(stop), name, rect, id, label);
}

std::vector<Chord> Focus::take(std::string_view name) {
    std::vector<Chord> out;
    std::erase_if(pressed_, [&](const auto& pressed) {
        if (pressed.first != name) return false;
        out.push_back(pressed.second);
        return true;
    });
    return out;
}

void Focus::end_frame(const Style& style) {
    std::swap(stops_, added_);
    std::swap(counts_, added_counts_);
    if (wanted_) {
        const Stop* stop = here();
        const bool there = stop && stop->list == wanted_->list && stop->row == wanted_->row;
        if (there || ++wanted_for_ > kFramesForRow) wanted_.reset();
    }
    follow_popups();
    follow_dialog();
    if (std::exchange(opening_, session_.workspace.document().opening) != session_.workspace.document().opening) {
        close_popups_from(0);
        at_ = {""};
        left_.clear();
        order_ = 0;
        visible_ = false;
    }
    const bool shown = (visible_ || typing_) && here();
    if (const Stop* stop = here(); stop && stop->level == 0) order_ = static_cast<std::size_t>(stop - stops_.data());
    session_.keys.focus = shown ? at_.back() : "";
    reveals_ = false;
    entered_.clear();
    arrived_.clear();
    menu_asked_.clear();
    picture_menu_asked_ = false;
    // A widget that is not drawn any more takes no keys.
    if (!shown) pressed_.clear();
    if (shown) draw_ring(style);
}

/// A popup that has opened takes the focus, and gives it back.
void Focus::follow_popups() {
    const auto open = static_cast<std::size_t>(ImGui::GetCurrentContext()->OpenPopupStack.Size);
    while (at_.size() > open + 1) at_.pop_back();
    while (at_.size() < open + 1) at_.emplace_back();
    if (open == 0 || here() || !visible_) return;
    if (const Stop* begin = where_popup_begins()) at_.back() = begin->name;
}

/// The row that is chosen, else the first one.
const Focus::Stop* Focus::where_popup_begins() const {
    const Stop* begin = nullptr;
    for (const Stop& stop : stops_) {
        if (reachable(stop) && (!begin || (stop.begins && !begin->begins))) begin = &stop;
    }
    return begin;
}

/// ... and so does a dialog.
void Focus::follow_dialog() {
    const Dialog before = std::exchange(dialog_, session_.dialogs.now);
    if (before == dialog_) return;
    if (before == Dialog::none) behind_dialog_ = {at_.front(), visible_};
    order_ = 0;
    std::tie(at_.front(), visible_) = dialog_ == Dialog::none ? behind_dialog_ : std::pair(std::string(), false);
}

void Focus::draw_ring(const Style& style) const {
    const Stop& stop = *here();
    const float out = std::floor(1.5f * style.scale);
    const float width = std::max(1.0f, std::round(2 * style.scale));
    const float rounding = 5 * style.scale;
    const ImVec2 min{stop.rect.min.x - out, stop.rect.min.y - out};
    const ImVec2 max{stop.rect.max.x + out, stop.rect.max.y + out};
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    // It may reach over the border of its panel, but not over what is scrolled away.
    draw.PushClipRect({stop.clip.min.x - 2 * out, stop.clip.min.y - out},
                      {stop.clip.max.x + 2 * out, stop.clip.max.y + out});
    if (stop.level > 0) {
        ImVec4 fill = ImGui::ColorConvertU32ToFloat4(style.accent);
        fill.w = 0.14f;
        draw.AddRectFilled(min, max, ImGui::ColorConvertFloat4ToU32(fill), rounding);
    }
    draw.AddRect(min, max, style.accent, rounding, 0, width);
    draw.PopClipRect();
}

}  // namespace mobbscope::app
