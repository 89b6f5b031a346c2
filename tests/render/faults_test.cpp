// Deliberate faults: each must be told by the picture, and what is no fault must not.
#include <render/image/image_diff.h>
#include <render/pictures/build_draw_list.h>

#include "render/backends.h"
#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

ViewState levels_view() {
    ViewState view;
    view.levels = {1, 1, false};
    view.camera.preset = CameraPreset::free;
    view.camera.yaw_deg = -52;
    view.camera.pitch_deg = 24;
    return view;
}

ViewState query_view() {
    ViewState view = levels_view();
    view.query = 0;
    return view;
}

DrawList list_of(const ViewState& view) { return build_draw_list(testing::hit_scene(), view, kGoldenSize); }

/// Every colour of the list.
void recolour(DrawList& list, const std::function<void(Rgba&)>& change) {
    for (DiskInstance& disk : list.disks.edit()) change(disk.color);
    for (BoxInstance& box : list.boxes) change(box.fill), change(box.edge);
    for (LineInstance& line : list.lines) change(line.color);
    for (OverlayLine& line : list.overlay_lines) change(line.color);
    for (TextRun& text : list.texts) change(text.color);
    for (LegendEntry& entry : list.legend) change(entry.color), change(entry.fill);
    for (std::vector<OverlayPanel>* panels : {&list.panels, &list.marks}) {
        for (OverlayPanel& panel : *panels) change(panel.fill), change(panel.border);
    }
}

void swap_hit_and_miss(DrawList& list) {
    recolour(list, [&](Rgba& color) {
        const bool hit = with_alpha(color, 1) == list.palette.hit;
        const bool miss = with_alpha(color, 1) == list.palette.separated;
        if (hit || miss) color = with_alpha(hit ? list.palette.separated : list.palette.hit, color.a);
    });
}

void enlarge(BoxInstance& box) {
    for (glm::vec3& extent : box.extents) extent *= 1.02f;
}

TextRun& label(DrawList& list, const std::string& text) {
    const auto found =
        std::find_if(list.texts.begin(), list.texts.end(), [&](const TextRun& run) { return run.text == text; });
    if (found == list.texts.end()) throw std::invalid_argument("there is no label " + text);
    return *found;
}

DrawList changed(DrawList list, const std::function<void(DrawList&)>& change) {
    change(list);
    return list;
}

struct Fault {
    const char* name;
    DrawList right;
    DrawList wrong;
};

std::vector<Fault> faults() {
    const DrawList levels = list_of(levels_view());
    const DrawList query = list_of(query_view());
    ViewState leaves = levels_view();
    leaves.levels = {0, 0, true};
    const DrawList fine = list_of(leaves);
    ViewState deeper = levels_view();
    deeper.levels = {2, 2, false};
    ViewState turned = levels_view();
    turned.camera.yaw_deg += 0.5;
    ViewState raised = levels_view();
    raised.camera.pitch_deg += 0.5;
    ViewState wider = levels_view();
    wider.camera.fov_deg += 0.5;
    return {
        {"a box 2 % too large", levels, changed(levels, [](DrawList& list) { enlarge(list.boxes[0]); })},
        {"a leaf 2 % too large", fine, changed(fine, [](DrawList& list) { enlarge(list.boxes[3]); })},
        {"one level off", levels, list_of(deeper)},
        {"a missing disk", levels, changed(levels, [](DrawList& list) { list.disks.edit().pop_back(); })},
        {"a missing disk inside", levels,
         changed(levels, [](DrawList& list) { list.disks.edit().erase(list.disks.begin() + 18); })},
        {"colours of hit and miss swapped", query, changed(query, swap_hit_and_miss)},
        {"a label 2 pixels aside", levels, changed(levels, [](DrawList& list) { label(list, "A").baseline.x += 2; })},
        {"camera turned by half a degree", levels, list_of(turned)},
        {"camera raised by half a degree", levels, list_of(raised)},
        {"camera wider by half a degree", levels, list_of(wider)},
    };
}

class FaultsTest : public testing::OnEachBackend {};

TEST_P(FaultsTest, EveryOneIsInThePicture) {
    for (const Fault& fault : faults()) {
        const ImageDiff told = diff(renderer().draw(fault.wrong), renderer().draw(fault.right));
        EXPECT_FALSE(told.passes) << fault.name;
        std::cout << fault.name << ": " << diff_sentence(told) << '\n';
    }
}

TEST_P(FaultsTest, AnotherOrderIsNone) {
    std::mt19937 random(11);
    for (const ViewState& view : {levels_view(), query_view()}) {
        const DrawList right = list_of(view);
        const Image picture = renderer().draw(right);
        for (int round = 0; round < 3; ++round) {
            DrawList list = right;
            std::shuffle(list.disks.edit().begin(), list.disks.edit().end(), random);
            std::shuffle(list.boxes.begin(), list.boxes.end(), random);
            std::shuffle(list.lines.begin(), list.lines.end(), random);
            EXPECT_EQ(text_of(list), text_of(right));
            const ImageDiff told = diff(renderer().draw(list), picture);
            EXPECT_TRUE(told.passes) << diff_sentence(told);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, FaultsTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

TEST(Faults, AnotherBackendIsNone) {
    const std::unique_ptr<Renderer> osmesa = testing::open_or_skip(Backend::osmesa);
    if (!osmesa) return;
    const std::unique_ptr<Renderer> egl = testing::open_or_skip(Backend::egl);
    if (!egl) return;
    for (const ViewState& view : {levels_view(), query_view()}) {
        const DrawList list = list_of(view);
        const ImageDiff told = diff(osmesa->draw(list), egl->draw(list));
        EXPECT_TRUE(told.passes) << diff_sentence(told);
    }
}

}  // namespace
}  // namespace mobbscope
