#include <base/text.h>
#include <render/compare/elements.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <utility>

namespace mobbscope::compare {

namespace {

constexpr std::array<ElementKind, 11> kElementKinds{
    {{"participants", "participant", {}, false, true, {}},
     {"disks", "disk", {"participant", "sample"}, false, false, {}},
     {"boxes", "box", {"participant", "node"}, false, false, {}},
     {"lines", "line", {}, false, true, {}},
     {"highlights", "highlight", {}, false, true, {}},
     {"legend", "legend row", {"text"}, true, true, {}},
     {"overlays", "panel", {"name"}, false, true, {"min", "max"}},
     {"panels", "panel", {}, false, true, {"min", "max"}},
     {"overlay_lines", "line over the scene", {}, false, true, {"from", "to"}},
     {"marks", "mark", {}, false, true, {"min", "max"}},
     {"texts", "text", {"role", "text"}, true, true, {"at"}}}};

/// Whose it is; empty if nobody's that has a name.
std::string participant_of(const JsonValue& element, const std::vector<std::string>& participants) {
    const auto* index = held<double>(element, "participant");
    const bool has_name = index && *index >= 0 && *index < static_cast<double>(participants.size());
    return has_name ? participants[static_cast<std::size_t>(*index)] : "";
}

/// " from (1, 0.5, 0)", or nothing.
std::string point_words(const JsonValue& element, std::string_view before, std::string_view key) {
    const auto* point = held<Elements>(element, key);
    if (!point) return "";
    std::string out;
    for (const JsonValue& number : *point) out += (out.empty() ? "" : ", ") + shown(&number);
    return std::string(before) + '(' + shortened(out, 60) + ')';
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

std::string role_words(std::string_view role, const std::string& text) {
    static const std::map<std::string_view, std::pair<std::string, std::string>> kRoles{
        {"label", {"label ", ""}},
        {"tick", {"tick label ", ""}},
        {"name", {"name ", ""}},
        {"note", {"note ", ""}},
        {"caption", {"line ", " of the caption"}},
        {"legend", {"row ", " of the legend"}},
        {"header", {"header ", ""}},
        {"map", {"title ", " of the map"}}};
    const auto found = kRoles.find(role);
    if (found == kRoles.end()) return "text " + in_quotes(text);
    return found->second.first + in_quotes(text) + found->second.second;
}

/// `terms`: of its members, if not all count.
void add_print(std::string& out, const JsonValue& value, bool rounded, const ElementTerms* terms = nullptr) {
    out += static_cast<char>('0' + value.data.index());
    if (const auto* number = value.as<double>()) {
        // asinh: near 0 the number itself, elsewhere like its logarithm; and 0 has no sign.
        const double kept = (rounded ? std::round(1000 * std::asinh(*number)) : *number) + 0.0;
        std::array<char, sizeof kept> bytes;
        std::memcpy(bytes.data(), &kept, sizeof kept);
        out.append(bytes.data(), bytes.size());
    } else if (const auto* text = value.as<std::string>()) {
        (out += *text) += '\0';
    } else if (const auto* boolean = value.as<bool>()) {
        out += *boolean ? '1' : '0';
    } else if (const auto* elements = value.as<Elements>()) {
        for (const JsonValue& element : *elements) add_print(out, element, rounded);
        out += ']';
    } else if (const auto* members = value.as<Members>()) {
        for (const JsonMember& member : *members) {
            if (terms && !terms->counts(member.key())) continue;
            (out += member.key()) += '\0';
            add_print(out, member.value, rounded);
        }
        out += '}';
    }
}

}  // namespace

const ElementKind* kind_of(std::string_view list) {
    const auto found = std::ranges::find(kElementKinds, list, &ElementKind::list);
    return found == kElementKinds.end() ? nullptr : &*found;
}

bool is_draw_list(const JsonValue& value) {
    const auto* object = value.as<Members>();
    return object && std::ranges::any_of(*object, [](const JsonMember& member) {
               return kind_of(member.key()) && member.value.as<Elements>();
           });
}

std::vector<std::string> participants_of(const JsonValue& list) {
    std::vector<std::string> out;
    const auto* participants = held<Elements>(list, "participants");
    if (!participants) return out;
    for (const JsonValue& participant : *participants) {
        const auto* name = participant.as<std::string>();
        out.push_back(name ? *name : "");
    }
    return out;
}

std::string key_of(const ElementTerms& terms, const JsonValue& element, std::size_t index,
                   const std::vector<std::string>& participants) {
    if (terms.kind.list == "participants") return participants[index];
    std::string out;
    for (const std::string_view key : terms.kind.name) {
        if (key.empty() || !terms.counts(key)) continue;
        const auto* text = held<std::string>(element, key);
        const auto* number = held<double>(element, key);
        // What stands for nothing has no name.
        if (!text && !number) return "";
        // By name, as participants count anew where one is missing.
        const std::string who = key == "participant" ? participant_of(element, participants) : "";
        out += (!who.empty() ? who : text ? *text : format_double(*number)) + '\0';
    }
    return out;
}

std::string element_words(const ElementKind& kind, const JsonValue& element, std::size_t index,
                          const std::vector<std::string>& participants) {
    if (kind.list == "participants") return "participant " + shown(&element);
    const std::string text = text_in(element, "text"), name = text_in(element, "name");
    if (kind.is_text() && !text.empty()) return role_words(text_in(element, "role"), text);
    if (kind.list == "legend" && !text.empty()) return role_words("legend", text);
    if (kind.list == "overlays" && !name.empty()) return "panel of the " + (name == "inset" ? "map" : cleaned(name));
    const std::string called(kind.element);
    const auto* number = kind.is_object() ? held<double>(element, kind.name[1]) : nullptr;
    const std::string who = number ? participant_of(element, participants) : "";
    if (!who.empty())
        return called + " of " + cleaned(who) + ", " + std::string(kind.name[1]) + ' ' + format_double(*number);
    const std::string state = text_in(element, kind.list == "highlights" ? "role" : "state");
    return called + ' ' + std::to_string(index + 1) + (state.empty() ? "" : " (" + cleaned(state) + ')') +
           layer_words(element) + point_words(element, " from ", "from") + point_words(element, " to ", "to") +
           point_words(element, " at ", "min");
}

std::string fingerprint(const ElementTerms& terms, const JsonValue& element, bool rounded) {
    std::string out;
    add_print(out, element, rounded, &terms);
    return out;
}

Likeness likeness(const ElementTerms& terms, const JsonValue& actual, const JsonValue& golden) {
    Likeness out;
    const auto add = [&](const JsonValue* a, const JsonValue* g, double bound) {
        if (a && g) out.apart += distance(*a, *g);
        ++(first_unlike(a, g, bound) ? out.unlike : out.agreeing);
    };
    const bool objects =
        each_member(actual, golden, [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
            if (terms.counts(key)) add(a, g, terms.bound_of(key));
        });
    const auto* elements = golden.as<Elements>();
    const auto* others = actual.as<Elements>();
    if (elements && others) {
        for (std::size_t i = 0; i < std::max(elements->size(), others->size()); ++i) {
            add(element_at(*others, i), element_at(*elements, i), 0);
        }
    } else if (!objects) {
        add(&actual, &golden, 0);
    }
    return out;
}

}  // namespace mobbscope::compare
