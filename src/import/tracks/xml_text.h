/// XML of tracks and plans, whose elements know their line.
#pragma once

#include <base/budget.h>

#include <pugixml.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace mobbscope {

/// The name of the outermost element of an XML text, or of its beginning; empty where there is none.
std::string_view xml_root(std::string_view text);

class XmlText {
  public:
    /// `file` stands for the file in messages; both must outlive this. Throws InputError naming the line if it is no
    /// XML, or takes more than the budget.
    XmlText(std::string_view text, const std::string& file);

    pugi::xml_node root() const { return document_.document_element(); }

    /// From 1. Fastest from one element on to later ones.
    int line_of(pugi::xml_node element) { return line_at(static_cast<std::size_t>(element.offset_debug())); }

    /// Throws InputError for an element.
    [[noreturn]] void fail(pugi::xml_node element, const std::string& message);

    /// What an attribute says. Throws InputError if it is missing.
    std::string_view text(pugi::xml_node element, const char* attribute);
    /// The same within [-largest, largest].
    double number(pugi::xml_node element, const char* attribute, double largest);

  private:
    int line_at(std::size_t offset);

    std::string_view text_;
    const std::string& file_;
    Spent spent_;
    pugi::xml_document document_;
    std::size_t counted_ = 0;  ///< bytes, whose lines are counted
    int line_ = 1;             ///< there
};

}  // namespace mobbscope
