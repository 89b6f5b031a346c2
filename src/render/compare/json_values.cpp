#include <base/text.h>
#include <render/compare/json_values.h>

#include <algorithm>
#include <cmath>

namespace mobbscope::compare {

namespace {

constexpr double kNear = 1e-4;
constexpr double kNearShare = 2e-5;     // twice what the sixth digit of two numbers may differ by
constexpr std::size_t kMostShown = 60;  // characters of an array or object in a message

void add_shown(std::string& out, const JsonValue& value) {
    if (out.size() > kMostShown) return;
    if (const auto* number = value.as<double>()) {
        out += brief(*number);
    } else if (const auto* text = value.as<std::string>()) {
        out += in_quotes(*text);
    } else if (const auto* boolean = value.as<bool>()) {
        out += *boolean ? "true" : "false";
    } else if (const auto* array = value.as<Elements>()) {
        out += '[';
        for (std::size_t i = 0; i < array->size() && out.size() <= kMostShown; ++i) {
            out += i > 0 ? ", " : "";
            add_shown(out, (*array)[i]);
        }
        out += ']';
    } else if (const auto* object = value.as<Members>()) {
        out += '{';
        for (std::size_t i = 0; i < object->size() && out.size() <= kMostShown; ++i) {
            out += (i > 0 ? ", " : "") + cleaned((*object)[i].key()) + ": ";
            add_shown(out, (*object)[i].value);
        }
        out += '}';
    } else {
        out += "null";
    }
}

}  // namespace

const JsonValue* member_of(const Members& object, std::string_view key, std::size_t& hint) {
    for (std::size_t i = 0; i < object.size(); ++i) {
        const std::size_t at = (hint + i) % object.size();
        if (object[at].key() != key) continue;
        hint = at + 1;
        return &object[at].value;
    }
    return nullptr;
}

std::string text_in(const JsonValue& value, std::string_view key) {
    const auto* text = held<std::string>(value, key);
    return text ? *text : "";
}

std::string shown(const JsonValue* value) {
    if (!value) return "nothing";
    std::string out;
    add_shown(out, *value);
    return value->as<std::string>() ? out : shortened(out, kMostShown);
}

bool agree(double a, double b, double bound) {
    if (bound == kExactly) return a == b;
    return std::abs(a - b) <= std::max({bound, kNear, kNearShare * std::abs(a), kNearShare * std::abs(b)});
}

Unlike first_unlike(const JsonValue* actual, const JsonValue* golden, double bound) {
    const Unlike whole{actual, golden};
    if (!actual || !golden || actual->data.index() != golden->data.index()) return whole;
    if (const auto* number = golden->as<double>())
        return agree(std::get<double>(actual->data), *number, bound) ? Unlike{} : whole;
    if (const auto* text = golden->as<std::string>()) return *actual->as<std::string>() == *text ? Unlike{} : whole;
    if (const auto* boolean = golden->as<bool>()) return std::get<bool>(actual->data) == *boolean ? Unlike{} : whole;
    Unlike out;
    if (const auto* elements = golden->as<Elements>()) {
        const auto& others = std::get<Elements>(actual->data);
        if (others.size() != elements->size()) return whole;
        for (std::size_t i = 0; i < others.size() && !out; ++i) out = first_unlike(&others[i], &(*elements)[i], bound);
    }
    each_member(*actual, *golden, [&](const std::string&, const JsonValue* a, const JsonValue* g) {
        if (!out) out = a && g ? first_unlike(a, g, bound) : whole;
    });
    return out;
}

double distance(const JsonValue& a, const JsonValue& b) {
    if (a.data.index() != b.data.index()) return 0;
    if (const auto* number = a.as<double>()) return std::abs(*number - std::get<double>(b.data));
    double out = 0;
    if (const auto* elements = a.as<Elements>()) {
        const auto& others = std::get<Elements>(b.data);
        for (std::size_t i = 0; i < std::min(elements->size(), others.size()); ++i) {
            out += distance((*elements)[i], others[i]);
        }
    }
    return out;
}

}  // namespace mobbscope::compare
