/// A parsed JSON text whose values know their line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mobbscope {

struct JsonMember;

/// One value. Numbers are doubles; objects keep the order of their members.
struct JsonValue {
    using Array = std::vector<JsonValue>;
    using Object = std::vector<JsonMember>;

    std::variant<std::nullptr_t, bool, double, std::string, Array, Object> data;
    int line = 0;  ///< where it begins, from 1
};

struct JsonMember {
    std::string key;
    int line = 0;  ///< of the key
    JsonValue value;
};

/// "/key" as it stands in a JSON pointer (RFC 6901); a long key is shortened.
std::string pointer_token(std::string_view key);

/// Parses UTF-8 JSON (RFC 8259). `file` stands for the text in messages. Throws InputError with line and column where
/// the syntax is wrong, a key stands twice in an object, a number is beyond double, or values are nested absurdly deep.
JsonValue parse_json(std::string_view text, const std::string& file);

}  // namespace mobbscope
