/// Sizes, pictures and questions to draw lists that several tests of src/render share.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/draw_list_json.h>
#include <render/image/image.h>

#include <cstdint>
#include <set>
#include <sstream>
#include <string>

namespace mobbscope {
inline namespace testing {

inline constexpr PictureSize kGoldenSize{640, 360};
inline constexpr PictureSize kSmallSize{320, 240};

inline Image filled(int width, int height, std::uint8_t level, std::uint8_t opacity = 255) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? opacity : level;
    return image;
}

inline std::set<int> who_has_a_disk(const DrawList& list) {
    std::set<int> out;
    for (const DiskInstance& disk : list.disks) out.insert(disk.id.agent);
    return out;
}

inline std::string text_of(const DrawList& list, const IdImage* ids = nullptr) {
    std::ostringstream out;
    write_draw_list(out, list, ids);
    return out.str();
}

}  // namespace testing
}  // namespace mobbscope
