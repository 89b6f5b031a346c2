#include <render/drawlist/draw_list_json.h>

#include <base/json.h>
#include <base/text.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace mobbscope {

namespace {

using Difference = std::optional<std::string>;

constexpr double kNear = 1e-4;
constexpr double kNearPixels = 0.01;
constexpr double kFewPixels = 16;

bool agree(double a, double b, bool pixels) {
    const double size = std::max(std::abs(a), std::abs(b));
    return std::abs(a - b) <= (pixels ? std::max(kFewPixels, kNearPixels * size) : std::max(kNear, kNear * size));
}

/// Two values of one type that hold no others.
bool agree(const JsonValue& a, const JsonValue& b, bool pixels) {
    if (const auto* number = std::get_if<double>(&a.data)) return agree(*number, std::get<double>(b.data), pixels);
    if (const auto* text = std::get_if<std::string>(&a.data)) return *text == std::get<std::string>(b.data);
    if (const auto* boolean = std::get_if<bool>(&a.data)) return *boolean == std::get<bool>(b.data);
    return true;
}

/// A place for a message.
std::string named(const std::string& place) { return place.empty() ? "the whole" : place; }

/// A value for a message.
std::string shown(const JsonValue& value) {
    struct Show {
        std::string operator()(std::nullptr_t) const { return "null"; }
        std::string operator()(bool boolean) const { return boolean ? "true" : "false"; }
        std::string operator()(double number) const { return brief(number); }
        std::string operator()(const std::string& text) const { return in_quotes(text); }
        std::string operator()(const JsonValue::Array&) const { return "an array"; }
        std::string operator()(const JsonValue::Object&) const { return "an object"; }
    };
    return std::visit(Show{}, value.data);
}

const JsonValue* find(const JsonValue::Object& object, const std::string& key) {
    const auto found =
        std::find_if(object.begin(), object.end(), [&](const JsonMember& member) { return member.key == key; });
    return found == object.end() ? nullptr : &found->value;
}

/// Where two values have another number of elements: those that are missing shift all that come after.
Difference length_difference(const std::string& place, const JsonValue& actual, const JsonValue& golden) {
    const auto* here = std::get_if<JsonValue::Array>(&actual.data);
    const auto* there = std::get_if<JsonValue::Array>(&golden.data);
    if (!here || !there || here->size() == there->size()) return std::nullopt;
    return named(place) + ": " + counted(static_cast<long long>(here->size()), "element", "elements") + " instead of " +
           std::to_string(there->size());
}

Difference value_difference(const std::string& place, const JsonValue& actual, const JsonValue& golden, bool pixels);

Difference value_difference(const std::string& place, const JsonValue::Array& actual, const JsonValue::Array& golden) {
    for (std::size_t i = 0; i < golden.size(); ++i) {
        if (auto found = value_difference(place + '/' + std::to_string(i), actual[i], golden[i], false)) return found;
    }
    return std::nullopt;
}

Difference value_difference(const std::string& place, const JsonValue::Object& actual,
                            const JsonValue::Object& golden) {
    for (const JsonMember& member : golden) {
        const JsonValue* found = find(actual, member.key);
        if (!found) return place + pointer_token(member.key) + ": missing";
        if (auto length = length_difference(place + pointer_token(member.key), *found, member.value)) return length;
    }
    for (const JsonMember& member : actual) {
        if (!find(golden, member.key)) return place + pointer_token(member.key) + ": not expected";
    }
    for (const JsonMember& member : golden) {
        auto found = value_difference(place + pointer_token(member.key), *find(actual, member.key), member.value,
                                      member.key == "pixels");
        if (found) return found;
    }
    return std::nullopt;
}

/// `pixels`: whether they are numbers of pixels.
Difference value_difference(const std::string& place, const JsonValue& actual, const JsonValue& golden, bool pixels) {
    if (actual.data.index() == golden.data.index()) {
        if (const auto* object = std::get_if<JsonValue::Object>(&golden.data))
            return value_difference(place, std::get<JsonValue::Object>(actual.data), *object);
        if (const auto* array = std::get_if<JsonValue::Array>(&golden.data)) {
            if (auto length = length_difference(place, actual, golden)) return length;
            return value_difference(place, std::get<JsonValue::Array>(actual.data), *array);
        }
        if (agree(actual, golden, pixels)) return std::nullopt;
    }
    return named(place) + ": " + shown(actual) + " instead of " + shown(golden);
}

}  // namespace

std::optional<std::string> first_difference(std::string_view actual, const std::string& actual_name,
                                            std::string_view golden, const std::string& golden_name) {
    return value_difference("", parse_json(actual, actual_name), parse_json(golden, golden_name), false);
}

}  // namespace mobbscope
