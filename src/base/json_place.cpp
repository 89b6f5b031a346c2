#include <base/error.h>
#include <base/json_place.h>
#include <base/text.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mobbscope {

std::string JsonPlace::pointer() const {
    if (!parent_) return "";
    return parent_->pointer() + (key_ ? pointer_token(*key_) : "/" + std::to_string(index_));
}

std::string JsonPlace::description() const {
    const std::string at = "line " + std::to_string(line_);
    return parent_ ? at + ", " + pointer() : at;
}

void JsonPlace::fail(const std::string& message) const { throw InputError(*file_, description(), message); }

void JsonPlace::fail_type(const char* expected) const {
    constexpr std::array<const char*, 6> kTypes{"null",     "true or false", "a number",
                                                "a string", "an array",      "an object"};
    fail(std::string("expected ") + expected + ", found " + kTypes[value_->data.index()]);
}

double JsonPlace::number() const {
    if (const double* number = std::get_if<double>(&value_->data)) return *number;
    fail_type("a number");
}

double JsonPlace::number(double least, double most) const {
    const double value = number();
    if (value >= least && value <= most) return value;
    fail(short_double(value) + " is out of range; give " + short_double(least) + " to " + short_double(most));
}

int JsonPlace::integer(int least, int most) const {
    const double value = number();
    if (value >= least && value <= most && value == std::floor(value)) return static_cast<int>(value);
    fail(short_double(value) + " is out of range; give a whole number from " + std::to_string(least) + " to " +
         std::to_string(most));
}

bool JsonPlace::boolean() const {
    if (const bool* boolean = std::get_if<bool>(&value_->data)) return *boolean;
    fail_type("true or false");
}

const std::string& JsonPlace::string() const {
    if (const std::string* string = std::get_if<std::string>(&value_->data)) return *string;
    fail_type("a string");
}

const JsonValue::Array& JsonPlace::array() const {
    if (const auto* array = std::get_if<JsonValue::Array>(&value_->data)) return *array;
    fail_type("an array");
}

const JsonValue::Object& JsonPlace::object() const {
    if (const auto* object = std::get_if<JsonValue::Object>(&value_->data)) return *object;
    fail_type("an object");
}

int JsonPlace::size() const { return static_cast<int>(array().size()); }

JsonPlace JsonPlace::operator[](int index) const& { return {*this, array()[static_cast<std::size_t>(index)], index}; }

void JsonPlace::require_size(int count, const char* what) const {
    if (size() != count) fail("has " + std::to_string(size()) + " elements; give " + what);
}

int JsonPlace::members() const { return static_cast<int>(object().size()); }

JsonPlace JsonPlace::member(int index) const& { return {*this, object()[static_cast<std::size_t>(index)]}; }

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const& {
    for (const JsonMember& member : object()) {
        if (member.key == key) return JsonPlace(*this, member);
    }
    return std::nullopt;
}

JsonPlace JsonPlace::require(std::string_view key) const& {
    if (std::optional<JsonPlace> found = find(key)) return *found;
    fail("the key '" + std::string(key) + "' is missing; add it");
}

void JsonPlace::allow_only(std::initializer_list<std::string_view> keys) const {
    for (const JsonMember& member : object()) {
        if (std::find(keys.begin(), keys.end(), member.key) != keys.end()) continue;
        const std::vector<std::string> names(keys.begin(), keys.end());
        JsonPlace(*this, member)
            .fail("unknown key " + in_quotes(member.key) + "; the nearest known key is " +
                  in_quotes(nearest(member.key, names)));
    }
}

}  // namespace mobbscope
