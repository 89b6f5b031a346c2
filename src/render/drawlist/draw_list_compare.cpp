#include <base/json.h>
#include <base/text.h>
#include <render/drawlist/draw_list_compare.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <variant>

namespace mobbscope {

namespace {

constexpr double kNear = 1e-4;
constexpr double kNearPixels = 0.01;
constexpr double kFewPixels = 16;
constexpr double kOtherFontPixels = 12;
constexpr double kOtherFontShare = 0.04;   // of the picture's longer side
constexpr std::size_t kMostCompared = 16;  // elements that one is held against where nothing names its like
constexpr std::size_t kMostShown = 60;     // characters of a value in a message

using Elements = JsonValue::Array;
using Members = JsonValue::Object;

// --- values

/// `hint`: where it is likely to be, and then where the next one is.
const JsonValue* member_of(const Members& object, std::string_view key, std::size_t& hint) {
    for (std::size_t i = 0; i < object.size(); ++i) {
        const std::size_t at = (hint + i) % object.size();
        if (object[at].key != key) continue;
        hint = at + 1;
        return &object[at].value;
    }
    return nullptr;
}

const JsonValue* member_of(const JsonValue& value, std::string_view key) {
    const auto* object = std::get_if<Members>(&value.data);
    std::size_t hint = 0;
    return object ? member_of(*object, key, hint) : nullptr;
}

template <class Held>
const Held* held(const JsonValue& value, std::string_view key) {
    const JsonValue* found = member_of(value, key);
    return found ? std::get_if<Held>(&found->data) : nullptr;
}

bool is_container(const JsonValue& value) {
    return std::holds_alternative<Elements>(value.data) || std::holds_alternative<Members>(value.data);
}

/// Adds a value on one line, or the beginning of a long one.
void add_shown(std::string& out, const JsonValue& value) {
    if (out.size() > kMostShown) return;
    if (const auto* number = std::get_if<double>(&value.data)) {
        out += brief(*number);
    } else if (const auto* text = std::get_if<std::string>(&value.data)) {
        out += in_quotes(*text);
    } else if (const auto* boolean = std::get_if<bool>(&value.data)) {
        out += *boolean ? "true" : "false";
    } else if (const auto* array = std::get_if<Elements>(&value.data)) {
        out += '[';
        for (std::size_t i = 0; i < array->size() && out.size() <= kMostShown; ++i) {
            out += i > 0 ? ", " : "";
            add_shown(out, (*array)[i]);
        }
        out += ']';
    } else if (const auto* object = std::get_if<Members>(&value.data)) {
        out += '{';
        for (std::size_t i = 0; i < object->size() && out.size() <= kMostShown; ++i) {
            out += (i > 0 ? ", " : "") + cleaned((*object)[i].key) + ": ";
            add_shown(out, (*object)[i].value);
        }
        out += '}';
    } else {
        out += "null";
    }
}

/// A value, or none, for a message.
std::string shown(const JsonValue* value) {
    if (!value) return "nothing";
    std::string out;
    add_shown(out, *value);
    return is_container(*value) ? shortened(out, kMostShown) : out;
}

bool agree(double a, double b, double bound) {
    return std::abs(a - b) <= std::max(bound, kNear * std::max({1.0, std::abs(a), std::abs(b)}));
}

/// The first that differ of what two values hold; either may be none.
struct Unlike {
    const JsonValue* actual = nullptr;
    const JsonValue* golden = nullptr;
    explicit operator bool() const { return actual || golden; }
    std::string words() const { return shown(actual) + " instead of " + shown(golden); }
};

/// `bound`: how far numbers may be apart beyond what always agrees.
Unlike first_unlike(const JsonValue& actual, const JsonValue& golden, double bound = 0) {
    const Unlike whole{&actual, &golden};
    if (actual.data.index() != golden.data.index()) return whole;
    if (const auto* number = std::get_if<double>(&golden.data))
        return agree(std::get<double>(actual.data), *number, bound) ? Unlike{} : whole;
    if (const auto* text = std::get_if<std::string>(&golden.data))
        return std::get<std::string>(actual.data) == *text ? Unlike{} : whole;
    if (const auto* boolean = std::get_if<bool>(&golden.data))
        return std::get<bool>(actual.data) == *boolean ? Unlike{} : whole;
    if (const auto* elements = std::get_if<Elements>(&golden.data)) {
        const auto& others = std::get<Elements>(actual.data);
        if (others.size() != elements->size()) return whole;
        for (std::size_t i = 0; i < others.size(); ++i) {
            if (const Unlike found = first_unlike(others[i], (*elements)[i], bound)) return found;
        }
    } else if (const auto* members = std::get_if<Members>(&golden.data)) {
        const auto& others = std::get<Members>(actual.data);
        if (others.size() != members->size()) return whole;
        std::size_t hint = 0;
        for (const JsonMember& member : *members) {
            const JsonValue* other = member_of(others, member.key, hint);
            if (!other) return whole;
            if (const Unlike found = first_unlike(*other, member.value, bound)) return found;
        }
    }
    return {};
}

/// How far apart numbers of two values are, all together.
double distance(const JsonValue& a, const JsonValue& b) {
    if (a.data.index() != b.data.index()) return 0;
    if (const auto* number = std::get_if<double>(&a.data)) return std::abs(*number - std::get<double>(b.data));
    double out = 0;
    if (const auto* elements = std::get_if<Elements>(&a.data)) {
        const auto& others = std::get<Elements>(b.data);
        for (std::size_t i = 0; i < std::min(elements->size(), others.size()); ++i) {
            out += distance((*elements)[i], others[i]);
        }
    }
    return out;
}

// --- elements of a draw list

/// How much of two elements has to agree for them to be the same one.
enum class Agreeing { any, half, all_but_one, all };

/// What elements of a list are, and how they are compared.
struct ElementKind {
    std::string_view list;                    ///< key of the list; empty: of any other array
    std::string_view element;                 ///< for messages
    std::array<std::string_view, 2> name{};   ///< members that tell what an element stands for
    bool renamed = false;                     ///< one whose name alone is other is the same one
    bool in_order = true;                     ///< their order is seen
    std::array<std::string_view, 2> loose{};  ///< members that follow from the width of words
};
constexpr std::array<ElementKind, 9> kElementKinds{
    {{"disks", "disk", {"participant", "sample"}, false, false, {}},
     {"boxes", "box", {"participant", "node"}, false, false, {}},
     {"lines", "line", {}, false, false, {}},
     {"highlights", "highlight", {}, false, true, {}},
     {"legend", "row", {"text"}, true, true, {}},
     {"overlays", "panel", {"name"}, false, true, {"min", "max"}},
     {"panels", "panel", {}, false, true, {"min", "max"}},
     {"overlay_lines", "line over the scene", {}, false, true, {"from", "to"}},
     {"marks", "mark", {}, false, true, {"min", "max"}}}};
constexpr ElementKind kTexts{"texts", "text", {"role", "text"}, true, true, {"at"}};
constexpr ElementKind kParticipants{"participants", "participant", {}, false, true, {}};
constexpr ElementKind kAnyElements{};

const ElementKind* kind_of(std::string_view list) {
    if (list == kTexts.list) return &kTexts;
    if (list == kParticipants.list) return &kParticipants;
    const auto found = std::ranges::find(kElementKinds, list, &ElementKind::list);
    return found == kElementKinds.end() ? nullptr : &*found;
}

bool is_draw_list(const JsonValue& value) {
    const auto* object = std::get_if<Members>(&value.data);
    return object && std::ranges::any_of(*object, [](const JsonMember& member) {
               return kind_of(member.key) && std::holds_alternative<Elements>(member.value.data);
           });
}

/// How elements of one list are compared.
struct ElementTerms {
    const ElementKind* kind = &kAnyElements;
    bool other_fonts = false;
    double bound = 0;   ///< of loose members, pixels
    bool roles = true;  ///< all texts have a role

    bool is_object() const { return kind->name[0] == "participant"; }
    /// Whether a member tells which elements belong together, or what is other in one.
    bool counts(std::string_view key) const {
        if (is_object()) return key != "id" && key != "pixels";
        if (kind != &kTexts) return true;
        return key == "role" ? roles : key != "on_screen" || !other_fonts;
    }
    double bound_of(std::string_view key) const {
        return other_fonts && std::ranges::find(kind->loose, key) != kind->loose.end() ? bound : 0;
    }
};

/// How like two elements are.
struct Likeness {
    std::size_t members = 0;
    std::size_t agreeing = 0;
    double apart = 0;

    bool enough(Agreeing least) const {
        switch (least) {
            case Agreeing::any:
                return true;
            case Agreeing::half:
                return 2 * agreeing >= members;
            case Agreeing::all_but_one:
                return agreeing + 1 >= members;
            case Agreeing::all:
                return agreeing == members;
        }
        return false;
    }
    bool operator>(const Likeness& other) const {
        return agreeing > other.agreeing || (agreeing == other.agreeing && apart < other.apart);
    }
};

Likeness likeness(const JsonValue& actual, const JsonValue& golden, const ElementTerms& terms) {
    Likeness out;
    const auto add = [&](const JsonValue& a, const JsonValue& g, double bound) {
        out.apart += distance(a, g);
        if (!first_unlike(a, g, bound)) ++out.agreeing;
    };
    const auto* members = std::get_if<Members>(&golden.data);
    const auto* others = std::get_if<Members>(&actual.data);
    const auto* elements = std::get_if<Elements>(&golden.data);
    const auto* other_elements = std::get_if<Elements>(&actual.data);
    if (members && others) {
        std::size_t hint = 0, both = 0;
        for (const JsonMember& member : *members) {
            if (!terms.counts(member.key)) continue;
            ++out.members;
            const JsonValue* other = member_of(*others, member.key, hint);
            if (other) ++both;
            if (other) add(*other, member.value, terms.bound_of(member.key));
        }
        out.members += static_cast<std::size_t>(std::ranges::count_if(
                           *others, [&](const JsonMember& member) { return terms.counts(member.key); })) -
                       both;
    } else if (elements && other_elements) {
        out.members = std::max(elements->size(), other_elements->size());
        for (std::size_t i = 0; i < std::min(elements->size(), other_elements->size()); ++i) {
            add((*other_elements)[i], (*elements)[i], 0);
        }
    } else {
        out.members = 1;
        add(actual, golden, 0);
    }
    return out;
}

/// What an element is, as bytes that are equal where all that counts is. `rounded`: to three figures or so, so that
/// what differs in its last one is equal too, most often.
class Fingerprint {
  public:
    Fingerprint(const ElementTerms& terms, bool rounded) : terms_(terms), rounded_(rounded) {}

    std::string of(const JsonValue& element) {
        out_.clear();
        if (const auto* members = std::get_if<Members>(&element.data)) {
            for (const JsonMember& member : *members) {
                if (terms_.counts(member.key)) add(member);
            }
        } else {
            add(element);
        }
        return out_;
    }

  private:
    void add(const JsonMember& member) {
        add(member.key);
        add(member.value);
    }
    void add(const std::string& text) { (out_ += text) += '\0'; }
    void add(double number) {
        if (rounded_) {
            int power = 0;
            const double part = std::frexp(number, &power);
            number =
                std::abs(number) < 1 ? std::round(1000 * number) / 1000 : std::ldexp(std::round(2048 * part), power);
        }
        number += 0.0;  // without the sign of zero
        std::array<char, sizeof number> bytes;
        std::memcpy(bytes.data(), &number, sizeof number);
        out_.append(bytes.data(), bytes.size());
    }
    void add(const JsonValue& value) {
        out_ += static_cast<char>('0' + value.data.index());
        if (const auto* number = std::get_if<double>(&value.data)) add(*number);
        if (const auto* text = std::get_if<std::string>(&value.data)) add(*text);
        if (const auto* boolean = std::get_if<bool>(&value.data)) out_ += *boolean ? '1' : '0';
        if (const auto* elements = std::get_if<Elements>(&value.data)) {
            for (const JsonValue& element : *elements) add(element);
            out_ += ']';
        }
        if (const auto* members = std::get_if<Members>(&value.data)) {
            for (const JsonMember& member : *members) add(member);
            out_ += '}';
        }
    }

    const ElementTerms& terms_;
    bool rounded_;
    std::string out_;
};

/// An array, and what each of its elements stands for; empty: nothing by itself.
struct NamedElements {
    const Elements& elements;
    std::vector<std::string> names;
};

/// Which elements of two arrays belong together, as places in the golden and the actual one; each in order.
class Alignment {
  public:
    Alignment(const NamedElements& actual, const NamedElements& golden, const ElementTerms& terms)
        : actual_(actual),
          golden_(golden),
          terms_(terms),
          of_golden_(golden.elements.size()),
          of_actual_(actual.elements.size()) {
        for (std::size_t i = 0; i < golden.elements.size(); ++i) missing.push_back(i);
        for (std::size_t i = 0; i < actual.elements.size(); ++i) added.push_back(i);
        pair_equal(false);
        pair_equal(true);
        for (const Agreeing named : {Agreeing::all, Agreeing::any}) {
            const Agreeing unnamed = named == Agreeing::all ? Agreeing::all : Agreeing::half;
            pair_beside(named, unnamed);
            pair_groups(named, unnamed);
        }
        pair_rest();
        for (std::size_t i = 0; i < of_golden_.size(); ++i) {
            if (of_golden_[i]) pairs.emplace_back(i, *of_golden_[i]);
        }
    }

    std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< golden, actual
    std::vector<std::size_t> missing, added;

  private:
    using Places = std::vector<std::size_t>;

    void pair(std::size_t golden, std::size_t actual) {
        of_golden_[golden] = actual;
        of_actual_[actual] = golden;
    }
    void drop_paired() {
        std::erase_if(missing, [&](std::size_t i) { return of_golden_[i].has_value(); });
        std::erase_if(added, [&](std::size_t i) { return of_actual_[i].has_value(); });
    }
    bool nothing_to_pair() const { return missing.empty() || added.empty(); }
    Likeness likeness_of(std::size_t golden, std::size_t actual) const {
        return likeness(actual_.elements[actual], golden_.elements[golden], terms_);
    }

    /// Those with the same name of which all is equal, the first with the first.
    void pair_equal(bool rounded) {
        if (nothing_to_pair()) return;
        Fingerprint print(terms_, rounded);
        std::unordered_map<std::string, std::pair<Places, std::size_t>> open;
        for (const std::size_t i : missing) {
            open[golden_.names[i] + print.of(golden_.elements[i])].first.push_back(i);
        }
        for (const std::size_t i : added) {
            const auto found = open.find(actual_.names[i] + print.of(actual_.elements[i]));
            if (found == open.end()) continue;
            auto& [places, next] = found->second;
            if (next < places.size()) pair(places[next++], i);
        }
        drop_paired();
    }

    /// Those with the same name that come after, or before, the same one.
    void pair_beside(Agreeing named, Agreeing unnamed) {
        if (nothing_to_pair()) return;
        const auto try_pair = [&](std::size_t golden, std::size_t actual) {
            if (of_golden_[golden] || of_actual_[actual] || golden_.names[golden] != actual_.names[actual]) return;
            const Agreeing least = golden_.names[golden].empty() ? unnamed : named;
            if (likeness_of(golden, actual).enough(least)) pair(golden, actual);
        };
        for (const std::size_t i : added) {
            const auto before = i > 0 ? of_actual_[i - 1] : std::nullopt;
            const std::size_t golden = before ? *before + 1 : 0;
            if ((i == 0 || before) && golden < of_golden_.size()) try_pair(golden, i);
        }
        for (auto i = added.rbegin(); i != added.rend(); ++i) {
            const bool last = *i + 1 == of_actual_.size();
            const auto after = last ? std::optional(of_golden_.size()) : of_actual_[*i + 1];
            if (after && *after > 0) try_pair(*after - 1, *i);
        }
        drop_paired();
    }

    /// Those with the same name that are the most alike.
    void pair_groups(Agreeing named, Agreeing unnamed) {
        if (nothing_to_pair()) return;
        std::unordered_map<std::string, std::size_t> numbers;
        std::vector<std::pair<Places, Places>> groups;
        const auto group = [&](const std::string& name) -> std::pair<Places, Places>& {
            const auto [found, is_new] = numbers.try_emplace(name, groups.size());
            if (is_new) groups.emplace_back();
            return groups[found->second];
        };
        for (const std::size_t i : missing) group(golden_.names[i]).first.push_back(i);
        for (const std::size_t i : added) group(actual_.names[i]).second.push_back(i);
        const auto nameless = numbers.find("");
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const bool is_nameless = nameless != numbers.end() && nameless->second == g;
            pair_near(groups[g].first, groups[g].second, is_nameless ? unnamed : named);
        }
        drop_paired();
    }

    /// Whose names differ.
    void pair_rest() {
        if (terms_.kind->renamed) pair_near(missing, added, Agreeing::all_but_one);
        drop_paired();
        if (terms_.kind != &kAnyElements || missing.size() != added.size()) return;
        // A value that has no parts is like nothing but itself.
        for (std::size_t i = 0; i < missing.size(); ++i) pair(missing[i], added[i]);
        drop_paired();
    }

    /// Each with the most alike of those about where the last one was found.
    void pair_near(const Places& golden, const Places& actual, Agreeing least) {
        std::size_t next = 0;  // in `actual`
        for (std::size_t i = 0; i < golden.size(); ++i) {
            while (next < actual.size() && of_actual_[actual[next]]) ++next;
            std::optional<std::pair<Likeness, std::size_t>> best;
            std::size_t at = next - std::min(next, kMostCompared / 4);
            for (const std::size_t end = std::min(actual.size(), next + kMostCompared); at < end; ++at) {
                if (of_actual_[actual[at]]) continue;
                const Likeness like = likeness_of(golden[i], actual[at]);
                if (like.enough(least) && (!best || like > best->first)) best.emplace(like, at);
            }
            if (best) {
                pair(golden[i], actual[best->second]);
                next = std::max(next, best->second + 1);
            } else if (actual.size() - next >= golden.size() - i) {
                ++next;
            }
        }
    }

    const NamedElements& actual_;
    const NamedElements& golden_;
    const ElementTerms& terms_;
    std::vector<std::optional<std::size_t>> of_golden_, of_actual_;
};

// --- names

/// "(1, 0.5, 0)", or nothing.
std::string point_words(const JsonValue& element, std::string_view before, std::string_view key) {
    const auto* point = held<Elements>(element, key);
    if (!point) return "";
    std::string out;
    for (const JsonValue& number : *point) out += (out.empty() ? "" : ", ") + shown(&number);
    return std::string(before) + '(' + shortened(out, kMostShown) + ')';
}

/// " of the time cursor": what a line of that layer (DrawLayer) belongs to.
std::string layer_words(const JsonValue& element) {
    static const std::map<double, std::string_view> kLayers{{0, "surroundings"}, {1, "nodes"},       {2, "subject"},
                                                            {6, "candidates"},   {8, "time cursor"}, {9, "findings"},
                                                            {10, "rings"}};
    const auto* layer = held<double>(element, "layer");
    const auto found = layer ? kLayers.find(*layer) : kLayers.end();
    return found == kLayers.end() ? "" : " of the " + std::string(found->second);
}

std::string role_words(const JsonValue& text, const std::string& quoted) {
    static const std::map<std::string, std::pair<std::string_view, std::string_view>, std::less<>> kRoles{
        {"label", {"label ", ""}},
        {"tick", {"tick label ", ""}},
        {"name", {"name ", ""}},
        {"note", {"note ", ""}},
        {"caption", {"line ", " of the caption"}},
        {"legend", {"row ", " of the legend"}},
        {"header", {"header ", ""}},
        {"map", {"title ", " of the map"}}};
    const auto* role = held<std::string>(text, "role");
    const auto found = role ? kRoles.find(*role) : kRoles.end();
    if (found == kRoles.end()) return "text " + quoted;
    return std::string(found->second.first) + quoted + std::string(found->second.second);
}

/// The name of whom an element is of; none if there is none.
std::optional<std::string> participant_of(const JsonValue& element, const JsonValue& list) {
    const auto* index = held<double>(element, "participant");
    const auto* names = held<Elements>(list, "participants");
    if (!index || !names || !(*index >= 0) || *index >= static_cast<double>(names->size())) return std::nullopt;
    const auto* name = std::get_if<std::string>(&(*names)[static_cast<std::size_t>(*index)].data);
    return name ? std::optional(*name) : std::nullopt;
}

/// "box of A, node 3", "tick label '20 s'", "line 4 of the rings from (0, 0) to (1, 0)".
std::string element_words(const ElementKind& kind, const JsonValue& element, std::size_t index, const JsonValue& list) {
    const std::string numbered = std::string(kind.element) + ' ' + std::to_string(index + 1);
    if (&kind == &kParticipants) return "participant " + shown(&element);
    if (&kind == &kTexts) {
        const auto* text = held<std::string>(element, "text");
        return text ? role_words(element, in_quotes(*text)) : numbered;
    }
    if (kind.list == "legend") {
        const auto* text = held<std::string>(element, "text");
        return (text ? "row " + in_quotes(*text) : numbered) + " of the legend";
    }
    if (kind.list == "overlays") {
        const auto* name = held<std::string>(element, "name");
        return name ? "panel of the " + (*name == "inset" ? "map" : cleaned(*name)) : numbered;
    }
    if (kind.name[0] == "participant") {
        const auto who = participant_of(element, list);
        const auto* number = held<double>(element, kind.name[1]);
        if (who && number)
            return std::string(kind.element) + " of " + cleaned(*who) + ", " + std::string(kind.name[1]) + ' ' +
                   short_double(*number);
        const auto* state = held<std::string>(element, "state");
        return numbered + (state ? " (" + cleaned(*state) + ')' : "");
    }
    if (kind.list == "highlights") {
        const auto* role = held<std::string>(element, "role");
        return numbered + (role ? " (" + cleaned(*role) + ')' : "");
    }
    return numbered + layer_words(element) + point_words(element, " from ", "from") +
           point_words(element, " to ", "to") + point_words(element, " at ", "min");
}

/// What tells elements apart, as bytes.
std::string key_of(const ElementTerms& terms, const JsonValue& element, const JsonValue& list) {
    if (terms.kind == &kParticipants) {
        const auto* name = std::get_if<std::string>(&element.data);
        return name ? *name + '\0' : "";
    }
    std::string out;
    for (const std::string_view key : terms.kind->name) {
        if (key.empty() || !terms.counts(key)) continue;
        const JsonValue* value = member_of(element, key);
        // What stands for nothing has no name.
        if (!value || std::holds_alternative<std::nullptr_t>(value->data)) return "";
        const auto who = key == "participant" ? participant_of(element, list) : std::nullopt;
        // Participants count anew where one is missing.
        const auto* text = std::get_if<std::string>(&value->data);
        const auto* number = std::get_if<double>(&value->data);
        out += (who ? *who : text ? *text : number ? short_double(*number) : shown(value)) + '\0';
    }
    return out;
}

// --- other fonts

struct PixelRect {
    double left = 0, top = 0, right = 0, bottom = 0;

    bool overlaps(const PixelRect& o) const {
        return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
    }
    bool contains(const PixelRect& o) const {
        return left <= o.left && top <= o.top && right >= o.right && bottom >= o.bottom;
    }
    PixelRect grown(double x, double y) const { return {left - x, top - y, right + x, bottom + y}; }
};

/// About what an element over the scene covers; none if it does not say.
std::optional<PixelRect> rect_of(const JsonValue& element) {
    const auto point = [&](std::string_view key) -> std::optional<std::pair<double, double>> {
        const auto* both = held<Elements>(element, key);
        if (!both || both->size() != 2) return std::nullopt;
        const auto* x = std::get_if<double>(&(*both)[0].data);
        const auto* y = std::get_if<double>(&(*both)[1].data);
        return x && y ? std::optional(std::pair(*x, *y)) : std::nullopt;
    };
    const auto* text = held<std::string>(element, "text");
    const auto* size = held<double>(element, "size");
    if (const auto at = point("at"); at && text && size) {
        const auto letters = static_cast<double>(
            std::ranges::count_if(*text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
        return PixelRect{at->first, at->second - *size, at->first + 0.58 * letters * *size, at->second + 0.25 * *size};
    }
    const bool is_line = point("from").has_value();
    const auto low = point(is_line ? "from" : "min"), high = point(is_line ? "to" : "max");
    if (!low || !high) return std::nullopt;
    return PixelRect{std::min(low->first, high->first), std::min(low->second, high->second),
                     std::max(low->first, high->first), std::max(low->second, high->second)};
}

/// Whether two texts may be one that is cut by other widths: "a long na\u2026" and "a long n\u2026".
bool are_cut_alike(const std::string& a, const std::string& b) {
    constexpr std::string_view kCut = "\u2026";
    const std::size_t in_a = a.find(kCut), in_b = b.find(kCut);
    if (in_a == std::string::npos && in_b == std::string::npos) return a == b;
    const auto parts = [&](const std::string& text, std::size_t at) {
        const std::string_view all = text;
        return at == std::string::npos ? std::pair(all, all)
                                       : std::pair(all.substr(0, at), all.substr(at + kCut.size()));
    };
    const auto [head_a, tail_a] = parts(a, in_a);
    const auto [head_b, tail_b] = parts(b, in_b);
    return (head_a.starts_with(head_b) || head_b.starts_with(head_a)) &&
           (tail_a.ends_with(tail_b) || tail_b.ends_with(tail_a));
}

/// What wider or narrower words decide: whether a panel has room, how a caption's lines break, and whether a label
/// finds a free place. It excuses that these are in one list alone, or elsewhere, where the other list has no room.
class WordRoom {
  public:
    WordRoom(const JsonValue& actual, const JsonValue& golden) : lists_{&actual, &golden} {
        for (std::size_t side = 0; side < 2; ++side) {
            each(side, "overlays", [&](const JsonValue& overlay) {
                const auto* name = held<std::string>(overlay, "name");
                const auto* no_room = held<bool>(overlay, "no_room");
                if (name && no_room && *no_room) without_room_.insert(*name);
            });
        }
        add_caption(0);
        add_caption(1);
        // A caption that breaks into more or fewer lines has a higher or lower panel.
        if (lines_[0].size() != lines_[1].size() && std::abs(caption_height(0) - caption_height(1)) > 8)
            without_room_.insert("caption");
    }

    /// Of the words of both captions, if they may not be the same ones.
    std::optional<std::string> caption_words() const {
        const std::string actual = joined(lines_[0]), golden = joined(lines_[1]);
        if (has_no_room("caption") || are_cut_alike(actual, golden)) return std::nullopt;
        // A shorter headline of as many lines, and the same below it.
        const auto [here, there] =
            std::mismatch(lines_[0].rbegin(), lines_[0].rend(), lines_[1].rbegin(), lines_[1].rend());
        const auto rest_here = lines_[0].rend() - here, rest_there = lines_[1].rend() - there;
        if (rest_here > 0 && rest_here == rest_there && are_of_headline(0, rest_here) && are_of_headline(1, rest_there))
            return std::nullopt;
        return "caption: " + in_quotes(actual) + " instead of " + in_quotes(golden);
    }

    /// Where it may be elsewhere or missing; or whatever it is.
    enum class Excuse { none, place, all };

    /// Of an element of one list (0: actual, 1: golden) that the other one has not, or not there.
    Excuse excuse(const ElementKind& kind, const JsonValue& element, std::size_t side) const {
        if (kind.list == "overlays") {
            const auto* name = held<std::string>(element, "name");
            return name && has_no_room(*name) ? Excuse::all : Excuse::none;
        }
        const auto rect = rect_of(element);
        if (!rect) return Excuse::none;
        if (&kind == &kTexts) {
            if (is_label(element)) return is_crowded(1 - side, *rect, element) ? Excuse::place : Excuse::none;
            if (is_in_panel(side, *rect)) return Excuse::all;
            return is_caption(element) ? Excuse::place : Excuse::none;
        }
        if (kind.list != "panels" && kind.list != "marks" && kind.list != "overlay_lines") return Excuse::none;
        if (is_in_panel(side, *rect)) return Excuse::all;
        return is_beside_label(side, *rect, kind.list == "overlay_lines") ? Excuse::place : Excuse::none;
    }

    /// Whose words are compared with all of the caption.
    static bool is_caption(const JsonValue& text) {
        const auto* role = held<std::string>(text, "role");
        return role && *role == "caption";
    }

  private:
    template <class Call>
    void each(std::size_t side, std::string_view key, const Call& call) const {
        const auto* elements = held<Elements>(*lists_[side], key);
        if (!elements) return;
        for (const JsonValue& element : *elements) call(element);
    }

    bool has_no_room(const std::string& name) const { return without_room_.contains(name); }

    static bool is_label(const JsonValue& text) {
        const auto* role = held<std::string>(text, "role");
        return !role || *role == "tick" || *role == "name" || *role == "note" || *role == "label";
    }

    void add_caption(std::size_t side) {
        each(side, "texts", [&](const JsonValue& text) {
            const auto* words = held<std::string>(text, "text");
            if (words && is_caption(text)) lines_[side].push_back(*words);
        });
    }

    double caption_height(std::size_t side) const {
        double out = 0;
        each(side, "overlays", [&](const JsonValue& overlay) {
            const auto* name = held<std::string>(overlay, "name");
            const auto rect = rect_of(overlay);
            if (name && rect && *name == "caption") out = rect->bottom - rect->top;
        });
        return out;
    }

    /// Whether the first lines do nothing but leave letters of the headline out.
    bool are_of_headline(std::size_t side, std::ptrdiff_t count) const {
        const auto* headline = held<std::string>(*lists_[side], "headline");
        if (!headline) return false;
        std::size_t at = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            for (const char c : lines_[side][i]) {
                at = headline->find(c, at);
                if (at == std::string::npos) return false;
                ++at;
            }
        }
        return true;
    }

    static std::string joined(const std::vector<std::string>& lines) {
        std::string out;
        for (const std::string& line : lines) out += (out.empty() ? "" : " ") + line;
        return out;
    }

    /// Whether it is in a panel that has no room in one of the lists.
    bool is_in_panel(std::size_t side, const PixelRect& rect) const {
        bool out = false;
        each(side, "overlays", [&](const JsonValue& overlay) {
            const auto* name = held<std::string>(overlay, "name");
            const auto panel = rect_of(overlay);
            out = out || (name && panel && has_no_room(*name) && panel->grown(1, 1).overlaps(rect));
        });
        return out;
    }

    /// Whether the label would be at something else, or at the picture's edge.
    bool is_crowded(std::size_t side, const PixelRect& label, const JsonValue& text) const {
        const double height = label.bottom - label.top;
        const PixelRect room = label.grown(0.5 * height + 0.1 * (label.right - label.left), 0.5 * height);
        PixelRect picture;
        if (const auto* size = held<Elements>(*lists_[side], "size"); size && size->size() == 2) {
            const auto* width = std::get_if<double>(&(*size)[0].data);
            const auto* high = std::get_if<double>(&(*size)[1].data);
            if (width && high) picture = {0, 0, *width, *high};
        }
        if (!picture.contains(room)) return true;
        const auto* words = held<std::string>(text, "text");
        bool out = false;
        std::optional<PixelRect> itself;  // elsewhere
        each(side, "texts", [&](const JsonValue& other) {
            const auto* others = held<std::string>(other, "text");
            const auto rect = rect_of(other);
            if (!rect) return;
            if (words && others && *words == *others) {
                itself = rect;
            } else {
                out = out || rect->overlaps(room);
            }
        });
        each(side, "panels", [&](const JsonValue& panel) {
            const auto rect = rect_of(panel);
            // A panel that is little larger is its own.
            if (!rect || (rect->contains(label) && rect->bottom - rect->top < 3 * height)) return;
            out = out || (rect->overlaps(room) && !(itself && rect->overlaps(*itself)));
        });
        return out;
    }

    /// Whether it is the panel of such a label, or the line to it.
    bool is_beside_label(std::size_t side, const PixelRect& rect, bool is_line) const {
        bool out = false;
        each(side, "texts", [&](const JsonValue& text) {
            if (out || !is_label(text)) return;
            const auto label = rect_of(text);
            if (!label) return;
            const double height = label->bottom - label->top;
            const bool beside = is_line ? label->grown(height, height).overlaps(rect.grown(1, 1))
                                        : rect.grown(0.5 * (label->right - label->left), 2).contains(*label) &&
                                              rect.bottom - rect.top < 3 * height;
            out = beside && is_crowded(1 - side, *label, text);
        });
        return out;
    }

    std::array<const JsonValue*, 2> lists_;
    std::array<std::vector<std::string>, 2> lines_;  ///< of captions
    std::set<std::string> without_room_;
};

// --- comparing

/// The first lines of many.
class Lines {
  public:
    explicit Lines(std::size_t most) : most_(most) {}
    void add(std::string line) {
        if (count_++ < most_) first_.push_back(std::move(line));
    }
    void add(Lines more) {
        const std::size_t untold = more.count_ - more.first_.size();
        for (std::string& line : more.first_) add(std::move(line));
        count_ += untold;
    }
    bool empty() const { return count_ == 0; }
    std::size_t count() const { return count_; }
    std::vector<std::string> told() && {
        if (count_ > first_.size()) first_.push_back("and " + std::to_string(count_ - first_.size()) + " more");
        return std::move(first_);
    }

  private:
    std::size_t most_;
    std::size_t count_ = 0;
    std::vector<std::string> first_;
};

/// Of one list: its elements, and which belong together.
struct ComparedList {
    ComparedList(const ElementTerms& how, NamedElements a, NamedElements g)
        : terms(how), actual(std::move(a)), golden(std::move(g)), alignment(actual, golden, terms) {}
    ComparedList(const ComparedList&) = delete;
    ComparedList& operator=(const ComparedList&) = delete;

    bool all_there() const { return alignment.missing.empty() && alignment.added.empty(); }

    ElementTerms terms;
    NamedElements actual, golden;
    Alignment alignment;
};

/// Where an element of the golden comes before another one that it comes after in the actual list.
std::optional<std::pair<std::size_t, std::size_t>> out_of_order(const Alignment& alignment) {
    for (std::size_t i = 0; i + 1 < alignment.pairs.size(); ++i) {
        if (alignment.pairs[i].second > alignment.pairs[i + 1].second)
            return std::pair(alignment.pairs[i].first, alignment.pairs[i + 1].first);
    }
    return std::nullopt;
}

/// "extents: 1.02 instead of 1 (also center, fill)".
class MemberWords {
  public:
    void add(std::string_view key, const Unlike& unlike) {
        if (first_.empty()) {
            first_ = cleaned(key) + ": " + unlike.words();
        } else {
            also_ += (also_.empty() ? "" : ", ") + cleaned(key);
        }
    }
    bool empty() const { return first_.empty(); }
    std::string words() const { return first_ + (also_.empty() ? "" : " (also " + also_ + ')'); }

  private:
    std::string first_, also_;
};

/// Calls with the key and both values, in the golden's order and then the actual one's; null where one has none.
template <class Call>
void each_member(const Members& actual, const Members& golden, const Call& call) {
    std::size_t hint = 0;
    for (const JsonMember& member : golden) call(member.key, member_of(actual, member.key, hint), &member.value);
    hint = 0;
    for (const JsonMember& member : actual) {
        if (!member_of(golden, member.key, hint)) call(member.key, &member.value, nullptr);
    }
}

class DrawListComparer {
  public:
    explicit DrawListComparer(const DrawListTerms& terms)
        : terms_(terms), gone_(terms.most), other_(terms.most), follows_(terms.most), pixels_(terms.most) {}

    void compare(const JsonValue& actual, const JsonValue& golden) {
        if (is_draw_list(golden) && is_draw_list(actual)) return compare_lists("", actual, golden);
        const auto* pictures = std::get_if<Elements>(&actual.data);
        const auto* others = std::get_if<Elements>(&golden.data);
        if (!pictures || !others || !std::ranges::any_of(*others, is_draw_list))
            return compare_values("", actual, golden);
        for (std::size_t i = 0; i < std::max(pictures->size(), others->size()); ++i) {
            const std::string picture = "picture " + std::to_string(i + 1);
            if (i >= pictures->size()) {
                gone_.add(picture + " is missing");
            } else if (i >= others->size()) {
                gone_.add(picture + " is not in the golden");
            } else if (is_draw_list((*pictures)[i]) && is_draw_list((*others)[i])) {
                compare_lists(picture + ", ", (*pictures)[i], (*others)[i]);
            } else {
                compare_values(picture, (*pictures)[i], (*others)[i]);
            }
        }
    }

    DrawListComparison result() && {
        DrawListComparison out;
        if (gone_.empty() && other_.empty()) other_ = std::move(follows_);
        gone_.add(std::move(other_));
        out.count = gone_.count();
        out.differences = std::move(gone_).told();
        out.pixels = std::move(pixels_).told();
        return out;
    }

  private:
    // --- draw lists

    /// `in`: "picture 2, " or nothing.
    void compare_lists(const std::string& in, const JsonValue& actual, const JsonValue& golden) {
        in_ = in;
        rows_told_.clear();
        room_.reset();
        if (terms_.other_fonts) room_.emplace(actual, golden);
        std::map<std::string, ComparedList> lists;
        const auto& others = std::get<Members>(actual.data);
        const auto& members = std::get<Members>(golden.data);
        each_member(others, members, [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
            static const Elements kNone;
            const ElementKind* kind = kind_of(key);
            const auto* here = a ? std::get_if<Elements>(&a->data) : &kNone;
            const auto* there = g ? std::get_if<Elements>(&g->data) : &kNone;
            if (!kind || !here || !there) return;
            const ElementTerms how = terms_of(*kind, *here, *there, golden);
            const auto& list =
                lists.try_emplace(key, how, named(how, *here, actual), named(how, *there, golden)).first->second;
            add_gone(list, actual, golden);
        });
        if (room_) {
            if (const auto words = room_->caption_words()) other_.add(in_ + *words);
        }
        const bool ids = std::ranges::all_of(lists, [](const auto& list) {
            return list.second.all_there() || !(list.second.terms.is_object() || list.first == kParticipants.list);
        });
        each_member(others, members, [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
            const auto list = lists.find(key);
            if (list != lists.end()) return compare_pairs(list->second, golden, ids);
            if (key == "camera" && a && g) return compare_cameras(*a, *g);
            compare_values(in_ + cleaned(key), a, g);
        });
    }

    ElementTerms terms_of(const ElementKind& kind, const Elements& actual, const Elements& golden,
                          const JsonValue& list) const {
        ElementTerms out;
        out.kind = &kind;
        out.other_fonts = terms_.other_fonts;
        double side = 0;
        if (const auto* size = held<Elements>(list, "size")) {
            for (const JsonValue& length : *size) {
                if (const auto* number = std::get_if<double>(&length.data)) side = std::max(side, *number);
            }
        }
        out.bound = std::max(kOtherFontPixels, kOtherFontShare * side);
        const auto has_role = [](const JsonValue& text) { return member_of(text, "role") != nullptr; };
        out.roles = std::ranges::all_of(actual, has_role) && std::ranges::all_of(golden, has_role);
        return out;
    }

    static NamedElements named(const ElementTerms& terms, const Elements& elements, const JsonValue& list) {
        NamedElements out{elements, {}};
        for (const JsonValue& element : elements) out.names.push_back(key_of(terms, element, list));
        return out;
    }

    void add_gone(const ComparedList& list, const JsonValue& actual, const JsonValue& golden) {
        const ElementKind& kind = *list.terms.kind;
        for (const std::size_t i : list.alignment.missing) {
            if (excuse_of(kind, list.golden.elements[i], 1) != WordRoom::Excuse::none) continue;
            tell(gone_, kind, "the " + element_words(kind, list.golden.elements[i], i, golden) + " is missing");
        }
        for (const std::size_t i : list.alignment.added) {
            if (excuse_of(kind, list.actual.elements[i], 0) != WordRoom::Excuse::none) continue;
            tell(gone_, kind,
                 "the " + element_words(kind, list.actual.elements[i], i, actual) + " is not in the golden");
        }
    }

    WordRoom::Excuse excuse_of(const ElementKind& kind, const JsonValue& element, std::size_t side) const {
        return room_ ? room_->excuse(kind, element, side) : WordRoom::Excuse::none;
    }

    /// The row of a legend is in two lists, as an entry and as a text.
    void tell(Lines& lines, const ElementKind& kind, const std::string& line) {
        if (kind.list == "legend") rows_told_.insert(line);
        if (&kind == &kTexts && rows_told_.contains(line)) return;
        lines.add(in_ + line);
    }

    /// `ids`: whether the numbers of objects are the same ones.
    void compare_pairs(const ComparedList& list, const JsonValue& golden, bool ids) {
        const ElementKind& kind = *list.terms.kind;
        bool same = list.all_there();
        const auto words_of = [&](std::size_t i) { return element_words(kind, list.golden.elements[i], i, golden); };
        for (const auto& [there, here] : list.alignment.pairs) {
            const JsonValue& actual_one = list.actual.elements[here];
            const JsonValue& golden_one = list.golden.elements[there];
            std::string what = differences_of(list.terms, actual_one, golden_one, ids);
            if (!what.empty() && room_) {
                const auto excuse = std::max(excuse_of(kind, actual_one, 0), excuse_of(kind, golden_one, 1));
                ElementTerms anywhere = list.terms;
                anywhere.bound = std::numeric_limits<double>::infinity();
                if (excuse == WordRoom::Excuse::place) what = differences_of(anywhere, actual_one, golden_one, ids);
                if (excuse == WordRoom::Excuse::all) what.clear();
            }
            if (!what.empty()) {
                same = false;
                tell(other_, kind, words_of(there) + what);
            }
            if (!list.terms.is_object()) continue;
            const auto* seen = held<double>(actual_one, "pixels");
            const auto* before = held<double>(golden_one, "pixels");
            if (!seen || !before || agree(*seen, *before, std::max(kFewPixels, kNearPixels * std::max(*seen, *before))))
                continue;
            pixels_.add(in_ + words_of(there) + ": " + brief(*seen) + (*seen == 1 ? " pixel" : " pixels") +
                        " instead of " + brief(*before));
        }
        if (!same || !kind.in_order || terms_.other_fonts) return;
        if (const auto turned = out_of_order(list.alignment))
            other_.add(in_ + words_of(turned->second) + " comes before " + words_of(turned->first));
    }

    /// ", extents: 1.02 instead of 1", or nothing.
    std::string differences_of(const ElementTerms& terms, const JsonValue& actual, const JsonValue& golden,
                               bool ids) const {
        const auto* members = std::get_if<Members>(&golden.data);
        const auto* others = std::get_if<Members>(&actual.data);
        if (!members || !others) {
            const Unlike unlike = first_unlike(actual, golden);
            return unlike ? ": " + unlike.words() : "";
        }
        MemberWords words;
        each_member(*others, *members, [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
            // Its number and index tell of whom it is, its name does already.
            const bool counts = key == "id" ? ids || !terms.is_object() : terms.counts(key) && key != "participant";
            if (!counts) return;
            const Unlike unlike = a && g ? first_unlike(*a, *g, terms.bound_of(key)) : Unlike{a, g};
            const auto* text = a ? std::get_if<std::string>(&a->data) : nullptr;
            const auto* before = g ? std::get_if<std::string>(&g->data) : nullptr;
            const bool cut = room_ && terms.kind == &kTexts && key == "text" && text && before;
            if (unlike && !(cut && (WordRoom::is_caption(golden) || are_cut_alike(*text, *before))))
                words.add(key, unlike);
        });
        return words.empty() ? "" : ", " + words.words();
    }

    void compare_cameras(const JsonValue& actual, const JsonValue& golden) {
        const auto* members = std::get_if<Members>(&golden.data);
        const auto* others = std::get_if<Members>(&actual.data);
        if (!members || !others) return compare_values(in_ + "camera", &actual, &golden);
        MemberWords words, follows;
        each_member(*others, *members, [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
            const Unlike unlike = a && g ? first_unlike(*a, *g) : Unlike{a, g};
            if (unlike) (key == "clip_from_world" ? follows : words).add(key, unlike);
        });
        if (!words.empty()) other_.add(in_ + "camera, " + words.words());
        if (!follows.empty()) follows_.add(in_ + "camera, " + follows.words());
    }

    // --- any JSON

    /// Either may be none, not both.
    void compare_values(const std::string& place, const JsonValue* actual, const JsonValue* golden) {
        if (!actual) return gone_.add(place + " is missing: " + shown(golden));
        if (!golden) return gone_.add(place + " is not in the golden: " + shown(actual));
        compare_values(place, *actual, *golden);
    }

    void compare_values(const std::string& place, const JsonValue& actual, const JsonValue& golden) {
        if (actual.data.index() == golden.data.index()) {
            if (const auto* members = std::get_if<Members>(&golden.data)) {
                const auto& others = std::get<Members>(actual.data);
                return each_member(others, *members,
                                   [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
                                       compare_values(place + pointer_token(key), a, g);
                                   });
            }
            if (const auto* elements = std::get_if<Elements>(&golden.data))
                return compare_arrays(place, std::get<Elements>(actual.data), *elements);
        }
        const Unlike unlike = first_unlike(actual, golden);
        if (unlike) other_.add((place.empty() ? "the whole" : place) + ": " + unlike.words());
    }

    void compare_arrays(const std::string& place, const Elements& actual, const Elements& golden) {
        const auto at = [&](std::size_t i) { return place + '/' + std::to_string(i); };
        const auto is_number = [](const JsonValue& value) { return std::holds_alternative<double>(value.data); };
        if (actual.size() == golden.size() && std::ranges::all_of(golden, is_number)) {
            // A vector is one thing.
            for (std::size_t i = 0; i < golden.size(); ++i) {
                const Unlike unlike = first_unlike(actual[i], golden[i]);
                if (unlike) return other_.add(at(i) + ": " + unlike.words());
            }
            return;
        }
        const ElementTerms terms;
        const auto unnamed = [](const Elements& elements) {
            return NamedElements{elements, std::vector<std::string>(elements.size())};
        };
        const ComparedList list(terms, unnamed(actual), unnamed(golden));
        for (const std::size_t i : list.alignment.missing) compare_values(at(i), nullptr, &golden[i]);
        for (const std::size_t i : list.alignment.added) compare_values(at(i), &actual[i], nullptr);
        for (const auto& [there, here] : list.alignment.pairs) compare_values(at(there), actual[here], golden[there]);
        const auto turned = out_of_order(list.alignment);
        if (turned)
            other_.add(at(turned->second) + " comes before " + at(turned->first) + ": " +
                       shown(&golden[turned->second]) + " before " + shown(&golden[turned->first]));
    }

    DrawListTerms terms_;
    Lines gone_;     ///< what is missing or not in the golden
    Lines other_;    ///< what differs
    Lines follows_;  ///< what differs where something else does
    Lines pixels_;
    std::string in_;
    std::optional<WordRoom> room_;  ///< of the lists that are compared, where fonts are other ones
    std::set<std::string> rows_told_;
};

}  // namespace

DrawListComparison compare_draw_lists(std::string_view actual, const std::string& actual_name, std::string_view golden,
                                      const std::string& golden_name, const DrawListTerms& terms) {
    DrawListComparer comparer(terms);
    comparer.compare(parse_json(actual, actual_name), parse_json(golden, golden_name));
    return std::move(comparer).result();
}

}  // namespace mobbscope
