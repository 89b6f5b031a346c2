/// JSON text, written as it goes: whatever the size, nothing is kept.
#pragma once

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
    void member(std::string_view name, std::initializer_list<double> list) {
        key(name);
        numbers(list);
    }
    /// An array of which `write` writes each element.
    template <class Items, class Write>
    void list(std::string_view name, const Items& items, Write write, Layout layout = Layout::lines) {
        begin_array(name, layout);
        for (const auto& item : items) write(item);
        end_array();
    }
    /// Values on one line.
    template <class Items>
    void values(std::string_view name, const Items& items) {
        list(
            name, items, [this](const auto& item) { value(item); }, Layout::row);
    }
    /// Numbers on one line.
    void numbers(std::initializer_list<double> list) {
        begin_array(Layout::row);
        for (const double number : list) value(number);
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
