/// The import option `columns`: which columns of a table are id, t, frame, x, y and r, or how these are worked out.
#pragma once

#include <import/clip/column_names.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// One column, and what it is: a column of the file, or what is worked out of some ("x+width/2").
struct ChosenColumn {
    Column column;
    std::string text;
};

/// "id=trackId,t=frame/25,x=xCenter" in parts, in that order. Throws std::invalid_argument for what is none.
std::vector<ChosenColumn> chosen_columns(std::string_view text);

/// Numbers, columns, + - * / and parentheses, made ready for the rows of one table.
class ColumnFormula {
  public:
    /// Of a column alone, times a number.
    explicit ColumnFormula(std::size_t column, double factor = 1);
    /// A name of `header` may hold any sign; it may stand in double quotes, and letters may be large or small. Throws
    /// std::invalid_argument for what is no formula, or names no column.
    ColumnFormula(std::string_view text, std::span<const std::string> header);

    /// `number` gives the number that stands in a column, from 0. The result may be no finite number.
    template <class Number>
    double of(const Number& number) const {
        double stack[kMostDepth];
        std::size_t size = 0;
        for (const Step& step : steps_) {
            if (step.kind == Kind::number) stack[size++] = step.value;
            if (step.kind == Kind::column) stack[size++] = number(step.column);
            if (step.kind == Kind::number || step.kind == Kind::column) continue;
            const double b = stack[--size];
            double& a = stack[size - 1];
            a = step.kind == Kind::plus    ? a + b
                : step.kind == Kind::minus ? a - b
                : step.kind == Kind::times ? a * b
                                           : a / b;
        }
        return stack[0];
    }

    /// Those that it takes numbers from.
    std::vector<std::size_t> columns() const;
    /// Of those; kNone: it is made of numbers alone.
    std::size_t first_column() const {
        const auto at = std::ranges::find(steps_, Kind::column, &Step::kind);
        return at == steps_.end() ? kNone : at->column;
    }
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    /// The one that it is, without being worked out.
    std::optional<std::size_t> only_column() const;

  private:
    enum class Kind { number, column, plus, minus, times, over };
    struct Step {
        Kind kind;
        double value = 0;
        std::size_t column = 0;
    };
    static constexpr std::size_t kMostDepth = 32;
    friend class FormulaParser;

    std::vector<Step> steps_;  ///< numbers before what is done with them
};

}  // namespace mobbscope
