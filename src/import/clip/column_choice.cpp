#include <base/text.h>
#include <import/clip/column_choice.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr std::string_view kForm = "write it like id=trackId,t=frame/25,x=xCenter";

bool is_name_sign(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || (c & 0x80) != 0;
}

}  // namespace

std::vector<ChosenColumn> chosen_columns(std::string_view text) {
    std::vector<ChosenColumn> out;
    while (true) {
        // Commas in quotes belong to names.
        bool quoted = false;
        std::size_t end = 0;
        for (; end < text.size() && (quoted || text[end] != ','); ++end) quoted = quoted != (text[end] == '"');
        const std::string_view part = trimmed(text.substr(0, end));
        const std::size_t equals = part.find('=');
        const std::string_view key = trimmed(part.substr(0, equals));
        if (equals == std::string_view::npos)
            throw std::invalid_argument("columns: " + in_quotes(part) + " has no '='; " + std::string(kForm));
        const std::optional<Column> column = column_from_name(key);
        if (!column) {
            std::string known;
            for (const Column each : kColumns) known += (known.empty() ? "" : ", ") + std::string(name(each));
            throw std::invalid_argument("columns: " + in_quotes(key) + " is not one of " + known + "; " +
                                        std::string(kForm));
        }
        const std::string_view value = trimmed(part.substr(equals + 1));
        if (value.empty())
            throw std::invalid_argument("columns: " + std::string(key) + " is nothing; " + std::string(kForm));
        if (std::ranges::find(out, *column, &ChosenColumn::column) != out.end())
            throw std::invalid_argument("columns: " + std::string(key) + " stands twice; leave one");
        out.push_back({*column, std::string(value)});
        if (end == text.size()) break;
        text.remove_prefix(end + 1);
    }
    const auto has = [&out](Column column) {
        return std::ranges::find(out, column, &ChosenColumn::column) != out.end();
    };
    if (has(Column::t) && has(Column::frame))
        throw std::invalid_argument("columns: t and frame are two ways to say when; give one of them");
    return out;
}

/// By recursive descent: a sum of products of factors.
class FormulaParser {
  public:
    FormulaParser(std::string_view text, std::span<const std::string> header, std::vector<ColumnFormula::Step>& steps)
        : text_(text), header_(header), steps_(steps) {}

    void parse() {
        sum();
        if (!at_end()) fail("expects an operator at " + in_quotes(text_.substr(at_)));
    }

  private:
    using Kind = ColumnFormula::Kind;

    [[noreturn]] void fail(const std::string& message) const {
        throw std::invalid_argument("columns: " + in_quotes(text_) + " " + message);
    }

    bool at_end() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
        return at_ == text_.size();
    }
    bool take(char sign) {
        if (at_end() || text_[at_] != sign) return false;
        ++at_;
        return true;
    }

    void add(ColumnFormula::Step step) {
        const bool is_value = step.kind == Kind::number || step.kind == Kind::column;
        depth_ = is_value ? depth_ + 1 : depth_ - 1;
        if (depth_ >= ColumnFormula::kMostDepth) fail("is too deep; work it out in the file");
        steps_.push_back(step);
    }

    void sum() { chain(&FormulaParser::product, '+', Kind::plus, '-', Kind::minus); }
    void product() { chain(&FormulaParser::factor, '*', Kind::times, '/', Kind::over); }
    void chain(void (FormulaParser::*part)(), char one, Kind of_one, char other, Kind of_other) {
        (this->*part)();
        while (true) {
            const bool is_one = take(one);
            if (!is_one && !take(other)) return;
            (this->*part)();
            add({is_one ? of_one : of_other});
        }
    }

    void factor() {
        if (++nested_ > ColumnFormula::kMostDepth) fail("is too deep; work it out in the file");
        if (take('(')) {
            sum();
            if (!take(')')) fail("lacks a ')'");
        } else if (!at_end() && text_[at_] == '-') {
            ++at_;
            add({Kind::number, 0});
            factor();
            add({Kind::minus});
        } else if (take('"')) {
            const std::size_t end = text_.find('"', at_);
            if (end == std::string_view::npos) fail("lacks a closing quote");
            const std::string_view name = text_.substr(at_, end - at_);
            at_ = end + 1;
            add({Kind::column, 0, named(name)});
        } else if (const std::optional<std::size_t> column = longest_name()) {
            add({Kind::column, 0, *column});
        } else {
            number_or_unknown();
        }
        --nested_;
    }

    /// A name of the header that stands here as a whole word.
    std::optional<std::size_t> longest_name() {
        if (at_end()) fail("ends where a column or a number is expected");
        const std::string rest = lower(text_.substr(at_));
        std::size_t longest = 0;
        std::string_view found;
        for (const std::string& name : header_) {
            if (name.size() <= longest || !rest.starts_with(lower(name)) || parse_double(name)) continue;
            const bool whole =
                name.size() == rest.size() || !is_name_sign(rest[name.size()]) || !is_name_sign(name.back());
            if (!whole) continue;
            longest = name.size();
            found = text_.substr(at_, longest);
        }
        if (longest == 0) return std::nullopt;
        at_ += longest;
        return named(found);
    }

    std::size_t named(std::string_view name) const {
        std::vector<std::size_t> exact, same;
        for (std::size_t i = 0; i < header_.size(); ++i) {
            if (header_[i] == name) exact.push_back(i);
            if (lower(header_[i]) == lower(name)) same.push_back(i);
        }
        const std::vector<std::size_t>& found = exact.empty() ? same : exact;
        if (found.empty())
            fail("names no column " + in_quotes(name) + did_you_mean(name, {header_.begin(), header_.end()}));
        if (found.size() > 1) fail("names the column " + in_quotes(name) + ", which stands twice; remove one");
        return found.front();
    }

    void number_or_unknown() {
        std::size_t end = at_;
        while (end < text_.size() && (is_name_sign(text_[end]) || text_[end] == '.')) ++end;
        // The sign of a power: 1e-3.
        if (end + 1 < text_.size() && end > at_ && lower(text_.substr(end - 1, 1)) == "e" &&
            (text_[end] == '-' || text_[end] == '+') && text_[at_] >= '0' && text_[at_] <= '9') {
            ++end;
            while (end < text_.size() && is_name_sign(text_[end])) ++end;
        }
        const std::string_view word = text_.substr(at_, end - at_);
        const std::optional<double> value = parse_double(word);
        if (value) {
            at_ = end;
            add({Kind::number, *value});
        } else if (word.empty()) {
            fail("has " + in_quotes(text_.substr(at_, 1)) + " where a column or a number is expected");
        } else {
            const std::size_t column = named(word);
            at_ = end;
            add({Kind::column, 0, column});
        }
    }

    std::string_view text_;
    std::span<const std::string> header_;
    std::vector<ColumnFormula::Step>& steps_;
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
    std::size_t nested_ = 0;
};

ColumnFormula::ColumnFormula(std::size_t column, double factor) : steps_{{Kind::column, 0, column}} {
    if (factor == 1) return;
    // Dividing gives the nearest double where the inverse is whole: milliseconds.
    const double inverse = std::round(1 / factor);
    const bool whole = factor == 1 / inverse;
    steps_.push_back({Kind::number, whole ? inverse : factor});
    steps_.push_back({whole ? Kind::over : Kind::times});
}

ColumnFormula::ColumnFormula(std::string_view text, std::span<const std::string> header) {
    FormulaParser(text, header, steps_).parse();
}

std::vector<std::size_t> ColumnFormula::columns() const {
    std::vector<std::size_t> out;
    for (const Step& step : steps_) {
        if (step.kind == Kind::column) out.push_back(step.column);
    }
    return out;
}

std::optional<std::size_t> ColumnFormula::only_column() const {
    return steps_.size() == 1 && steps_.front().kind == Kind::column ? std::optional(steps_.front().column)
                                                                     : std::nullopt;
}

}  // namespace mobbscope
