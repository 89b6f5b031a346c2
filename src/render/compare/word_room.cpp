#include <base/text.h>
#include <render/compare/word_room.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace mobbscope::compare {

namespace {

/// None if it is no point, or none of a picture.
std::optional<glm::vec2> point_of(const JsonValue& element, std::string_view key) {
    const auto* both = held<Elements>(element, key);
    if (!both || both->size() != 2) return std::nullopt;
    const auto* x = (*both)[0].as<double>();
    const auto* y = (*both)[1].as<double>();
    if (!x || !y || std::max(std::abs(*x), std::abs(*y)) > 1e9) return std::nullopt;
    return glm::vec2(*x, *y);
}

/// About what an element over the scene covers; none if it does not say.
std::optional<Rect> rect_of(const JsonValue& element) {
    const auto at = point_of(element, "at");
    const auto* text = held<std::string>(element, "text");
    const auto* size = held<double>(element, "size");
    if (at && text && size) {
        const auto letters =
            std::ranges::count_if(*text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; });
        const auto height = static_cast<float>(*size), width = 0.58f * static_cast<float>(letters) * height;
        return Rect{*at - glm::vec2(0, height), *at + glm::vec2(width, 0.25f * height)};
    }
    const bool is_line = point_of(element, "from").has_value();
    const auto a = point_of(element, is_line ? "from" : "min"), b = point_of(element, is_line ? "to" : "max");
    return a && b ? std::optional(Rect{glm::min(*a, *b), glm::max(*a, *b)}) : std::nullopt;
}

Rect grown(const Rect& rect, float x, float y) { return {rect.min - glm::vec2(x, y), rect.max + glm::vec2(x, y)}; }

bool is_label(const JsonValue& text) {
    const std::string role = text_in(text, "role");
    return role.empty() || role == "tick" || role == "name" || role == "note" || role == "label";
}

/// Whether they are the headline but for letters that are left out.
bool are_of_headline(const std::vector<std::string>& lines, const std::string& headline) {
    std::size_t at = 0;
    for (const std::string& line : lines) {
        for (const char c : line) {
            at = headline.find(c, at);
            if (at == std::string::npos) return false;
            ++at;
        }
    }
    return true;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string out;
    for (const std::string& line : lines) out += (out.empty() ? "" : " ") + line;
    return out;
}

}  // namespace

bool are_cut_alike(const std::string& a, const std::string& b) {
    constexpr std::string_view kCut = "\u2026";
    const auto parts = [&](std::string_view text) {
        const std::size_t at = text.find(kCut);
        return at == std::string::npos ? std::pair(text, text)
                                       : std::pair(text.substr(0, at), text.substr(at + kCut.size()));
    };
    const auto [head_a, tail_a] = parts(a);
    const auto [head_b, tail_b] = parts(b);
    if (head_a.size() == a.size() && head_b.size() == b.size()) return a == b;
    return (head_a.starts_with(head_b) || head_b.starts_with(head_a)) &&
           (tail_a.ends_with(tail_b) || tail_b.ends_with(tail_a));
}

bool is_caption(const JsonValue& text) { return text_in(text, "role") == "caption"; }

WordRoom::List::List(const JsonValue& list, std::set<std::string>& without_room) : headline(text_in(list, "headline")) {
    const auto each = [&](std::string_view key, const auto& call) {
        const auto* elements = held<Elements>(list, key);
        for (std::size_t i = 0; elements && i < elements->size(); ++i) call((*elements)[i], rect_of((*elements)[i]));
    };
    if (const auto size = point_of(list, "size")) picture = {{0, 0}, *size};
    each("texts", [&](const JsonValue& text, const std::optional<Rect>& rect) {
        const std::string words = text_in(text, "text");
        if (is_caption(text)) caption.push_back(words);
        roles = roles || held<std::string>(text, "role");
        if (rect) texts.push_back({words, is_label(text), *rect});
    });
    each("panels", [&](const JsonValue&, const std::optional<Rect>& rect) {
        if (rect) panels.push_back(*rect);
    });
    each("overlays", [&](const JsonValue& overlay, const std::optional<Rect>& rect) {
        const std::string name = text_in(overlay, "name");
        const auto* no_room = held<bool>(overlay, "no_room");
        if (no_room && *no_room) without_room.insert(name);
        if (rect) overlays.emplace_back(name, *rect);
        if (rect && name == "caption") caption_height = rect->size().y;
    });
}

WordRoom::WordRoom(const JsonValue& actual, const JsonValue& golden)
    : lists_{List(actual, without_room_), List(golden, without_room_)} {
    // A caption that breaks into more or fewer lines has a higher or lower panel.
    const auto& [a, g] = lists_;
    if (a.caption.size() != g.caption.size() && std::abs(a.caption_height - g.caption_height) > 8)
        without_room_.insert("caption");
}

std::optional<std::string> WordRoom::caption_words() const {
    const auto& [a, g] = lists_;
    const std::string here = joined(a.caption), there = joined(g.caption);
    if (without_room_.contains("caption") || are_cut_alike(here, there)) return std::nullopt;
    // An older list does not say which words are its caption.
    if (a.roles != g.roles) return std::nullopt;
    // A shorter headline of as many lines, and the same below it.
    if (a.caption.size() == g.caption.size()) {
        const auto [last_a, last_g] = std::mismatch(a.caption.rbegin(), a.caption.rend(), g.caption.rbegin());
        if (are_of_headline({a.caption.begin(), last_a.base()}, a.headline) &&
            are_of_headline({g.caption.begin(), last_g.base()}, g.headline))
            return std::nullopt;
    }
    return "caption: " + in_quotes(here) + " instead of " + in_quotes(there);
}

WordRoom::Excuse WordRoom::excuse(const ElementKind& kind, const JsonValue& element, Side side) const {
    if (kind.list == "overlays") return without_room_.contains(text_in(element, "name")) ? Excuse::all : Excuse::none;
    const bool is_line = kind.list == "overlay_lines";
    const auto rect = rect_of(element);
    if (!rect || !(kind.is_text() || is_line || kind.list == "panels" || kind.list == "marks")) return Excuse::none;
    const List& other = lists_[side == in_actual ? in_golden : in_actual];
    if (kind.is_text() && is_label(element))
        return is_crowded(other, {text_in(element, "text"), true, *rect}) ? Excuse::place : Excuse::none;
    if (is_in_panel(lists_[side], *rect)) return Excuse::all;
    const bool is_free = kind.is_text() ? is_caption(element) : is_beside_label(side, *rect, is_line);
    return is_free ? Excuse::place : Excuse::none;
}

/// Whether it is in a panel that has no room in one of the lists.
bool WordRoom::is_in_panel(const List& list, const Rect& rect) const {
    return std::ranges::any_of(list.overlays, [&](const auto& overlay) {
        return without_room_.contains(overlay.first) && overlay.second.grown(1).overlaps(rect);
    });
}

/// Whether it is the panel of a label that has no free place in the other list, or the line to it.
bool WordRoom::is_beside_label(Side side, const Rect& rect, bool is_line) const {
    return std::ranges::any_of(lists_[side].texts, [&](const Text& text) {
        const Rect& label = text.rect;
        const float width = label.size().x, height = label.size().y;
        const bool beside = is_line ? label.grown(height).overlaps(rect.grown(1))
                                    : grown(rect, 0.5f * width, 2).contains(label) && rect.size().y < 3 * height;
        return text.is_label && beside && is_crowded(lists_[side == in_actual ? in_golden : in_actual], text);
    });
}

/// Whether the label would be at something else, or at the picture's edge.
bool WordRoom::is_crowded(const List& list, const Text& label) {
    const float width = label.rect.size().x, height = label.rect.size().y;
    const Rect room = grown(label.rect, 0.5f * height + 0.1f * width, 0.5f * height);
    if (!list.picture.contains(room)) return true;
    const Text* itself = nullptr;  // elsewhere
    for (const Text& text : list.texts) {
        if (text.words == label.words) {
            itself = &text;
        } else if (text.rect.overlaps(room)) {
            return true;
        }
    }
    return std::ranges::any_of(list.panels, [&](const Rect& panel) {
        // A panel that is little larger is its own.
        const bool is_own = panel.contains(label.rect) && panel.size().y < 3 * height;
        return panel.overlaps(room) && !is_own && !(itself && itself->rect.overlaps(panel));
    });
}

}  // namespace mobbscope::compare
