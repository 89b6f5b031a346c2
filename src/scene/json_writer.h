/// JSON text, written as it goes: whatever the size, nothing is kept.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <ostream>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Calls must make one well-formed value: inside an object each value follows its key. Doubles have 17 significant
/// digits; a number that is not finite becomes null. Bytes that are not UTF-8 become U+FFFD.
class JsonWriter {
  public:
    /// Whether the elements of a container stand on lines of their own or all on one; what is inside a row is a row
    /// too.
    enum class Layout { lines, row };

    explicit JsonWriter(std::ostream& out) : out_(out) {}

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
    std::vector<Open> open_;
    bool after_key_ = false;
};

}  // namespace mobbscope
