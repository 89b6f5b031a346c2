/// Numbers and words in text, the same in every locale.
#pragma once

#include <base/budget.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

/// The whole text as a finite decimal number; nothing for anything else ("", blanks, "nan", "1e999", "0x1", "1.5m").
/// What is too small for a double ("1e-400") is zero.
std::optional<double> parse_double(std::string_view text);
/// Reads a number such as "-12.25", without a power, that begins at `at`, several times as fast as parse_double.
/// Returns where it ends; `at` where there is none, or one of more digits than a double holds. What follows may belong
/// to the number: see that a blank or the end does.
const char* read_plain_double(const char* at, const char* end, double& value);
/// The number within [low, high]; throws std::invalid_argument, saying what is allowed.
double parse_number_within(std::string_view text, double low, double high);

/// The whole text as a decimal int ("010" is 10); nothing for anything else.
std::optional<int> parse_int(std::string_view text);

/// "A:B" as two finite numbers; nothing for anything else.
std::optional<std::pair<double, double>> parse_range(std::string_view text);

/// The fewest digits that are read back as the same double. Negative zero keeps its sign ("-0.0").
std::string format_double(double value);

/// A number for people: six significant digits.
std::string brief(double value);

/// A figure for people: so many significant digits, and all those before the point: "1.235", "12346".
std::string figure(double value, int digits = 4);

/// How many there are now, against before: "3.1 times as many", "13 times fewer"; empty where they are nearly as many,
/// or one of them is 0 or less.
std::string ratio_words(double now, double before);

/// A place or a time for people: to the thousandth, however large, without zeros at the end.
std::string to_thousandth(double value);

/// "0.183 m", "0.42 s": three digits or millimetres, whichever is more.
std::string with_unit(double value, const char* unit);
/// A proven bound: as with_unit, but rounded down. The same bound reads the same everywhere.
std::string proven_words(double value, const char* unit);

/// As std::printf writes it.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// "1 sample", "12 samples".
std::string counted(std::integral auto count, std::string_view singular, std::string_view plural) {
    return std::to_string(count) + ' ' + std::string(count == 1 ? singular : plural);
}

/// The enumerator with that name; `names` stand in the order of the enumeration, from 0.
template <class Enum>
std::optional<Enum> enumerator_named(std::span<const std::string_view> names, std::string_view name) {
    const auto at = std::ranges::find(names, name);
    return at == names.end() ? std::nullopt : std::optional(static_cast<Enum>(at - names.begin()));
}

/// "mobb, umobb, hybrid1".
std::string listed(std::span<const std::string_view> names);
/// "pair, siblings or all".
std::string either(std::span<const std::string_view> names);

/// With small letters for the capitals of ASCII.
char lower_letter(char letter);
std::string lower(std::string_view text);

/// Without blanks (space, tab, carriage return) at both ends.
std::string_view trimmed(std::string_view text);

/// Whether the bytes are well-formed UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

/// The code point that begins at byte `at` < utf8.size(), which moves behind it; U+FFFD for a malformed byte.
char32_t read_code_point(std::string_view utf8, std::size_t& at);
/// All of them.
std::vector<char32_t> code_points(std::string_view utf8);

/// UTF-8 text in which characters that steer a terminal, and those that nobody sees but that change how others look
/// (directions of writing, joiners, separators), stand as JSON writes them: "\u001b", "\u202e".
std::string with_escapes(std::string_view text);

/// Text from a file or a name, fit for a line on a terminal: with_escapes, and '?' for bytes that are not UTF-8.
std::string cleaned(std::string_view text);

/// At most `most` (>= 5) characters: where there are more, the beginning, an ellipsis and the end. Text that is not
/// UTF-8 is cut by bytes.
std::string shortened(std::string_view text, std::size_t most);

/// The longest of what `shortened` makes of a text that fits; that of 5 characters where none does.
std::string shortened_to_fit(std::string_view text, const std::function<bool(const std::string&)>& fits);

/// Text in single quotes for a message: cleaned and shortened.
std::string in_quotes(std::string_view text);

/// " (did you mean 'leaf'?)" if one of the names is near enough to be meant, else "".
std::string did_you_mean(std::string_view word, std::span<const std::string> names);

/// The name with the least edit distance; the first of equals. There must be one.
const std::string& nearest(std::string_view word, std::span<const std::string> names);

/// Sizes for people, in powers of 1,000: "512 B", "4.2 kB", "48 kB", "1.3 MB", "2.1 GB".
std::string bytes_text(std::uintmax_t bytes);

/// A word as a POSIX shell takes it literally: in single quotes where it needs them.
std::string shell_word(const std::string& word);

/// The words of a line, and what follows the first: for statements that take all of it as it stands.
struct ScriptLine {
    std::vector<std::string> words;
    std::string rest;
};

/// Words apart from blanks; one in double quotes may hold blanks. A `#` that begins a word begins a comment. Throws
/// std::invalid_argument if a quote is not closed.
ScriptLine split_line(std::string_view line);

/// Columns of a table that are read; none of ours has more, and a line of a million is refused early.
inline constexpr std::size_t kMaxColumns = 64;

/// "line 12": a place in a file.
std::string at_line(int line);

/// Appends the next piece of a text; false at the end.
using TextPieces = std::function<bool(std::string& to)>;

/// The lines of a file that are not blank, without blanks at their ends. A byte order mark and carriage returns do not
/// matter.
class TextLines {
  public:
    /// `file` stands for the file in messages; both must outlive this. Throws InputError, as next does, for what is no
    /// UTF-8 text by its looks: UTF-16, lines that end with carriage returns alone.
    TextLines(std::string_view text, const std::string& file);
    /// The same of a text that comes in pieces.
    TextLines(TextPieces more, const std::string& file);
    TextLines(const TextLines&) = delete;
    TextLines& operator=(const TextLines&) = delete;

    /// Moves to the next line that is not blank; false at the end. Throws InputError if it holds a NUL byte. Of a text
    /// in pieces the line before is gone then.
    bool next();
    /// Puts the next line, blank or not, to the one in hand, which has a line feed between them then; false at the end.
    bool join();
    bool empty() const { return rest_.empty() && number_ == 0; }  ///< the whole text

    std::string_view line() const { return trimmed(whole_); }
    std::string_view whole_line() const { return whole_; }  ///< with the blanks at its ends
    int number() const { return number_; }                  ///< of the line, or the first of it, from 1; 0 before any

    /// Throws InputError for this line.
    [[noreturn]] void fail(const std::string& message) const;

  private:
    void check();
    bool take_piece();
    void take_line(std::size_t from);

    std::string_view rest_;
    const std::string& file_;
    std::string_view whole_;
    TextPieces more_;
    std::string buffer_;  ///< of a text in pieces: what is at hand of it
    Spent spent_;         ///< for that
    int number_ = 0;
    int joined_ = 0;  ///< lines that were put to it
};

}  // namespace mobbscope
