/// A parsed JSON text whose values know their line.
#pragma once

#include <base/budget.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_set>
#include <variant>
#include <vector>

namespace mobbscope {

struct JsonMember;

/// Values or members that stand one behind the other in a JsonText.
template <class T>
class JsonList {
  public:
    JsonList() = default;
    JsonList(const T* first, std::size_t size) : first_(first), size_(static_cast<std::uint32_t>(size)) {}

    const T* begin() const { return first_; }
    const T* end() const { return first_ + size_; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const T& operator[](std::size_t index) const { return first_[index]; }

  private:
    const T* first_ = nullptr;
    std::uint32_t size_ = 0;  // files have at most 2 GiB
};

/// One value; what it refers to is the JsonText's. Numbers are doubles; objects keep the order of their members.
struct JsonValue {
    using Array = JsonList<JsonValue>;
    using Object = JsonList<JsonMember>;

    std::variant<std::nullptr_t, bool, double, const std::string*, Array, Object> data;
    int line = 0;  ///< where it begins, of a member where its key does; from 1

    /// Null if it is of another type; Held is one of the above, or std::string.
    template <class Held>
    const Held* as() const {
        if constexpr (std::is_same_v<Held, std::string>) {
            const auto* text = std::get_if<const std::string*>(&data);
            return text ? *text : nullptr;
        } else {
            return std::get_if<Held>(&data);
        }
    }
};

struct JsonMember {
    const std::string* name = nullptr;
    JsonValue value;

    const std::string& key() const { return *name; }
};

/// A parsed text: the values, packed for files with millions of them, and each different string once.
class JsonText {
  public:
    const JsonValue& root() const { return root_; }

  private:
    friend class JsonTextBuilder;
    std::unique_ptr<std::pmr::monotonic_buffer_resource> lists_ =
        std::make_unique<std::pmr::monotonic_buffer_resource>();
    std::unordered_set<std::string> strings_;
    JsonValue root_;
    Spent spent_;
};

/// "/key" as it stands in a JSON pointer (RFC 6901), fit for a message: cleaned, and a long key is shortened.
std::string pointer_token(std::string_view key);

/// Parses UTF-8 JSON (RFC 8259). `file` stands for the text in messages. Throws InputError with line and column where
/// the syntax is wrong, a key stands twice in an object, a number is beyond double, values are nested absurdly deep, or
/// all of it takes more than the budget (base/budget.h).
JsonText parse_json(std::string_view text, const std::string& file);

/// A key of the outermost object of a JSON text, or of an object right below it.
struct JsonKey {
    std::string_view name;
    std::string_view in{};  ///< the key of the object that it stands in; empty: the outermost
};

/// What a text that may be JSON begins with, unparsed and unchecked: for telling formats apart.
struct JsonHead {
    std::vector<JsonKey> keys{};  ///< none where the text does not begin with an object
    bool cut_off = false;         ///< the text ends within its object

    /// Whether one of these stands in the outermost object.
    bool has_any(std::initializer_list<std::string_view> names) const;
};

/// Refers to the text.
JsonHead json_head(std::string_view text);

/// The most that JsonPlace::integer can give.
inline constexpr int kMaxInt = std::numeric_limits<int>::max();

/// Refers to the text, to the file's name and to the place it was reached from; all must outlive it.
class JsonPlace {
  public:
    JsonPlace(const JsonText& text, const std::string& file) : value_(&text.root()), file_(&file) {}

    int line() const { return value_->line; }
    const std::string& file() const { return *file_; }
    /// RFC 6901; "" for the whole text.
    std::string pointer() const;
    /// "line 12, /agents/0/clip".
    std::string description() const;
    /// Throws InputError for this place.
    [[noreturn]] void fail(const std::string& message) const;
    /// What `work` gives. A std::invalid_argument that it throws becomes an InputError for this place.
    template <class Work>
    auto attempt(const Work& work) const {
        try {
            return work();
        } catch (const std::invalid_argument& error) {
            fail(error.what());
        }
    }

    bool is_null() const { return value_->as<std::nullptr_t>() != nullptr; }
    bool is_string() const { return value_->as<std::string>() != nullptr; }
    bool is_object() const { return value_->as<JsonValue::Object>() != nullptr; }
    bool is_array() const { return value_->as<JsonValue::Array>() != nullptr; }
    bool is_number() const { return value_->as<double>() != nullptr; }
    bool is_boolean() const { return value_->as<bool>() != nullptr; }

    // Each throws InputError if the value is of another type or out of range.
    double number() const;
    double number(double least, double most) const;
    int integer(int least, int most) const;
    /// How many there are of something: a whole number, at least `least`.
    std::int64_t count(std::int64_t least = 0) const;
    bool boolean() const;
    const std::string& string() const;

    /// Elements of an array (throws InputError if it is none).
    int size() const;
    JsonPlace operator[](int index) const&;
    JsonPlace operator[](int index) const&& = delete;  // the element would refer to a place that is gone
    template <class Visit>
    void each(const Visit& visit) const {
        for (int i = 0; i < size(); ++i) visit((*this)[i]);
    }
    std::vector<std::string> strings() const {
        std::vector<std::string> out;
        each([&](const JsonPlace& element) { out.push_back(element.string()); });
        return out;
    }
    /// An array of exactly `count` elements.
    void require_size(int count, const char* what) const;
    /// An array of a vector's coordinates, each within [-most, most]; `what` says what to give.
    template <class Vector>
    Vector vector(double most, const char* what) const {
        Vector out{};
        require_size(static_cast<int>(out.length()), what);
        for (int i = 0; i < static_cast<int>(out.length()); ++i) out[i] = (*this)[i].number(-most, most);
        return out;
    }

    /// Members of an object (throws InputError if it is none).
    int members() const;
    JsonPlace member(int index) const&;
    JsonPlace member(int index) const&& = delete;
    const std::string& key() const { return *key_; }  ///< of a place reached as a member
    std::optional<JsonPlace> find(std::string_view key) const&;
    std::optional<JsonPlace> find(std::string_view key) const&& = delete;
    JsonPlace require(std::string_view key) const&;
    JsonPlace require(std::string_view key) const&& = delete;
    /// Throws InputError for the first member that is none of these, naming the nearest.
    void allow_only(std::span<const std::string_view> keys) const;
    void allow_only(std::initializer_list<std::string_view> keys) const {
        allow_only(std::span(keys.begin(), keys.end()));
    }

  private:
    JsonPlace(const JsonPlace& parent, const JsonMember& member)
        : value_(&member.value), file_(parent.file_), parent_(&parent), key_(member.name) {}
    JsonPlace(const JsonPlace& parent, const JsonValue& element, int index)
        : value_(&element), file_(parent.file_), parent_(&parent), index_(index) {}

    const JsonValue::Array& array() const;
    const JsonValue::Object& object() const;
    [[noreturn]] void fail_type(const char* expected) const;

    const JsonValue* value_;
    const std::string* file_;
    const JsonPlace* parent_ = nullptr;
    const std::string* key_ = nullptr;  ///< in the parent, if that is an object
    int index_ = 0;                     ///< in the parent, if that is an array
};

}  // namespace mobbscope
