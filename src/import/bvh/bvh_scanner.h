/// Words, numbers and lines of a BVH, taken off the front of its text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mobbscope {

/// Numbers beyond this, in file units or degrees, come from damaged files.
inline constexpr double kMaxBvhValue = 1e9;

/// A place in a text; lines may end with LF, CRLF or CR. Text and file name must outlive it.
class BvhScanner {
  public:
    BvhScanner(std::string_view text, const std::string& file)
        : at_(text.data()), end_(text.data() + text.size()), file_(file) {}

    int line() const { return line_; }  ///< from 1
    std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
    bool at_end() const { return at_ == end_; }
    bool at_line_end() const { return at_ == end_ || is_line_end(*at_); }

    /// Throws InputError for a line of the file.
    [[noreturn]] void fail(int line, const std::string& message) const;
    [[noreturn]] void fail(const std::string& message) const { fail(line_, message); }

    /// Past a byte order mark. Throws InputError if there is no text, or UTF-16.
    void begin();
    /// To the next word or end of this line.
    void skip_blanks() {
        while (at_ != end_ && is_blank(*at_)) ++at_;
    }
    /// To the next word, on this line or a later one.
    void skip_space();

    /// The next word, on this line or a later one: up to a blank, a line end or a brace; a brace is a word of its own.
    /// Empty at the end of the file.
    std::string_view next_word();
    /// Makes the word that was taken last the next one again.
    void put_back(std::string_view word) { at_ = word.data(); }
    /// What is left of this line, without blanks at its ends. Stays before the line end.
    std::string_view rest_of_line();
    /// The same, up to a { that may end the line.
    std::string_view rest_before_brace();
    /// The number that begins here, before at_line_end(), within +-kMaxBvhValue. Throws InputError.
    double number();

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
    [[noreturn]] void fail_number();

    const char* at_;
    const char* end_;
    const std::string& file_;
    int line_ = 1;
};

/// Quotes what was found where something else was expected: "there is 'x'", or "the file ends".
std::string found(std::string_view word);

/// Whether a word is a keyword, in any case.
bool is_keyword(std::string_view word, std::string_view lower_keyword);

}  // namespace mobbscope
