#include <render/text/labels.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

LabelRequest label_at(const std::string& text, glm::vec2 anchor) {
    LabelRequest request;
    request.text = text;
    request.anchor = anchor;
    request.directions = {{0, -1}, {1, 0}, {-1, 0}, {0, 1}};
    return request;
}

TEST(LabelLayout, LabelsNeitherOverlapNorLeaveThePicture) {
    LabelLayout layout(PictureSize{200, 120});
    DrawList list;
    int placed = 0;
    for (int i = 0; i < 60; ++i) {
        const glm::vec2 anchor(static_cast<float>((i * 37) % 200), static_cast<float>((i * 53) % 120));
        placed += layout.place(label_at("label " + std::to_string(i), anchor), list) ? 1 : 0;
    }
    EXPECT_GT(placed, 5);
    EXPECT_EQ(list.texts.size(), static_cast<std::size_t>(placed));
    const Rect picture{{0, 0}, {200, 120}};
    for (std::size_t i = 0; i < list.texts.size(); ++i) {
        EXPECT_TRUE(picture.contains(list.texts[i].box));
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(list.texts[i].box.overlaps(list.texts[j].box));
    }
}

TEST(LabelLayout, ReservedPlacesStayFree) {
    LabelLayout layout(PictureSize{200, 120});
    layout.reserve({{0, 0}, {200, 120}});
    DrawList list;
    EXPECT_FALSE(layout.place(label_at("x", {100, 60}), list));
    EXPECT_TRUE(list.texts.empty());
}

}  // namespace
}  // namespace mobbscope
