#include <base/error.h>
#include <base/text.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kLeastShortened = 5;  // characters

constexpr std::size_t kLongestQuote = 60;

constexpr char32_t kMalformed = 0xFFFD;  // what stands for a byte that is

/// Edit distance in bytes; two neighbours that changed places are one edit, as people often type them so.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> above(b.size() + 1), two_above(b.size() + 1), row(b.size() + 1);
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            row[j + 1] = std::min({above[j] + (a[i] == b[j] ? 0 : 1), row[j] + 1, above[j + 1] + 1});
            const bool swapped = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
            if (swapped) row[j + 1] = std::min(row[j + 1], two_above[j - 1] + 1);
        }
        two_above.swap(above);
        above.swap(row);
    }
    return above.back();
}

/// Edit distance of what a message would show: damaged files hold words of any length.
std::size_t distance_to(std::string_view word, std::string_view name) {
    return edit_distance(word.substr(0, kLongestQuote), name.substr(0, kLongestQuote));
}

/// Whether a decimal number beyond double's range is too small for it, not too large.
bool is_tiny(std::string_view number) {
    const std::size_t e = number.find_first_of("eE");
    const std::string_view digits = number.substr(0, e);
    const auto first = static_cast<long long>(digits.find_first_of("123456789"));
    const auto point = static_cast<long long>(std::min(digits.find('.'), digits.size()));
    if (e == std::string_view::npos) return point < first;
    std::string_view power = number.substr(e + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    long long exponent = 0;
    // A power that no integer holds outweighs any number of digits.
    if (std::from_chars(power.data(), power.data() + power.size(), exponent).ec != std::errc{})
        return power.starts_with('-');
    return exponent < first - point;
}

constexpr std::ptrdiff_t kMostDigits = 19;  // fit 64 bits
constexpr std::array<double, kMostDigits> kPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                                       1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};

/// Whether a character steers a terminal, or is not seen and changes how others look.
bool is_misleading(char32_t code) {
    // Controls, and what Unicode calls format characters.
    constexpr std::array<std::pair<char32_t, char32_t>, 11> kRanges{{{0, 0x1f},
                                                                     {0x7f, 0x9f},
                                                                     {0xad, 0xad},
                                                                     {0x61c, 0x61c},
                                                                     {0x180e, 0x180e},
                                                                     {0x200b, 0x200f},
                                                                     {0x2028, 0x202e},
                                                                     {0x2060, 0x206f},
                                                                     {0xfeff, 0xfeff},
                                                                     {0xfff9, 0xfffb},
                                                                     {0xe0000, 0xe007f}}};
    return std::ranges::any_of(kRanges,
                               [code](const auto& range) { return code >= range.first && code <= range.second; });
}

/// As std::to_chars writes it.
std::string digits_of(double value, auto... how) {
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, how...);
    return {buffer, end};
}

/// Where each character begins, and the text's end.
std::vector<std::size_t> beginnings(std::string_view text) {
    const bool utf8 = is_utf8(text);
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_trail_byte = (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80;
        if (!utf8 || !is_trail_byte) out.push_back(i);
    }
    out.push_back(text.size());
    return out;
}

/// Below a millimetre more decimals are needed to say anything, above 10 fewer.
int decimals_of(double value) {
    const double size = std::abs(value);
    const int digits = size > 0 ? static_cast<int>(std::floor(std::log10(size))) : 0;
    return std::clamp(size >= 10 ? 2 : digits < -3 ? 2 - digits : 3, 0, 12);
}

}  // namespace

const char* read_plain_double(const char* at, const char* end, double& value) {
    constexpr std::uint64_t kLargestDigits = std::uint64_t{1} << std::numeric_limits<double>::digits;
    const char* const begin = at;
    std::uint64_t digits = 0;  // what is too large for it is found out by its length
    const auto read_digits = [&] {
        const char* const first = at;
        for (unsigned digit = 0; at != end && (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) <= 9; ++at)
            digits = 10 * digits + digit;
        return at - first;
    };
    const bool is_negative = at != end && *at == '-';
    if (is_negative) ++at;
    const std::ptrdiff_t whole = read_digits();
    std::ptrdiff_t decimals = 0;
    if (at != end && *at == '.') {
        ++at;
        decimals = read_digits();
        if (decimals == 0) return begin;
    }
    if (whole == 0 || whole + decimals > kMostDigits || digits > kLargestDigits) return begin;
    // Both are exact: the quotient is rounded once, to the nearest double.
    const double size = static_cast<double>(digits) / kPowersOfTen[static_cast<std::size_t>(decimals)];
    value = is_negative ? -size : size;
    return at;
}

std::optional<double> parse_double(std::string_view text) {
    // from_chars takes no plus sign and takes "inf" and "nan"; a file of numbers wants it the other way round.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const char* const text_end = text.data() + text.size();
    double value = 0;
    if (!text.empty() && read_plain_double(text.data(), text_end, value) == text_end) return value;
    const auto [end, error] = std::from_chars(text.data(), text_end, value);
    if (end != text_end) return std::nullopt;
    if (error == std::errc::result_out_of_range && is_tiny(text)) return text[0] == '-' ? -0.0 : 0.0;
    if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
    return value;
}

double parse_number_within(std::string_view text, double low, double high) {
    const std::optional<double> value = parse_double(text);
    if (value && *value >= low && *value <= high) return *value;
    throw std::invalid_argument(in_quotes(text) + " is not a number from " + brief(low) + " to " + brief(high));
}

std::optional<int> parse_int(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<std::pair<double, double>> parse_range(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::optional<double> first = parse_double(text.substr(0, colon));
    const std::optional<double> last = parse_double(text.substr(colon + 1));
    if (!first || !last) return std::nullopt;
    return std::pair{*first, *last};
}

std::string format_double(double value) {
    // A JSON reader takes "-0" for the integer 0 and loses the sign.
    if (value == 0 && std::signbit(value)) return "-0.0";
    const double size = std::abs(value);
    return size >= 1e-5 && size < 1e6 ? digits_of(value, std::chars_format::fixed) : digits_of(value);
}

std::string brief(double value) { return digits_of(value, std::chars_format::general, 6); }

std::string figure(double value, int digits) {
    const double size = std::abs(value);
    // What rounds up to one digit more would else become a power.
    return size >= std::pow(10, digits) - 0.5 && size < 1e9 ? formatted("%.0f", value)
                                                            : formatted("%.*g", digits, value);
}

std::string ratio_words(double now, double before) {
    constexpr double kNearlyAsMany = 1.1;
    const auto [less, more] = std::minmax(now, before);
    if (less <= 0 || more / less < kNearlyAsMany) return "";
    return figure(more / less, 2) + (now > before ? " times as many" : " times fewer");
}

std::string to_thousandth(double value) {
    std::string out = formatted("%.3f", value);
    out.erase(out.find_last_not_of('0') + 1);
    if (out.ends_with('.')) out.pop_back();
    return out == "-0" ? "0" : out;
}

std::string with_unit(double value, const char* unit) { return formatted("%.*f %s", decimals_of(value), value, unit); }

std::string proven_words(double value, const char* unit) {
    const double scale = std::pow(10, decimals_of(value));
    // What rounding took from a number whose decimals end here is given back.
    return with_unit(std::floor(value * scale + 1e-6) / scale, unit);
}

std::string formatted(const char* format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    // Of several files clang-tidy knows va_start in the first one alone.
    const int size = std::vsnprintf(nullptr, 0, format, arguments);  // NOLINT(clang-analyzer-valist.Uninitialized)
    std::string out(static_cast<std::size_t>(std::max(0, size)), '\0');
    std::vsnprintf(out.data(), out.size() + 1, format, again);  // NOLINT(clang-analyzer-valist.Uninitialized)
    va_end(again);
    va_end(arguments);
    return out;
}

std::string listed(std::span<const std::string_view> names) {
    std::string out;
    for (const std::string_view name : names) out += (out.empty() ? "" : ", ") + std::string(name);
    return out;
}

std::string either(std::span<const std::string_view> names) {
    if (names.size() < 2) return listed(names);
    return listed(names.first(names.size() - 1)) + " or " + std::string(names.back());
}

char lower_letter(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = lower_letter(c);
    return out;
}

std::string_view trimmed(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

bool is_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = at;
        const char32_t code = read_code_point(text, at);
        const std::string_view bytes = text.substr(begin, at - begin);
        // A longer form than needed is malformed, as are surrogates.
        const std::size_t least = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
        if (bytes.size() != least || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return false;
        if (code == kMalformed && bytes != "\uFFFD") return false;
    }
    return true;
}

char32_t read_code_point(std::string_view utf8, std::size_t& at) {
    const auto lead = static_cast<unsigned char>(utf8[at++]);
    const int following = lead < 0x80 ? 0 : (lead >> 5) == 6 ? 1 : (lead >> 4) == 14 ? 2 : (lead >> 3) == 30 ? 3 : -1;
    if (following < 0) return kMalformed;
    char32_t code = following == 0 ? lead : lead & (0x3Fu >> following);
    for (int k = 0; k < following; ++k) {
        if (at >= utf8.size() || (static_cast<unsigned char>(utf8[at]) >> 6) != 2) return kMalformed;
        code = (code << 6) | (static_cast<unsigned char>(utf8[at++]) & 0x3Fu);
    }
    return code;
}

std::vector<char32_t> code_points(std::string_view utf8) {
    std::vector<char32_t> out;
    for (std::size_t at = 0; at < utf8.size();) out.push_back(read_code_point(utf8, at));
    return out;
}

std::string with_escapes(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = at;
        const char32_t code = read_code_point(text, at);
        if (!is_misleading(code)) {
            out += text.substr(begin, at - begin);
        } else if (code < 0x10000) {
            out += formatted("\\u%04x", static_cast<unsigned>(code));
        } else {
            const auto above = static_cast<unsigned>(code - 0x10000);
            out += formatted("\\u%04x\\u%04x", 0xd800 + (above >> 10), 0xdc00 + (above & 0x3ff));
        }
    }
    return out;
}

std::string cleaned(std::string_view text) {
    if (is_utf8(text)) return with_escapes(text);
    std::string ascii(text);
    for (char& c : ascii) c = static_cast<unsigned char>(c) < 0x80 ? c : '?';
    return with_escapes(ascii);
}

std::string shortened(std::string_view text, std::size_t most) {
    if (text.size() <= most) return std::string(text);
    const std::vector<std::size_t> at = beginnings(text);
    const std::size_t count = at.size() - 1;
    if (count <= most) return std::string(text);
    // Names of one recording differ in their ends as often as in their beginnings.
    const std::size_t tail = (most - 1) / 2;
    const std::size_t head = most - 1 - tail;
    return std::string(text.substr(0, at[head])) + "\u2026" + std::string(text.substr(at[count - tail]));
}

std::string shortened_to_fit(std::string_view text, const std::function<bool(const std::string&)>& fits) {
    std::size_t most = std::max<std::size_t>(text.size(), kLeastShortened);
    if (std::string whole(text); fits(whole)) return whole;
    std::size_t least = kLeastShortened;
    while (least < most) {
        const std::size_t middle = least + (most - least + 1) / 2;
        if (fits(shortened(text, middle))) {
            least = middle;
        } else {
            most = middle - 1;
        }
    }
    return shortened(text, least);
}

std::string in_quotes(std::string_view text) {
    // Of a line of megabytes the middle is not looked at.
    constexpr std::size_t kEnd = 4 * kLongestQuote;
    std::string ends;
    if (text.size() > 2 * kEnd) text = ends.append(text.substr(0, kEnd)).append(text.substr(text.size() - kEnd));
    return "'" + shortened(cleaned(text), kLongestQuote) + "'";
}

std::string did_you_mean(std::string_view word, std::span<const std::string> names) {
    if (names.empty()) return "";
    const std::string& name = nearest(word, names);
    // A word that is wrong in more than half of its letters is another word.
    const bool meant = distance_to(word, name) <= (std::min(word.size(), kLongestQuote) + 1) / 2;
    return meant ? " (did you mean " + in_quotes(name) + "?)" : "";
}

const std::string& nearest(std::string_view word, std::span<const std::string> names) {
    return *std::min_element(names.begin(), names.end(), [word](const std::string& a, const std::string& b) {
        return distance_to(word, a) < distance_to(word, b);
    });
}

std::string bytes_text(std::uintmax_t bytes) {
    const double size = static_cast<double>(bytes);
    if (bytes < 1000) return formatted("%ju B", bytes);
    if (size < 999.5e3) return formatted("%.*f kB", size < 9.95e3 ? 1 : 0, size / 1e3);
    return size < 999.95e6 ? formatted("%.1f MB", size / 1e6) : formatted("%.1f GB", size / 1e9);
}

std::string shell_word(const std::string& word) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + '\'';
}

ScriptLine split_line(std::string_view line) {
    ScriptLine out;
    std::size_t at = 0;
    std::size_t behind_first = line.size();
    while (true) {
        while (at < line.size() && (line[at] == ' ' || line[at] == '\t')) ++at;
        if (at == line.size() || line[at] == '#') {
            if (behind_first < at) out.rest = trimmed(line.substr(behind_first, at - behind_first));
            return out;
        }
        std::string word;
        if (line[at] == '"') {
            const std::size_t close = line.find('"', at + 1);
            if (close == std::string_view::npos) throw std::invalid_argument("a quote is not closed");
            word = line.substr(at + 1, close - at - 1);
            at = close + 1;
        } else {
            const std::size_t begin = at;
            while (at < line.size() && line[at] != ' ' && line[at] != '\t') ++at;
            word = line.substr(begin, at - begin);
        }
        out.words.push_back(std::move(word));
        if (out.words.size() == 1) behind_first = at;
    }
}

std::string at_line(int line) { return "line " + std::to_string(line); }

TextLines::TextLines(std::string_view text, const std::string& file) : rest_(text), file_(file) { check(); }

TextLines::TextLines(TextPieces more, const std::string& file) : file_(file), more_(std::move(more)) {
    take_piece();
    check();
}

void TextLines::check() {
    if (rest_.starts_with("\xff\xfe") || rest_.starts_with("\xfe\xff")) {
        throw InputError(file_, at_line(1), "is UTF-16 text; save it as UTF-8");
    }
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
    if (rest_.find('\n') == std::string_view::npos && rest_.find('\r') != std::string_view::npos) {
        throw InputError(file_, at_line(1), "lines end with carriage returns alone; save it with line feeds");
    }
}

bool TextLines::take_piece() {
    if (!more_) return false;
    buffer_.erase(0, buffer_.size() - rest_.size());
    if (!more_(buffer_)) more_ = nullptr;
    spent_.cover(buffer_.size(), "a line", file_);
    rest_ = buffer_;
    return more_ != nullptr;
}

/// The first line of the rest that ends behind so many bytes of it.
void TextLines::take_line(std::size_t from) {
    std::size_t end = rest_.find('\n', from);
    for (std::size_t known = rest_.size(); end == std::string_view::npos && take_piece(); known = rest_.size())
        end = rest_.find('\n', known);
    whole_ = rest_.substr(0, end);
    if (whole_.ends_with('\r')) whole_.remove_suffix(1);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (whole_.find('\0', std::min(from, whole_.size())) != std::string_view::npos)
        fail("holds a NUL byte; this is not a text file, or a damaged one");
}

bool TextLines::next() {
    do {
        if (rest_.empty() && !take_piece()) return false;
        number_ += 1 + std::exchange(joined_, 0);
        take_line(0);
    } while (line().empty());
    return true;
}

bool TextLines::join() {
    const auto from = static_cast<std::size_t>(rest_.data() - whole_.data());
    rest_ = {whole_.data(), from + rest_.size()};
    const bool is_more = from < rest_.size() || take_piece();
    joined_ += is_more;
    take_line(from);
    return is_more;
}

void TextLines::fail(const std::string& message) const { throw InputError(file_, at_line(number_), message); }

}  // namespace mobbscope
