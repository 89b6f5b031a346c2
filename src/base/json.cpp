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

// A capture nests seven deep. Whoever goes through values recurses, so depth must be bounded.
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kLongestComplaint = 160;
constexpr std::size_t kLongestToken = 80;
// Bytes of memory: an object becomes something of the program, such as a query; a string stands in a table.
constexpr std::size_t kOfObject = 512;
constexpr std::size_t kOfString = 128;

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

}  // namespace

/// The parser's callbacks: each returns false to stop. Containers that are open stand on a stack, and on
/// another what they hold so far.
class JsonTextBuilder : public nlohmann::json_sax<nlohmann::json> {
  public:
    JsonTextBuilder(std::string_view text, const std::string& file, const char* const* last_read)
        : file_(file), last_read_(last_read), lines_(text) {}

    JsonText take() { return std::move(out_); }

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return put(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return put(static_cast<double>(value)); }
    bool string(string_t& value) override { return put(kept(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_array(std::size_t) override { return open(false); }
    bool end_array() override {
        return close<JsonValue>([](const JsonMember& held) { return held.value; });
    }
    bool start_object(std::size_t) override { return open(true); }
    bool key(string_t& value) override {
        key_ = kept(value);
        key_line_ = line();
        return true;
    }
    bool end_object() override {
        refuse_duplicates();
        return close<JsonMember>([](const JsonMember& held) { return held; });
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
        fail(plain(error));
    }

  private:
    /// A container that is being filled.
    struct Open {
        bool is_object;
        const std::string* key;  ///< that it will have in its parent
        int line;
        std::size_t first;  ///< of what it holds
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

    /// The string as the text keeps it.
    const std::string* kept(string_t& string) {
        const std::size_t size = string.size();
        const auto [at, is_new] = out_.strings_.insert(std::move(string));
        if (is_new) spend(size + kOfString);
        return &*at;
    }

    void spend(std::size_t bytes) {
        used_ += bytes;
        out_.spent_.cover(used_, "its JSON", file_);
    }

    bool in_object() const { return !open_.empty() && open_.back().is_object; }

    bool put(auto data) {
        attach({data, in_object() ? key_line_ : line()}, key_);
        return true;
    }

    bool open(bool is_object) {
        if (open_.size() == kMaxDepth)
            fail("values are nested more than " + std::to_string(kMaxDepth) + " deep; no scene is");
        open_.push_back({is_object, key_, in_object() ? key_line_ : line(), held_.size()});
        return true;
    }

    /// What the last container holds becomes a list of its own.
    template <class T>
    bool close(T (*part)(const JsonMember&)) {
        const Open done = open_.back();
        open_.pop_back();
        const auto first = held_.begin() + static_cast<std::ptrdiff_t>(done.first);
        const auto size = static_cast<std::size_t>(held_.end() - first);
        spend(size * sizeof(T) + (done.is_object ? kOfObject : 0));
        T* list = std::pmr::polymorphic_allocator<T>(out_.lists_.get()).allocate(size);
        for (std::size_t i = 0; i < size; ++i) std::construct_at(list + i, part(first[static_cast<std::ptrdiff_t>(i)]));
        held_.erase(first, held_.end());
        attach({JsonList<T>(list, size), done.line}, done.key);
        return true;
    }

    void attach(JsonValue value, const std::string* key) {
        if (open_.empty()) {
            out_.root_ = value;
        } else {
            held_.push_back({key, value});
            // As it grows there are two of it.
            if (held_.size() > most_held_) {
                most_held_ = held_.capacity();
                spend(most_held_ * sizeof(JsonMember));
            }
        }
    }

    void refuse_duplicates() {
        sorted_.clear();
        for (std::size_t i = open_.back().first; i < held_.size(); ++i) sorted_.push_back(&held_[i]);
        // Those that stand behind others in the text stand behind them here too.
        std::ranges::sort(sorted_, [](const JsonMember* a, const JsonMember* b) {
            return a->name != b->name ? a->key() < b->key() : a < b;
        });
        const auto twice = std::ranges::adjacent_find(sorted_, {}, &JsonMember::name);
        if (twice == sorted_.end()) return;
        const JsonMember& second = **std::next(twice);
        throw InputError(file_,
                         "line " + std::to_string(second.value.line) + ", " + pointer() + pointer_token(second.key()),
                         "the key " + in_quotes(second.key()) + " is given twice, first in line " +
                             std::to_string((*twice)->value.line) + "; remove one");
    }

    /// Of the container that is being filled.
    std::string pointer() const {
        std::string out;
        for (std::size_t i = 1; i < open_.size(); ++i) {
            const std::size_t index = open_[i].first - open_[i - 1].first;
            out += open_[i - 1].is_object ? pointer_token(*open_[i].key) : "/" + std::to_string(index);
        }
        return out;
    }

    const std::string& file_;
    const char* const* last_read_;
    LineCounter lines_;
    std::vector<Open> open_;
    std::vector<JsonMember> held_;  ///< of all that are open; of elements of arrays only the value counts
    const std::string* key_ = nullptr;
    int key_line_ = 0;
    std::vector<const JsonMember*> sorted_;
    std::size_t used_ = 0;       ///< bytes
    std::size_t most_held_ = 0;  ///< that were paid for
    JsonText out_;
};

std::string pointer_token(std::string_view key) {
    std::string out = "/";
    for (const char c : shortened(cleaned(key), kLongestToken))
        out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
}

JsonText parse_json(std::string_view text, const std::string& file) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
        throw InputError(file, "line 1", "is UTF-16 text; save it as UTF-8");
    }
    // The parser would take a NUL for the end and leave the rest unread.
    if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
        throw InputError(file, "line " + std::to_string(line),
                         "holds a NUL byte; this is not a text file, or a damaged one");
    }
    const char* last_read = text.data();
    JsonTextBuilder builder(text, file, &last_read);
    nlohmann::json::sax_parse(TrackedIterator(text.data(), &last_read),
                              TrackedIterator(text.data() + text.size(), &last_read), &builder);
    return builder.take();
}

bool JsonHead::has_any(std::initializer_list<std::string_view> names) const {
    return std::ranges::any_of(
        keys, [&](const JsonKey& key) { return key.in.empty() && std::ranges::find(names, key.name) != names.end(); });
}

JsonHead json_head(std::string_view text) {
    JsonHead out;
    const std::size_t first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
    if (first == std::string_view::npos || text[first] != '{') return out;
    int depth = 0;
    std::string_view in;      // the key at depth 1 that what stands here belongs to
    std::string_view string;  // the last one
    for (std::size_t i = first; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            const std::size_t begin = i + 1;
            for (++i; i < text.size() && text[i] != '"'; ++i) {
                if (text[i] == '\\') ++i;
            }
            string = text.substr(begin, i - begin);
        } else if (c == '{' || c == '[') {
            ++depth;
        } else if (c == '}' || c == ']') {
            --depth;
        } else if (c == ':' && depth == 1) {
            in = string;
            out.keys.push_back({in});
        } else if (c == ':' && depth == 2) {
            out.keys.push_back({string, in});
        }
    }
    out.cut_off = depth > 0;
    return out;
}

std::string JsonPlace::pointer() const {
    if (!parent_) return "";
    return parent_->pointer() + (key_ ? pointer_token(*key_) : "/" + std::to_string(index_));
}

std::string JsonPlace::description() const {
    const std::string at = "line " + std::to_string(line());
    return parent_ ? at + ", " + pointer() : at;
}

void JsonPlace::fail(const std::string& message) const { throw InputError(*file_, description(), message); }

void JsonPlace::fail_type(const char* expected) const {
    constexpr std::array<const char*, 6> kTypes{"null",     "true or false", "a number",
                                                "a string", "an array",      "an object"};
    fail(std::string("expected ") + expected + ", found " + kTypes[value_->data.index()]);
}

double JsonPlace::number() const {
    if (const double* number = value_->as<double>()) return *number;
    fail_type("a number");
}

double JsonPlace::number(double least, double most) const {
    const double value = number();
    if (value >= least && value <= most) return value;
    fail(format_double(value) + " is out of range; give " + format_double(least) + " to " + format_double(most));
}

int JsonPlace::integer(int least, int most) const {
    const double value = number();
    if (value >= least && value <= most && value == std::floor(value)) return static_cast<int>(value);
    fail(format_double(value) + " is out of range; give a whole number from " + std::to_string(least) + " to " +
         std::to_string(most));
}

std::int64_t JsonPlace::count(std::int64_t least) const {
    constexpr std::int64_t kMost = 9007199254740992;  // beyond, doubles are not all whole numbers
    const double value = number();
    if (value >= static_cast<double>(least) && value <= static_cast<double>(kMost) && value == std::floor(value))
        return static_cast<std::int64_t>(value);
    fail(format_double(value) + " is out of range; give a whole number from " + std::to_string(least) + " to " +
         std::to_string(kMost));
}

bool JsonPlace::boolean() const {
    if (const bool* boolean = value_->as<bool>()) return *boolean;
    fail_type("true or false");
}

const std::string& JsonPlace::string() const {
    if (const std::string* string = value_->as<std::string>()) return *string;
    fail_type("a string");
}

const JsonValue::Array& JsonPlace::array() const {
    if (const auto* array = value_->as<JsonValue::Array>()) return *array;
    fail_type("an array");
}

const JsonValue::Object& JsonPlace::object() const {
    if (const auto* object = value_->as<JsonValue::Object>()) return *object;
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
        if (member.key() == key) return JsonPlace(*this, member);
    }
    return std::nullopt;
}

JsonPlace JsonPlace::require(std::string_view key) const& {
    if (std::optional<JsonPlace> found = find(key)) return *found;
    fail("the key '" + std::string(key) + "' is missing; add it");
}

void JsonPlace::allow_only(std::span<const std::string_view> keys) const {
    for (const JsonMember& member : object()) {
        if (std::find(keys.begin(), keys.end(), member.key()) != keys.end()) continue;
        const std::vector<std::string> names(keys.begin(), keys.end());
        JsonPlace(*this, member)
            .fail("unknown key " + in_quotes(member.key()) + "; the nearest known key is " +
                  in_quotes(nearest(member.key(), names)));
    }
}

}  // namespace mobbscope
