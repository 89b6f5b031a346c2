/// JSON text, written as it goes: whatever the size, nothing is kept.
#pragma once

#include <glm/fwd.hpp>

#include <concepts>
#include <initializer_list>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Calls must make one well-formed value: inside an object each value follows its key. A number that is not finite
/// becomes null. Bytes that are not UTF-8 become U+FFFD.
class JsonWriter {
  public:
    /// Whether the elements of a container stand on lines of their own or all on one; what is inside a row is a row
    /// too.
    enum class Layout { lines, row };

    /// Of doubles: 17 significant ones, from which the same double is read; or for people six, and none that stand for
    /// less than a millionth.
    enum class Digits { all, few };

    explicit JsonWriter(std::ostream& out, Digits digits = Digits::all) : out_(out), digits_(digits) {}

    void begin_object(Layout layout = Layout::lines) { begin('{', layout); }
    void begin_object(std::string_view name, Layout layout = Layout::lines) {
        key(name);
        begin_object(layout);
    }
    void end_object() { end('}'); }
    void begin_array(Layout layout = Layout::lines) { begin('[', layout); }
    void begin_array(std::string_view name, Layout layout = Layout::lines) {
        key(name);
        begin_array(layout);
    }
    void end_array() { end(']'); }

    void key(std::string_view key);
    void value(double number);
    template <std::integral Number>
    void value(Number number) {
        separate();
        out_ << std::to_string(number);
    }
    void value(bool boolean);
    void value(std::string_view string);
    void value(const char* string) { value(std::string_view(string)); }
    /// Its coordinates, on one line.
    template <glm::length_t length, class T>
    void value(const glm::vec<length, T>& vector) {
        begin_array(Layout::row);
        for (glm::length_t i = 0; i < length; ++i) value(vector[i]);
        end_array();
    }
    /// Null where there is none.
    template <class T>
    void value(const std::optional<T>& of) {
        of ? value(*of) : null();
    }
    void null();

    template <class T>
    void member(std::string_view name, const T& of) {
        key(name);
        value(of);
    }
    void member(std::string_view name, std::initializer_list<double> list) { values(name, list); }
    /// Members one after the other: a name, its value, the next name ...
    template <class T, class... Rest>
    void members(std::string_view name, const T& of, const Rest&... rest) {
        member(name, of);
        if constexpr (sizeof...(rest) > 0) members(rest...);
    }
    /// An object of such members on one line.
    template <class... NamesAndValues>
    void row(const NamesAndValues&... of) {
        begin_object(Layout::row);
        members(of...);
        end_object();
    }
    /// An array of values on one line.
    template <class... Values>
    void tuple(const Values&... of) {
        begin_array(Layout::row);
        (value(of), ...);
        end_array();
    }
    /// The same of as many as there are.
    template <class Items>
    void values(std::string_view name, const Items& items) {
        begin_array(name, Layout::row);
        for (const auto& item : items) value(item);
        end_array();
    }
    /// An array of which `write` writes each element.
    template <class Items, class Write>
    void list(std::string_view name, const Items& items, Write write) {
        begin_array(name);
        for (const auto& item : items) write(item);
        end_array();
    }

  private:
    struct Open {
        Layout layout;
        bool empty = true;
    };

    void begin(char bracket, Layout layout);
    void end(char bracket);
    /// The comma and the blank or line break that come before an element.
    void separate();
    void break_line();
    void string(std::string_view text);

    std::ostream& out_;
    Digits digits_;
    std::vector<Open> open_;
    bool after_key_ = false;
};

}  // namespace mobbscope
