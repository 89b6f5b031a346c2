#include <base/error.h>
#include <base/text.h>
#include <import/bvh/bvh_scanner.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace mobbscope {

namespace {

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

char lower_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// A number that no double holds: too near to 0, which is 0, or too large.
double tiny_or_huge(std::string_view number) {
    const std::size_t exponent = number.find_first_of("eE");
    const bool is_tiny = exponent != std::string_view::npos && number.substr(exponent + 1).starts_with('-');
    return is_tiny ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

void BvhScanner::fail(int line, const std::string& message) const {
    throw InputError(file_, "line " + std::to_string(line), message);
}

void BvhScanner::begin() {
    const std::string_view text = between(at_, end_);
    if (text.empty()) fail("the file is empty; a BVH begins with HIERARCHY");
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) fail("is UTF-16 text; save it as UTF-8");
    if (text.starts_with("\xef\xbb\xbf")) at_ += 3;
}

void BvhScanner::skip_space() {
    for (skip_blanks(); at_ != end_ && is_line_end(*at_); skip_blanks()) {
        if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
        ++at_;
        ++line_;
    }
}

std::string_view BvhScanner::next_word() {
    skip_space();
    const char* const begin = at_;
    const auto is_brace = [](char c) { return c == '{' || c == '}'; };
    if (at_ != end_ && is_brace(*at_)) {
        ++at_;
    } else {
        while (!at_line_end() && !is_blank(*at_) && !is_brace(*at_)) ++at_;
    }
    return between(begin, at_);
}

std::string_view BvhScanner::rest_of_line() {
    const char* const begin = at_;
    at_ = std::find_if(at_, end_, is_line_end);
    return trimmed(between(begin, at_));
}

std::string_view BvhScanner::rest_before_brace() {
    const std::string_view rest = rest_of_line();
    if (!rest.ends_with('{')) return rest;
    at_ = rest.data() + rest.size() - 1;
    return trimmed(rest.substr(0, rest.size() - 1));
}

double BvhScanner::number() {
    // from_chars takes no plus sign.
    const char* const begin = at_ + (*at_ == '+' && at_ + 1 != end_ && at_[1] != '-' ? 1 : 0);
    double value = 0;
    const auto [after, error] = std::from_chars(begin, end_, value);
    const bool is_whole = after == end_ || is_blank(*after) || is_line_end(*after) || *after == '}';
    if (error == std::errc::invalid_argument || !is_whole || !std::isfinite(value)) fail_number();
    if (error == std::errc::result_out_of_range) value = tiny_or_huge(between(begin, after));
    if (std::abs(value) > kMaxBvhValue) fail(in_quotes(next_word()) + " is beyond 1e9; the file is damaged");
    at_ = after;
    return value;
}

void BvhScanner::fail_number() {
    const std::string_view word = next_word();
    const bool has_comma = word.find(',') != std::string_view::npos;
    fail(in_quotes(word) + " is no finite number" +
         (has_comma ? "; write decimals with a point and separate numbers with blanks" : "; write it like 12.5"));
}

std::string found(std::string_view word) { return word.empty() ? "the file ends" : "there is " + in_quotes(word); }

bool is_keyword(std::string_view word, std::string_view lower_keyword) {
    return std::equal(word.begin(), word.end(), lower_keyword.begin(), lower_keyword.end(),
                      [](char a, char b) { return lower_letter(a) == b; });
}

}  // namespace mobbscope
