/// JSON text, written as it goes: whatever the size, nothing is kept.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <ostream>
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
    void end_object() { end('}'); }
    void begin_array(Layout layout = Layout::lines) { begin('[', layout); }
    void end_array() { end(']'); }

    void key(std::string_view key);
    void value(double number);
    void value(std::int64_t number);
    void value(int number) { value(static_cast<std::int64_t>(number)); }
    void value(bool boolean);
    void value(std::string_view string);
    void value(const char* string) { value(std::string_view(string)); }
    void null();

    template <class T>
    void member(std::string_view name, const T& of) {
        key(name);
        value(of);
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
