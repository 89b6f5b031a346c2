/// Kinds of real changes of a picture test, as a fault of the program or of a scene would make them.
#pragma once

#include <base/random.h>
#include <picture_tests/shot.h>
#include <render/drawlist/draw_list.h>
#include <render/image/image.h>

#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace mobbscope::picture_tests {

/// What is drawn, and its picture.
struct Drawn {
    Shot shot;
    std::vector<DrawList> lists;  ///< by panel
    Image picture;
};

template <class Items>
std::size_t pick(const Items& items, Uniform& random) {
    return static_cast<std::size_t>(random.below(static_cast<int>(items.size())));
}

// Each changes what it is given, or returns false where there is nothing of its kind; it says what it did.
using ChangeShot = bool (*)(Shot&, const Drawn& before, Uniform&, std::string& what);
using ChangeList = bool (*)(DrawList&, Uniform&, std::string& what);
using ChangeImage = bool (*)(Image&, const Drawn& before, Uniform&, std::string& what);

struct Kind {
    const char* name;
    std::variant<ChangeShot, ChangeList, ChangeImage> change;
    bool moves = false;  ///< what is drawn; nothing else tells the change
};

std::span<const Kind> kinds_of_change();

}  // namespace mobbscope::picture_tests
