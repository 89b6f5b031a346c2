// Caption, legend and the floor's map: over the scene, in their corners, folded or not.
#include "render/pictures.h"
#include "render/scenes.h"

#include <render/layout/overlays.h>
#include <render/pictures/build_draw_list.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

const std::vector<PictureSize> kSizes{{640, 360}, {850, 560}, {1280, 720}};

/// At a hit, with a time cursor: all three overlays, and the longest legend.
ViewState busy_view() {
    ViewState view;
    view.query = 0;
    view.time = 1;
    view.past = Past::all;
    return view;
}

const Overlay* overlay(const DrawList& list, Overlay::Kind kind) {
    const auto at = std::ranges::find(list.overlays, kind, &Overlay::kind);
    return at == list.overlays.end() ? nullptr : &*at;
}

/// The texts on a panel, from its top to its bottom.
std::vector<std::string> words_on(const DrawList& list, const Rect& rect) {
    std::vector<std::string> out;
    for (const TextRun& run : list.texts) {
        if (rect.contains(run.box)) out.push_back(run.text);
    }
    return out;
}

void expect_apart(const DrawList& list) {
    const Rect picture{glm::vec2(0), glm::vec2(list.size.width, list.size.height)};
    for (std::size_t i = 0; i < list.overlays.size(); ++i) {
        const Overlay& one = list.overlays[i];
        EXPECT_TRUE(picture.contains(one.rect));
        EXPECT_TRUE(!one.fold || one.rect.contains(*one.fold));
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(one.rect.overlaps(list.overlays[j].rect));
        // Nothing else is written there, and what is written there stays on the panel.
        for (const TextRun& run : list.texts) {
            if (run.box.overlaps(one.rect.grown(-1))) {
                EXPECT_TRUE(one.rect.contains(run.box)) << run.text;
            }
        }
    }
}

TEST(Overlays, StandInTheirCornersWithoutOverlap) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view = busy_view();
    const int last = record(fitted, fitted.queries()[0]).trace.size() - 1;
    for (const PictureSize size : kSizes) {
        for (int step = 0; step <= last; ++step) {
            view.step = {Step::Unit::event, static_cast<double>(step)};
            const DrawList list = build_draw_list(fitted, view, size);
            ASSERT_EQ(list.overlays.size(), 3u);
            expect_apart(list);
            // How wide words are depends on the font's version: a small picture may have no room for the caption.
            for (const Overlay& one : list.overlays) {
                EXPECT_TRUE(!one.folded || (one.no_room && size.width < 1280)) << size.width;
            }
            const float margin = overlay(list, Overlay::Kind::caption)->rect.min.x;
            const auto right = static_cast<float>(size.width) - margin;
            const auto bottom = static_cast<float>(size.height) - margin;
            EXPECT_EQ(overlay(list, Overlay::Kind::caption)->rect.min, glm::vec2(margin));
            EXPECT_EQ(overlay(list, Overlay::Kind::inset)->rect.min.y, margin);
            EXPECT_NEAR(overlay(list, Overlay::Kind::inset)->rect.max.x, right, 1);
            EXPECT_EQ(overlay(list, Overlay::Kind::legend)->rect.min.x, margin);
            EXPECT_NEAR(overlay(list, Overlay::Kind::legend)->rect.max.y, bottom, 1);
        }
    }
}

/// There is nothing to click in a picture.
TEST(Overlays, HaveControlsInAWindowAlone) {
    const FittedScene fitted = testing::hit_scene();
    for (const bool whole : {false, true}) {
        for (const bool folded : {false, true}) {
            ViewState view = busy_view();
            view.whole_legend = whole;
            view.fold_caption = view.fold_legend = view.fold_inset = folded;
            const DrawList picture = build_draw_list(fitted, view, {.size = {1280, 720}});
            const DrawList window = build_draw_list(fitted, view, {.size = {1280, 720}, .controls = true});
            // Those of the map are between its corners.
            const std::size_t others = 2 * picture.overlays.size() + (whole && !folded ? 2 : 0);
            EXPECT_EQ(window.overlay_lines.size(), picture.overlay_lines.size() + others);
            ASSERT_EQ(picture.overlays.size(), 3u);
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_FALSE(picture.overlays[i].fold || picture.overlays[i].more);
                EXPECT_TRUE(window.overlays[i].fold);
                EXPECT_LT(picture.overlays[i].rect.size().x, window.overlays[i].rect.size().x + 0.5f);
            }
            EXPECT_EQ(overlay(window, Overlay::Kind::legend)->more.has_value(), !folded);
        }
    }
}

TEST(Overlays, TheLegendHasSixRowsAndCountsTheRest) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view = busy_view();
    const PictureOptions options{.size = {1280, 720}, .controls = true};
    const DrawList list = build_draw_list(fitted, view, options);
    ASSERT_GT(list.legend.size(), kLegendRows);
    const Overlay legend = *overlay(list, Overlay::Kind::legend);
    std::vector<std::string> words = words_on(list, legend.rect);
    ASSERT_EQ(words.size(), kLegendRows + 1);
    EXPECT_EQ(words.back(), "and " + std::to_string(list.legend.size() - kLegendRows) + " more");
    ASSERT_TRUE(legend.more);
    EXPECT_TRUE(legend.rect.contains(*legend.more));
    EXPECT_FALSE(legend.more->overlaps(*legend.fold));

    view.whole_legend = true;
    const DrawList whole = build_draw_list(fitted, view, options);
    words = words_on(whole, overlay(whole, Overlay::Kind::legend)->rect);
    ASSERT_EQ(words.size(), whole.legend.size());
    for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(words[i], whole.legend[i].text);
    EXPECT_TRUE(overlay(whole, Overlay::Kind::legend)->more) << "the way back";
    expect_apart(whole);

    view.past = Past::pair;
    view.time.reset();
    view.whole_legend = false;
    const DrawList few = build_draw_list(fitted, view, options);
    ASSERT_LE(few.legend.size(), kLegendRows);
    EXPECT_EQ(words_on(few, overlay(few, Overlay::Kind::legend)->rect).size(), few.legend.size());
    EXPECT_FALSE(overlay(few, Overlay::Kind::legend)->more);
}

TEST(Overlays, AWholeLegendThatDoesNotFitSaysHowMuchIsLeft) {
    std::vector<mobb::Placement> placements;
    for (int i = 0; i < 26; ++i) placements.push_back({{2.0 * i, 0}, 90, 0});
    ViewState view;
    view.whole_legend = true;
    const FittedScene fitted(testing::scene_of(placements), {});
    const DrawList list = build_draw_list(fitted, view, PictureSize{640, 360});
    const std::vector<std::string> words = words_on(list, overlay(list, Overlay::Kind::legend)->rect);
    ASSERT_GT(words.size(), kLegendRows + 1);
    EXPECT_EQ(words.back(), "and " + std::to_string(list.legend.size() - (words.size() - 1)) + " more");
    expect_apart(list);
}

TEST(Overlays, FoldToTheirHeaders) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view = busy_view();
    view.step = {Step::Unit::event, 3};
    const int last = record(fitted, fitted.queries()[0]).trace.size() - 1;
    const std::array<bool ViewState::*, 3> folds{&ViewState::fold_caption, &ViewState::fold_legend,
                                                 &ViewState::fold_inset};
    const std::array<std::string, 3> headers{"step 3 of 0.." + std::to_string(last), "Legend", "floor at 1.00 s"};
    for (const PictureSize size : kSizes) {
        for (std::size_t i = 0; i < folds.size(); ++i) {
            ViewState folded = view;
            folded.*folds[i] = true;
            const DrawList list = build_draw_list(fitted, folded, size);
            ASSERT_EQ(list.overlays.size(), 3u);
            expect_apart(list);
            for (std::size_t j = 0; j < folds.size(); ++j) {
                const Overlay& one = *overlay(list, static_cast<Overlay::Kind>(j));
                EXPECT_EQ(one.folded, i == j);
                EXPECT_FALSE(one.no_room);
                if (i == j) {
                    EXPECT_EQ(words_on(list, one.rect), std::vector<std::string>{headers[i]});
                }
            }
            EXPECT_EQ(list.marks.empty(), i == 2) << "the disks of the map go with it";
            EXPECT_FALSE(list.legend.empty()) << "what it says is known all the same";
            EXPECT_FALSE(list.headline.empty());
        }
    }
}

TEST(Overlays, TheCaptionOfASceneWithoutAFileSaysWhatIsShown) {
    Scene scene = testing::hit_scene().scene();
    scene.file.clear();
    const FittedScene fitted(std::move(scene), {});
    ViewState view;
    view.hidden = {"B"};
    EXPECT_TRUE(build_draw_list(fitted, view, PictureSize{640, 360}).headline.starts_with("B is hidden  \u00B7  MOBB"));
    view.boxes = false;
    EXPECT_EQ(build_draw_list(fitted, view, PictureSize{640, 360}).headline, "B is hidden");
    view.hidden.clear();
    EXPECT_EQ(overlay(build_draw_list(fitted, view, PictureSize{640, 360}), Overlay::Kind::caption), nullptr);
}

TEST(Overlays, WhatHasNoRoomIsFoldedAndSaysSo) {
    const FittedScene fitted = testing::hit_scene();
    const DrawList list = build_draw_list(fitted, busy_view(), PictureSize{330, 150});
    expect_apart(list);
    const Overlay& legend = *overlay(list, Overlay::Kind::legend);
    EXPECT_TRUE(legend.folded && legend.no_room);
    EXPECT_EQ(words_on(list, legend.rect), std::vector<std::string>{"Legend: no room"});
    for (int width = 64; width < 700; width += 31) {
        for (int height = 64; height < 500; height += 29) {
            const DrawList any = build_draw_list(fitted, busy_view(), PictureSize{width, height});
            EXPECT_EQ(any.overlays.size(), 3u) << "none vanishes";
            expect_apart(any);
        }
    }
}

TEST(Overlays, AreDarkEnoughToReadOn) {
    for (const Theme theme : {Theme::dark, Theme::light}) {
        ViewState view = busy_view();
        view.theme = theme;
        const DrawList list = build_draw_list(testing::hit_scene(), view, PictureSize{1280, 720});
        for (const Overlay& one : list.overlays) {
            const auto panel = std::ranges::find_if(list.panels, [&](const OverlayPanel& p) {
                return p.rect.min == one.rect.min && p.rect.max == one.rect.max;
            });
            ASSERT_NE(panel, list.panels.end());
            EXPECT_GE(panel->fill.a, 0.9f);
            EXPECT_GT(panel->border.a * panel->border_width, 0);
        }
    }
}

TEST(Overlays, TheLegendTellsOnlyOfWhatIsInView) {
    // Two walks far from each other, and the camera at the first.
    const FittedScene fitted(testing::scene_of({{}, {{500, 0}, 0, 0}}), {});
    ViewState view;
    view.time_height = 1;
    view.levels = {0, 2, false};
    const auto texts = [&] {
        std::vector<std::string> out;
        for (const LegendEntry& row : build_draw_list(fitted, view, PictureSize{1280, 720}).legend) {
            out.push_back(row.text);
        }
        return out;
    };
    const auto has = [](const std::vector<std::string>& all, const std::string& one) {
        return std::ranges::find(all, one) != all.end();
    };
    EXPECT_TRUE(has(texts(), "A") && has(texts(), "B"));
    view.camera = {CameraPreset::free, 45, 25, true, 30, glm::dvec3(1, 0, 1), 8};
    EXPECT_TRUE(has(texts(), "A"));
    EXPECT_FALSE(has(texts(), "B"));
    EXPECT_TRUE(has(texts(), "level 1"));
    view.camera.target = glm::dvec3(250, 0, 1);
    EXPECT_TRUE(texts().empty()) << "there is nothing to explain";
}

/// Whatever the angle is, figures do not run into one another: "0.0 s0.2 s".
TEST(Overlays, TextsKeepApartAtAnyAngle) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view;
    view.camera.preset = CameraPreset::free;
    int ticks = 0;
    for (const PictureSize size : {PictureSize{640, 360}, PictureSize{1280, 720}}) {
        for (double pitch = -88; pitch <= 88; pitch += 8) {
            for (double yaw = 0; yaw < 360; yaw += 36) {
                view.camera.yaw_deg = yaw;
                view.camera.pitch_deg = pitch;
                const DrawList list = build_draw_list(fitted, view, size);
                for (std::size_t i = 0; i < list.texts.size(); ++i) {
                    const TextRun& one = list.texts[i];
                    ticks += one.text.ends_with(" s") ? 1 : 0;
                    for (std::size_t j = 0; j < i; ++j) {
                        const TextRun& other = list.texts[j];
                        if (one.face != FontFace::mono || other.face != FontFace::mono) continue;
                        const Rect near{one.box.min - glm::vec2(0.3f * one.size, 0),
                                        one.box.max + glm::vec2(0.3f * one.size, 0)};
                        EXPECT_FALSE(near.overlaps(other.box))
                            << one.text << " and " << other.text << " at " << yaw << ", " << pitch;
                    }
                }
            }
        }
    }
    EXPECT_GT(ticks, 100);
}

}  // namespace
}  // namespace mobbscope
