/// Numbers and words in text, the same in every locale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mobbscope {

/// The whole text as a finite decimal number; nothing for anything else (blanks, "nan", "1e999", "0x1", "1.5m").
std::optional<double> parse_double(std::string_view text);

/// The whole text as a decimal int; nothing for anything else.
std::optional<int> parse_int(std::string_view text);

/// "A:B" as two finite numbers; nothing for anything else.
std::optional<std::pair<double, double>> parse_range(std::string_view text);

/// 17 significant digits: the number that is read back is the same double. Negative zero keeps its sign ("-0.0").
std::string format_double(double value);

/// The fewest digits that are read back as the same double: for messages.
std::string short_double(double value);

/// Without blanks (space, tab, carriage return) at both ends.
std::string_view trimmed(std::string_view text);

/// Whether the bytes are well-formed UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

/// Text in single quotes for a message: control characters are replaced, long text is cut.
std::string in_quotes(std::string_view text);

/// " (did you mean 'leaf'?)" if one of the names is near enough to be meant, else "".
std::string did_you_mean(std::string_view word, std::span<const std::string> names);

/// The name with the least edit distance; the first of equals. There must be one.
const std::string& nearest(std::string_view word, std::span<const std::string> names);

}  // namespace mobbscope
