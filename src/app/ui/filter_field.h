/// A field for a filter of a query's events.
#pragma once

#include <app/ui/ui.h>
#include <scene/event_filter.h>

#include <functional>
#include <optional>
#include <string>

namespace mobbscope::app {

struct FilterField {
    std::string mark;
    std::string now{};  ///< the filter that holds; empty: none
    const char* hint = "";
    std::function<std::string(const EventFilter&)> hits;  ///< "12 of 830": said beside it, before it is applied
    float right = 0;                                      ///< pixels of its line that are left to what comes next
};

/// The field, which has the keys where Keys::field asks for that, and how many events pass what is typed. Tab takes
/// what may follow, Up and Down choose among that; Enter gives the filter, of which an empty one is none, and Escape
/// takes all back.
std::optional<std::string> event_filter_field(Ui& ui, const FilterField& field);

/// Below the field, as wide as there is room: the filter in words, or where it is wrong and why; while it is typed,
/// what may follow.
void filter_words(Ui& ui, const FilterField& field);

}  // namespace mobbscope::app
