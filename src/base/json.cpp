#include <base/error.h>
#include <base/json.h>
#include <base/text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace mobbscope {

namespace {

// A capture nests seven deep. Destroying a value recurses, so depth must be bounded.
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kLongestComplaint = 160;
constexpr std::size_t kLongestToken = 80;

/// Reads characters and tells which was read last: the parser keeps no positions of its own for values.
class TrackedIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    TrackedIterator(const char* current, const char** last_read) : current_(current), last_read_(last_read) {}
    reference operator*() const { return *current_; }
    TrackedIterator& operator++() {
        *last_read_ = current_++;
        return *this;
    }
    TrackedIterator operator++(int) {
        TrackedIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const TrackedIterator& other) const { return current_ == other.current_; }
    bool operator!=(const TrackedIterator& other) const { return current_ != other.current_; }

  private:
    const char* current_;
    const char** last_read_;
};

/// Turns offsets that never decrease into lines and columns, counting each newline once.
class LineCounter {
  public:
    explicit LineCounter(std::string_view text) : position_(text.data()), line_begin_(text.data()) {}

    /// The line of `position`; a newline belongs to the line that it ends.
    int line(const char* position) {
        for (; position_ < position; ++position_) {
            if (*position_ == '\n') {
                ++line_;
                line_begin_ = position_ + 1;
            }
        }
        return line_;
    }
    /// From 1, of the same position.
    std::ptrdiff_t column(const char* position) const { return position - line_begin_ + 1; }

  private:
    const char* position_;
    const char* line_begin_;
    int line_ = 1;
};

/// The parser's callbacks: each returns false to stop. Containers that are open stand on a stack.
class ValueBuilder : public nlohmann::json_sax<nlohmann::json> {
  public:
    ValueBuilder(std::string_view text, const std::string& file, const char* const* last_read)
        : file_(file), last_read_(last_read), lines_(text) {}

    JsonValue take() { return std::move(root_); }

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return put(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return put(static_cast<double>(value)); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_array(std::size_t) override { return open(JsonValue::Array{}); }
    bool end_array() override { return close(); }
    bool start_object(std::size_t) override { return open(JsonValue::Object{}); }
    bool key(string_t& value) override {
        key_ = std::move(value);
        key_line_ = line();
        return true;
    }
    bool end_object() override {
        refuse_duplicates(std::get<JsonValue::Object>(open_.back().value.data));
        return close();
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
        fail(plain(error));
    }

  private:
    /// A container that is being filled, and the key it will have in its parent.
    struct Open {
        JsonValue value;
        std::string key;
        int key_line;
    };

    int line() { return lines_.line(*last_read_); }

    [[noreturn]] void fail(const std::string& message) {
        const std::string at = "line " + std::to_string(line());
        throw InputError(file_, at + ", column " + std::to_string(lines_.column(*last_read_)), message);
    }

    /// The library's message without its names and positions.
    static std::string plain(const nlohmann::json::exception& error) {
        if (error.id == 406) return "the number is too large for a double; check it";
        std::string text = error.what();
        for (const std::string_view before : {"] ", "parse error at ", ": ", "syntax error while parsing ", " - "}) {
            const std::size_t end = text.find(before);
            if (end != std::string::npos) text.erase(0, end + before.size());
        }
        return "this is not JSON: " + shortened(text, kLongestComplaint);
    }

    template <class T>
    bool put(T&& data) {
        attach({std::forward<T>(data), line()}, std::move(key_), key_line_);
        return true;
    }

    bool open(auto container) {
        if (open_.size() == kMaxDepth)
            fail("values are nested more than " + std::to_string(kMaxDepth) + " deep; no scene is");
        open_.push_back({{std::move(container), line()}, std::move(key_), key_line_});
        return true;
    }

    bool close() {
        Open done = std::move(open_.back());
        open_.pop_back();
        attach(std::move(done.value), std::move(done.key), done.key_line);
        return true;
    }

    void attach(JsonValue value, std::string key, int key_line) {
        if (open_.empty()) {
            root_ = std::move(value);
        } else if (auto* array = std::get_if<JsonValue::Array>(&open_.back().value.data)) {
            array->push_back(std::move(value));
        } else {
            std::get<JsonValue::Object>(open_.back().value.data)
                .push_back({std::move(key), key_line, std::move(value)});
        }
    }

    void refuse_duplicates(const JsonValue::Object& object) {
        std::vector<const JsonMember*> sorted;
        sorted.reserve(object.size());
        for (const JsonMember& member : object) sorted.push_back(&member);
        std::sort(sorted.begin(), sorted.end(), [](const JsonMember* a, const JsonMember* b) {
            return a->key != b->key ? a->key < b->key : a->line < b->line;
        });
        const auto twice = std::adjacent_find(
            sorted.begin(), sorted.end(), [](const JsonMember* a, const JsonMember* b) { return a->key == b->key; });
        if (twice == sorted.end()) return;
        const JsonMember& second = **std::next(twice);
        throw InputError(file_, "line " + std::to_string(second.line) + ", " + pointer() + pointer_token(second.key),
                         "the key " + in_quotes(second.key) + " stands twice, first in line " +
                             std::to_string((*twice)->line) + "; remove one");
    }

    /// Of the container that is being filled.
    std::string pointer() const {
        std::string out;
        for (std::size_t i = 1; i < open_.size(); ++i) {
            const auto* array = std::get_if<JsonValue::Array>(&open_[i - 1].value.data);
            out += array ? "/" + std::to_string(array->size()) : pointer_token(open_[i].key);
        }
        return out;
    }

    const std::string& file_;
    const char* const* last_read_;
    LineCounter lines_;
    std::vector<Open> open_;
    std::string key_;
    int key_line_ = 0;
    JsonValue root_;
};

}  // namespace

std::string pointer_token(std::string_view key) {
    std::string out = "/";
    for (const char c : shortened(key, kLongestToken)) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
}

JsonValue parse_json(std::string_view text, const std::string& file) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
        throw InputError(file, "line 1", "is UTF-16 text; save it as UTF-8");
    }
    // The parser would take a NUL for the end and leave the rest unread.
    if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
        throw InputError(file, "line " + std::to_string(line),
                         "holds a NUL byte; this is no text file, or a damaged one");
    }
    const char* last_read = text.data();
    ValueBuilder builder(text, file, &last_read);
    nlohmann::json::sax_parse(TrackedIterator(text.data(), &last_read),
                              TrackedIterator(text.data() + text.size(), &last_read), &builder);
    return builder.take();
}

std::string JsonPlace::pointer() const {
    if (!parent_) return "";
    return parent_->pointer() + (key_ ? pointer_token(*key_) : "/" + std::to_string(index_));
}

std::string JsonPlace::description() const {
    const std::string at = "line " + std::to_string(line_);
    return parent_ ? at + ", " + pointer() : at;
}

void JsonPlace::fail(const std::string& message) const { throw InputError(*file_, description(), message); }

void JsonPlace::fail_type(const char* expected) const {
    constexpr std::array<const char*, 6> kTypes{"null",     "true or false", "a number",
                                                "a string", "an array",      "an object"};
    fail(std::string("expected ") + expected + ", found " + kTypes[value_->data.index()]);
}

double JsonPlace::number() const {
    if (const double* number = std::get_if<double>(&value_->data)) return *number;
    fail_type("a number");
}

double JsonPlace::number(double least, double most) const {
    const double value = number();
    if (value >= least && value <= most) return value;
    fail(short_double(value) + " is out of range; give " + short_double(least) + " to " + short_double(most));
}

int JsonPlace::integer(int least, int most) const {
    const double value = number();
    if (value >= least && value <= most && value == std::floor(value)) return static_cast<int>(value);
    fail(short_double(value) + " is out of range; give a whole number from " + std::to_string(least) + " to " +
         std::to_string(most));
}

bool JsonPlace::boolean() const {
    if (const bool* boolean = std::get_if<bool>(&value_->data)) return *boolean;
    fail_type("true or false");
}

const std::string& JsonPlace::string() const {
    if (const std::string* string = std::get_if<std::string>(&value_->data)) return *string;
    fail_type("a string");
}

const JsonValue::Array& JsonPlace::array() const {
    if (const auto* array = std::get_if<JsonValue::Array>(&value_->data)) return *array;
    fail_type("an array");
}

const JsonValue::Object& JsonPlace::object() const {
    if (const auto* object = std::get_if<JsonValue::Object>(&value_->data)) return *object;
    fail_type("an object");
}

int JsonPlace::size() const { return static_cast<int>(array().size()); }

JsonPlace JsonPlace::operator[](int index) const& { return {*this, array()[static_cast<std::size_t>(index)], index}; }

void JsonPlace::require_size(int count, const char* what) const {
    if (size() != count) fail("has " + std::to_string(size()) + " elements; give " + what);
}

int JsonPlace::members() const { return static_cast<int>(object().size()); }

JsonPlace JsonPlace::member(int index) const& { return {*this, object()[static_cast<std::size_t>(index)]}; }

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const& {
    for (const JsonMember& member : object()) {
        if (member.key == key) return JsonPlace(*this, member);
    }
    return std::nullopt;
}

JsonPlace JsonPlace::require(std::string_view key) const& {
    if (std::optional<JsonPlace> found = find(key)) return *found;
    fail("the key '" + std::string(key) + "' is missing; add it");
}

void JsonPlace::allow_only(std::span<const std::string_view> keys) const {
    for (const JsonMember& member : object()) {
        if (std::find(keys.begin(), keys.end(), member.key) != keys.end()) continue;
        const std::vector<std::string> names(keys.begin(), keys.end());
        JsonPlace(*this, member)
            .fail("unknown key " + in_quotes(member.key) + "; the nearest known key is " +
                  in_quotes(nearest(member.key, names)));
    }
}

}  // namespace mobbscope
