/// Filters of the rows of a table as text: `gap < 0.05 and level(a) >= 3 and outcome = overlap`.
///
///     filter     = all of { "or" all of };  all of = part { "and" part }
///     part       = "not" part | "(" filter ")" | flag | field comparison value
///     field      = name, or name(a) and name(b) of what each side has
///     comparison = "=" | "!=" | "<" | "<=" | ">" | ">="
///     value      = number with a unit (m, cm, mm, s, ms, %) or without, a word, or a node ("2.1", or its index)
///
/// It has at most 1000 comparisons. What is counted equals whole numbers alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

enum class FieldKind : std::uint8_t {
    number,
    range,  ///< from one number to another: a comparison holds if it does of a number in it
    node,   ///< by its level and place ("2.1") or its index
    word,
    flag,  ///< stands alone, without comparison
};

/// What is known of each row.
struct TableField {
    std::string_view name;  ///< as a filter writes it
    FieldKind kind = FieldKind::number;
    bool of_side = false;        ///< each side has its own: name(a), name(b)
    std::string_view unit = "";  ///< that numbers are shown in, and meant in where a filter says none
    std::string_view words;      ///< in sentences: "the gap"; of a side: "the level of A's node", with A for the side
    std::string_view doc;        ///< for help
    std::span<const std::string_view> values{};  ///< of words, in the order of their numbers
};

/// The fields of a table, by number.
using FieldTable = std::span<const TableField* const>;
template <class Field>
std::vector<const TableField*> pointers_to(std::span<const Field> fields) {
    std::vector<const TableField*> out;
    for (const Field& field : fields) out.push_back(&field);
    return out;
}

/// Text that is no filter. what() says why in one line.
class FilterError : public std::invalid_argument {
  public:
    FilterError(const std::string& message, std::size_t at, std::vector<std::string> expected)
        : std::invalid_argument(message), at_(at), expected_(std::move(expected)) {}
    std::size_t at() const { return at_; }  ///< the byte of the text at which it is wrong
    /// What could stand there.
    const std::vector<std::string>& expected() const { return expected_; }

  private:
    std::size_t at_;
    std::vector<std::string> expected_;
};

enum class Comparison : std::uint8_t { equal, not_equal, less, at_most, greater, at_least };

/// What a row has of a field: from the least to the greatest; of all but ranges both are the same. NaN: it has none,
/// and no comparison with it holds. Words by their place among the field's values, flags 0 or 1.
struct FieldRange {
    double least = 0, most = 0;
};
/// Whether it holds of any number of the range.
bool compares(FieldRange range, Comparison comparison, double with);

/// A filter that was parsed: its terms, each behind those that it joins; the last one is the whole.
class TableFilter {
  public:
    struct Term {
        enum class Kind : std::uint8_t { compare, all_of, one_of, none_of };
        Kind kind = Kind::compare;
        int left = -1, right = -1;  ///< of all_of and one_of both, of none_of the left one
        int field = 0;              ///< in the table
        int side = 0;               ///< 0: a, 1: b
        Comparison comparison = Comparison::equal;
        double value = 0;  ///< in the field's unit; of a flag 1; of a node its index, or its place in the level
        int level = -1;    ///< of a node that is named by its level and place
    };

    /// `fields` outlive it. Throws FilterError.
    TableFilter(FieldTable fields, std::string_view text);

    const std::string& text() const { return text_; }
    std::span<const Term> terms() const { return terms_; }

    /// "the gap is below 0.05 m, and the level of A's node is at least 3".
    std::string words() const;

    /// Whether a row passes; `holds(term)` says whether a comparison does.
    template <class Holds>
    bool passes(const Holds& holds) const {
        return passes(static_cast<int>(terms_.size()) - 1, holds);
    }

    friend bool operator==(const TableFilter& a, const TableFilter& b) { return a.text_ == b.text_; }

  private:
    template <class Holds>
    bool passes(int index, const Holds& holds) const {
        const Term& term = terms_[static_cast<std::size_t>(index)];
        switch (term.kind) {
            case Term::Kind::all_of:
                return passes(term.left, holds) && passes(term.right, holds);
            case Term::Kind::one_of:
                return passes(term.left, holds) || passes(term.right, holds);
            case Term::Kind::none_of:
                return !passes(term.left, holds);
            case Term::Kind::compare:
                break;
        }
        return holds(term);
    }

    FieldTable fields_;
    std::string text_;
    std::vector<Term> terms_;
};

/// The text, and below it a caret where it is wrong: "gap < ?\n      ^". Of a long text what is near that place.
std::string with_caret(std::string_view text, const FilterError& error);

/// How the word at the end of a text may go on, and where that word begins.
struct FilterCompletion {
    std::size_t from = 0;  ///< byte of the text
    std::vector<std::string> words;
};
FilterCompletion completion_of(FieldTable fields, std::string_view text);

}  // namespace mobbscope
