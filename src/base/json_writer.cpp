#include <base/json_writer.h>
#include <base/text.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace mobbscope {

namespace {

std::string few_digits(double number) {
    const double rounded = std::abs(number) < 1e6 ? std::round(number * 1e6) / 1e6 : number;
    // Adding zero takes the sign off a negative one.
    return brief(rounded + 0.0);
}

bool is_plain(char c) { return c >= 0x20 && c < 0x7f && c != '"' && c != '\\'; }

}  // namespace

void JsonWriter::key(std::string_view key) {
    separate();
    string(key);
    out_ << ": ";
    after_key_ = true;
}

void JsonWriter::value(double number) {
    if (!std::isfinite(number)) return null();
    separate();
    out_ << (digits_ == Digits::all ? format_double(number) : few_digits(number));
}

void JsonWriter::value(bool boolean) {
    separate();
    out_ << (boolean ? "true" : "false");
}

void JsonWriter::value(std::string_view text) {
    separate();
    string(text);
}

void JsonWriter::null() {
    separate();
    out_ << "null";
}

void JsonWriter::begin(char bracket, Layout layout) {
    separate();
    const bool inside_row = !open_.empty() && open_.back().layout == Layout::row;
    open_.push_back({inside_row ? Layout::row : layout});
    out_ << bracket;
}

void JsonWriter::end(char bracket) {
    const Open closed = open_.back();
    open_.pop_back();
    if (closed.layout == Layout::lines && !closed.empty) break_line();
    out_ << bracket;
    if (open_.empty()) out_ << '\n';
}

void JsonWriter::separate() {
    if (after_key_) {
        after_key_ = false;
        return;
    }
    if (open_.empty()) return;
    Open& container = open_.back();
    if (!container.empty) out_ << ',';
    if (container.layout == Layout::lines) {
        break_line();
    } else if (!container.empty) {
        out_ << ' ';
    }
    container.empty = false;
}

void JsonWriter::break_line() {
    out_ << '\n';
    for (std::size_t i = 0; i < open_.size(); ++i) out_ << "  ";
}

void JsonWriter::string(std::string_view text) {
    if (std::all_of(text.begin(), text.end(), is_plain)) {
        out_ << '"' << text << '"';
    } else {
        out_ << with_escapes(nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    }
}

}  // namespace mobbscope
