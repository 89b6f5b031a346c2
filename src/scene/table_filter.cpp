#include <base/text.h>
#include <scene/table_filter.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

namespace mobbscope {

namespace {

using Term = TableFilter::Term;

// --- tokens

struct Unit {
    std::string_view name, of;
    double factor;
};
constexpr std::array kUnits{Unit{"m", "m", 1}, Unit{"cm", "m", 0.01},  Unit{"mm", "m", 0.001},
                            Unit{"s", "s", 1}, Unit{"ms", "s", 0.001}, Unit{"%", "%", 1}};

struct Sign {
    std::string_view text;
    Comparison comparison;
    std::string_view words;
};
/// Longer ones first. Of those that mean the same, the first has the words.
constexpr std::array kSigns{Sign{"<=", Comparison::at_most, "at most"}, Sign{">=", Comparison::at_least, "at least"},
                            Sign{"!=", Comparison::not_equal, "not"},   Sign{"==", Comparison::equal, ""},
                            Sign{"=", Comparison::equal, ""},           Sign{"<", Comparison::less, "below"},
                            Sign{">", Comparison::greater, "above"},    Sign{"\u2264", Comparison::at_most, ""},
                            Sign{"\u2265", Comparison::at_least, ""},   Sign{"\u2260", Comparison::not_equal, ""}};

bool begins_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool in_word(char c) { return begins_word(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool in_number(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; }

constexpr int kMostNesting = 100;
constexpr int kMostComparisons = 1000;
constexpr std::size_t kMostAround = 60;  // characters that are shown at either side of what is wrong

class FilterParser {
  public:
    FilterParser(FieldTable fields, std::string_view text) : fields_(fields), text_(text) { skip_blanks(); }

    std::vector<Term> parse() {
        alternatives();
        if (at_ < text_.size()) fail_expecting("'and' or 'or' is missing", {"and", "or"});
        return std::move(terms_);
    }

    /// What may follow a text that is a filter as it stands.
    static std::vector<std::string> joiners() { return {"and", "or"}; }

  private:
    [[noreturn]] void fail_expecting(const std::string& message, std::vector<std::string> expected) const {
        throw FilterError(message, at_, std::move(expected));
    }

    void skip_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    }

    /// The word that begins here; empty: none does.
    std::string_view peeked_word() const {
        std::size_t end = at_;
        if (end < text_.size() && begins_word(text_[end])) {
            while (end < text_.size() && in_word(text_[end])) ++end;
        }
        return text_.substr(at_, end - at_);
    }

    void pass(std::size_t bytes) {
        at_ += bytes;
        skip_blanks();
    }

    bool take_word(std::string_view word) {
        if (lower(peeked_word()) != word) return false;
        pass(word.size());
        return true;
    }

    bool take(char c) {
        if (at_ >= text_.size() || text_[at_] != c) return false;
        pass(1);
        return true;
    }

    int add(const Term& term) {
        terms_.push_back(term);
        return static_cast<int>(terms_.size()) - 1;
    }

    int alternatives() {
        int left = conjunction();
        while (take_word("or")) {
            const int right = conjunction();
            left = add({.kind = Term::Kind::one_of, .left = left, .right = right});
        }
        return left;
    }

    int conjunction() {
        int left = part();
        while (take_word("and")) {
            const int right = part();
            left = add({.kind = Term::Kind::all_of, .left = left, .right = right});
        }
        return left;
    }

    int part() {
        if (++nesting_ > kMostNesting) fail_expecting("it is nested too deep", {});
        int out = 0;
        if (take_word("not")) {
            const int left = part();
            out = add({.kind = Term::Kind::none_of, .left = left});
        } else if (take('(')) {
            out = alternatives();
            if (!take(')')) fail_expecting("')' is missing", {")", "and", "or"});
        } else {
            out = add(comparison());
        }
        --nesting_;
        return out;
    }

    Term comparison() {
        // Each is one level deeper for whoever walks the tree.
        if (++comparisons_ > kMostComparisons)
            fail_expecting("it has too many parts: at most " + std::to_string(kMostComparisons), {});
        const std::string word = lower(peeked_word());
        std::vector<std::string> names;
        for (const TableField* field : fields_) {
            const std::string name(field->name);
            if (field->of_side) {
                names.push_back(name + "(a)");
                names.push_back(name + "(b)");
            } else {
                names.push_back(name);
            }
        }
        names.insert(names.end(), {"not", "("});
        const auto found = std::ranges::find(fields_, word, &TableField::name);
        if (found == fields_.end()) {
            if (word.empty())
                fail_expecting(at_ < text_.size() ? "a field must stand here" : "a field is missing", names);
            std::vector<std::string> plain;
            for (const TableField* field : fields_) plain.emplace_back(field->name);
            fail_expecting(in_quotes(word) + " is not a field" + did_you_mean(word, plain), names);
        }
        const TableField& field = **found;
        Term term{.field = static_cast<int>(found - fields_.begin())};
        pass(word.size());
        if (field.of_side) term.side = side(field);
        if (field.kind == FieldKind::flag) {
            term.value = 1;
            return term;
        }
        term.comparison = sign(field);
        value(field, term);
        return term;
    }

    int side(const TableField& field) {
        const std::string name(field.name);
        if (!take('(')) fail_expecting("whose? Give " + name + "(a) or " + name + "(b)", {"(a)", "(b)"});
        const std::string word = lower(peeked_word());
        if (word != "a" && word != "b") fail_expecting("a or b must stand here", {"a)", "b)"});
        pass(1);
        if (!take(')')) fail_expecting("')' is missing", {")"});
        return word == "a" ? 0 : 1;
    }

    Comparison sign(const TableField& field) {
        const bool equality = field.kind == FieldKind::word || field.kind == FieldKind::node;
        std::vector<std::string> signs{"=", "!="};
        if (!equality) signs.insert(signs.end(), {"<", "<=", ">", ">="});
        for (const Sign& sign : kSigns) {
            if (!text_.substr(at_).starts_with(sign.text)) continue;
            if (equality && sign.comparison != Comparison::equal && sign.comparison != Comparison::not_equal)
                fail_expecting("only = and != compare " + std::string(field.name), signs);
            pass(sign.text.size());
            return sign.comparison;
        }
        fail_expecting("a comparison is missing: =, !=" + std::string(equality ? "" : ", <, <=, > or >="), signs);
    }

    void value(const TableField& field, Term& term) {
        if (field.kind == FieldKind::word) {
            const std::string word = lower(peeked_word());
            const auto at = std::ranges::find(field.values, word);
            std::vector<std::string> words(field.values.begin(), field.values.end());
            if (at == field.values.end()) {
                fail_expecting((word.empty() ? "a word is missing" : in_quotes(word) + " is not one of them") + ": " +
                                   listed(field.values),
                               words);
            }
            term.value = static_cast<double>(at - field.values.begin());
            return pass(word.size());
        }
        const std::size_t begin = at_;
        std::size_t end = at_;
        if (end < text_.size() && (text_[end] == '-' || text_[end] == '+')) ++end;
        while (end < text_.size() && in_number(text_[end])) ++end;
        // A power: 1e-3.
        if (end > begin && end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
            std::size_t power = end + 1;
            if (power < text_.size() && (text_[power] == '-' || text_[power] == '+')) ++power;
            if (power < text_.size() && in_number(text_[power])) {
                while (power < text_.size() && in_number(text_[power])) ++power;
                end = power;
            }
        }
        const std::string_view number = text_.substr(begin, end - begin);
        refuse_comma(number);
        if (field.kind == FieldKind::node) {
            node(number, term);
            unit(field);
            return;
        }
        const auto parsed = parse_double(number);
        if (!parsed)
            fail_expecting(number.empty() ? "a number is missing" : in_quotes(number) + " is not a number", {});
        const bool equality = term.comparison == Comparison::equal || term.comparison == Comparison::not_equal;
        if (equality && field.unit.empty() && *parsed != std::floor(*parsed))
            fail_expecting("the " + std::string(field.name) + " is a whole number", {});
        pass(number.size());
        term.value = *parsed * unit(field);
    }

    /// "0,5" for 0.5.
    void refuse_comma(std::string_view number) {
        const std::string_view behind = text_.substr(at_ + number.size());
        if (number.empty() || number.find('.') != std::string_view::npos || !behind.starts_with(',')) return;
        std::size_t digits = 0;
        while (1 + digits < behind.size() && std::isdigit(static_cast<unsigned char>(behind[1 + digits])) != 0)
            ++digits;
        if (digits == 0) return;
        at_ += number.size();
        fail_expecting(
            "write " + in_quotes(std::string(number) + '.' + std::string(behind.substr(1, digits))) + " with a point",
            {});
    }

    /// Whether a word behind a value goes on with the filter, well written or nearly.
    bool goes_on(const std::string& word) const {
        const std::vector<std::string> joins = joiners();
        const auto begun = [&](const std::string& joiner) { return joiner.starts_with(word); };
        return word == "not" || std::ranges::any_of(joins, begun) || !did_you_mean(word, joins).empty() ||
               std::ranges::find(fields_, word, &TableField::name) != fields_.end();
    }

    void node(std::string_view number, Term& term) {
        const std::size_t point = number.find('.');
        const auto whole = [&](std::string_view text) {
            const auto value = parse_int(text);
            if (!value || *value < 0) fail_expecting("a node is missing: its level and place (2.1) or its index", {});
            return *value;
        };
        if (point == std::string_view::npos) {
            term.value = whole(number);
        } else {
            term.level = whole(number.substr(0, point));
            term.value = whole(number.substr(point + 1));
        }
        pass(number.size());
    }

    /// What the number is multiplied by.
    double unit(const TableField& field) {
        const bool percent = at_ < text_.size() && text_[at_] == '%';
        const std::string word = percent ? "%" : lower(peeked_word());
        const auto known = std::ranges::find(kUnits, word, &Unit::name);
        if (known == kUnits.end() && goes_on(word)) return 1;
        if (known == kUnits.end() || known->of != field.unit) {
            std::vector<std::string_view> names;
            for (const Unit& unit : kUnits) {
                if (unit.of == field.unit) names.push_back(unit.name);
            }
            const std::string what = "the " + std::string(field.name);
            fail_expecting(names.empty() ? what + (field.unit.empty() ? " has no unit" : " is given without its unit")
                                         : in_quotes(word) + " is not a unit of " + what + ": " + either(names),
                           {names.begin(), names.end()});
        }
        pass(word.size());
        return known->factor;
    }

    FieldTable fields_;
    std::string_view text_;
    std::size_t at_ = 0;
    int nesting_ = 0;
    int comparisons_ = 0;
    std::vector<Term> terms_;
};

/// "the level of B's node" from "the level of A's node".
std::string of_side(std::string_view words, int side) {
    std::string out(words);
    if (side == 1) {
        const std::size_t at = out.find("A's");
        if (at != std::string::npos) out[at] = 'B';
    }
    return out;
}

std::string compared_words(FieldTable fields, const Term& term) {
    const TableField& field = *fields[static_cast<std::size_t>(term.field)];
    std::string what = field.of_side ? of_side(field.words, term.side) : std::string(field.words);
    if (field.kind == FieldKind::flag) return what;
    std::string out = what + " is ";
    const auto sign = std::ranges::find(kSigns, term.comparison, &Sign::comparison);
    if (!sign->words.empty()) out += std::string(sign->words) + ' ';
    if (field.kind == FieldKind::word) {
        std::string word(field.values[static_cast<std::size_t>(term.value)]);
        std::ranges::replace(word, '_', ' ');
        return out + word;
    }
    if (term.level >= 0) out += std::to_string(term.level) + '.';
    out += format_double(term.value);
    return field.unit.empty() ? out : out + ' ' + std::string(field.unit);
}

std::string term_words(FieldTable fields, std::span<const Term> terms, int index) {
    const Term& term = terms[static_cast<std::size_t>(index)];
    const auto of = [&](int part) {
        const bool joins = terms[static_cast<std::size_t>(part)].kind == Term::Kind::one_of;
        const std::string words = term_words(fields, terms, part);
        return joins && term.kind != Term::Kind::one_of ? '(' + words + ')' : words;
    };
    switch (term.kind) {
        case Term::Kind::all_of:
            return of(term.left) + ", and " + of(term.right);
        case Term::Kind::one_of:
            return of(term.left) + ", or " + of(term.right);
        case Term::Kind::none_of:
            return "not (" + term_words(fields, terms, term.left) + ')';
        case Term::Kind::compare:
            break;
    }
    return compared_words(fields, term);
}

}  // namespace

bool compares(FieldRange range, Comparison comparison, double with) {
    switch (comparison) {
        case Comparison::equal:
            return range.least <= with && with <= range.most;
        case Comparison::not_equal:
            return with < range.least || with > range.most;
        case Comparison::less:
            return range.least < with;
        case Comparison::at_most:
            return range.least <= with;
        case Comparison::greater:
            return range.most > with;
        case Comparison::at_least:
            return range.most >= with;
    }
    return false;
}

TableFilter::TableFilter(FieldTable fields, std::string_view text)
    : fields_(fields), text_(text), terms_(FilterParser(fields, text).parse()) {}

std::string TableFilter::words() const { return term_words(fields_, terms_, static_cast<int>(terms_.size()) - 1); }

std::string with_caret(std::string_view text, const FilterError& error) {
    const std::string before = cleaned(text.substr(0, error.at())), after = cleaned(text.substr(error.at()));
    const auto begins_character = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; };
    // What is near the place is shown of a long text.
    std::size_t from = before.size(), to = 0, characters = 0;
    for (; from > 0 && characters < kMostAround; --from) characters += begins_character(before[from - 1]) ? 1u : 0u;
    for (std::size_t seen = 0; to < after.size(); ++to) {
        if (begins_character(after[to]) && ++seen > kMostAround) break;
    }
    std::string out;
    if (from > 0) {
        out = "\u2026";
        ++characters;
    }
    out += before.substr(from) + after.substr(0, to);
    if (to < after.size()) out += "\u2026";
    // Characters, not bytes, stand before the caret.
    return out + '\n' + std::string(characters, ' ') + '^';
}

FilterCompletion completion_of(FieldTable fields, std::string_view text) {
    std::size_t from = text.size();
    while (from > 0 && in_word(text[from - 1])) --from;
    const std::string begun = lower(text.substr(from));
    FilterCompletion out{from, {}};
    const std::string_view before = text.substr(0, from);
    std::vector<std::string> expected;
    try {
        const TableFilter whole(fields, before);
        expected = FilterParser::joiners();
    } catch (const FilterError& error) {
        // What is wrong earlier is mended there.
        if (trimmed(before.substr(error.at())).empty()) expected = error.expected();
    }
    for (const std::string& word : expected) {
        if (word.starts_with(begun) && word != begun) out.words.push_back(word);
    }
    return out;
}

}  // namespace mobbscope
