/// Text files line by line, as people and other programs write them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mobbscope {

/// Columns of a table that are read; none of ours has more, and a line of a million is refused early.
inline constexpr std::size_t kMaxColumns = 64;

/// "line 12": a place in a file.
std::string at_line(int line);

/// The lines of a file that are not blank, without blanks at their ends. A byte order mark and carriage returns do not
/// matter.
class TextLines {
  public:
    /// `file` stands for the file in messages; both must outlive this. Throws InputError, as next does, for what is no
    /// UTF-8 text by its looks: UTF-16, lines that end with carriage returns alone.
    TextLines(std::string_view text, const std::string& file);

    /// Moves to the next line that is not blank; false at the end. Throws InputError if it holds a NUL byte.
    bool next();

    std::string_view line() const { return line_; }
    int number() const { return number_; }  ///< of the line, from 1; 0 before the first

    /// Throws InputError for this line.
    [[noreturn]] void fail(const std::string& message) const;

  private:
    std::string_view rest_;
    const std::string& file_;
    std::string_view line_;
    int number_ = 0;
};

}  // namespace mobbscope
