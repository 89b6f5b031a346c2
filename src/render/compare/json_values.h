/// JSON values as they are compared: what two hold, and where they first differ.
#pragma once

#include <base/json.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>

namespace mobbscope::compare {

using Elements = JsonValue::Array;
using Members = JsonValue::Object;

/// Null if there is none. `hint`: where it is likely to be; then where the next one is.
const JsonValue* member_of(const Members& object, std::string_view key, std::size_t& hint);

/// Null if the value is no object, or the member is missing or of another type.
template <class Held>
const Held* held(const JsonValue& value, std::string_view key) {
    const auto* object = value.as<Members>();
    std::size_t hint = 0;
    const JsonValue* found = object ? member_of(*object, key, hint) : nullptr;
    return found ? found->as<Held>() : nullptr;
}

/// Null beyond the end.
inline const JsonValue* element_at(const Elements& elements, std::size_t index) {
    return index < elements.size() ? &elements[index] : nullptr;
}

/// Empty if there is none.
std::string text_in(const JsonValue& value, std::string_view key);

/// Whether both are objects. Calls with each key and both values, in the golden's order and then the actual one's; null
/// where one has none.
template <class Call>
bool each_member(const JsonValue& actual, const JsonValue& golden, const Call& call) {
    const auto* others = actual.as<Members>();
    const auto* members = golden.as<Members>();
    if (!members || !others) return false;
    std::size_t hint = 0;
    for (const JsonMember& member : *members) call(member.key(), member_of(*others, member.key(), hint), &member.value);
    hint = 0;
    for (const JsonMember& member : *others) {
        if (!member_of(*members, member.key(), hint)) call(member.key(), &member.value, nullptr);
    }
    return true;
}

/// A value on one line, or the beginning of a long one; null is "nothing".
std::string shown(const JsonValue* value);

/// In place of a bound: only what is the same agrees.
inline constexpr double kExactly = -1;
/// Whether they are as near as two that are rounded to six digits, or within the bound.
bool agree(double a, double b, double bound);

/// The first that differ of what two values hold; either may be null, both where nothing differs.
struct Unlike {
    const JsonValue* actual = nullptr;
    const JsonValue* golden = nullptr;
    explicit operator bool() const { return actual || golden; }
    std::string words() const { return shown(actual) + " instead of " + shown(golden); }
};

/// Either may be null. `bound`: how far numbers may be apart beyond what always agrees.
Unlike first_unlike(const JsonValue* actual, const JsonValue* golden, double bound = 0);

/// How far apart the numbers of two values are, all together.
double distance(const JsonValue& a, const JsonValue& b);

}  // namespace mobbscope::compare
