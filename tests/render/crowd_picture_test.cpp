// Pictures of a run: its people, its walls, the window of time, the followed agent and its choice.
#include "crowd/walker_moves.h"
#include "render/pictures.h"

#include <crowd/simulation/choice.h>
#include <crowd/simulation/simulate.h>
#include <render/layout/follow.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/candidates.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

constexpr PictureSize kLarge{1280, 720};

class CrowdPicture : public ::testing::Test {
  protected:
    FittedScene run{testing::with_run(testing::walker_scene(), 20, {13, 13}), {}};

    static ViewState view(Show show, double time) {
        ViewState out;
        out.show = show;
        out.time = time;
        return out;
    }

    /// Somebody and a time just after a choice that some candidate did not survive.
    std::pair<std::string, double> discarding() const {
        const MoveSet moves(run);
        const CrowdRun& crowd = *run.scene().crowd;
        for (int agent = 0; agent < 20; ++agent) {
            const CrowdAgent& who = crowd.agents[static_cast<std::size_t>(agent)];
            for (int play = 1; play < static_cast<int>(who.plays.size()); ++play) {
                const Choice choice = choice_of(moves, crowd, agent, play);
                const double time = choice.time;
                for (const std::size_t i : shown_candidates(choice)) {
                    if (outcome_of(choice, i) == CandidateOutcome::ruled_out) return {who.name, time};
                }
            }
        }
        throw std::logic_error("nobody is ever ruled out");
    }
};

TEST_F(CrowdPicture, AMomentShowsEverybodyOnce) {
    const DrawList list = build_draw_list(run, view(Show::moment, 10), kGoldenSize);
    EXPECT_EQ(list.moment, 10);
    EXPECT_EQ(list.disks.size(), 20u);
    EXPECT_EQ(who_has_a_disk(list).size(), 20u);
    EXPECT_EQ(*who_has_a_disk(list).rbegin(), 19);
}

TEST_F(CrowdPicture, WithoutATimeTheMiddleIsDrawn) {
    ViewState asked = view(Show::moment, 0);
    asked.time.reset();
    EXPECT_EQ(build_draw_list(run, asked, kGoldenSize).moment, 10);
}

TEST_F(CrowdPicture, WallsStandAroundTheFloor) {
    ViewState asked = view(Show::moment, 10);
    const auto panes = [](const DrawList& list) {
        return std::count_if(list.boxes.begin(), list.boxes.end(), [](const BoxInstance& box) {
            // Half the length of a wall of 13 m.
            return !box.pickable && glm::length(box.extents[0]) == 6.5f;
        });
    };
    EXPECT_EQ(panes(build_draw_list(run, asked, kGoldenSize)), 4);
    asked.floor = false;
    EXPECT_EQ(panes(build_draw_list(run, asked, kGoldenSize)), 0);
}

TEST_F(CrowdPicture, NothingMovesButPeopleWhileTimeRuns) {
    const DrawList a = build_draw_list(run, view(Show::moment, 5), kGoldenSize);
    const DrawList b = build_draw_list(run, view(Show::moment, 11), kGoldenSize);
    EXPECT_EQ(a.projection.clip_from_world, b.projection.clip_from_world);
    const DrawList c = build_draw_list(run, view(Show::space_time, 5), kGoldenSize);
    const DrawList d = build_draw_list(run, view(Show::space_time, 11), kGoldenSize);
    EXPECT_EQ(c.projection.clip_from_world, d.projection.clip_from_world);
}

TEST_F(CrowdPicture, SpaceTimeShowsTheWindowAlone) {
    ViewState asked = view(Show::space_time, 10);
    asked.time_window = 1;
    asked.boxes = false;
    const DrawList list = build_draw_list(run, asked, kGoldenSize);
    EXPECT_EQ(who_has_a_disk(list).size() >= 20u, true);
    for (const DiskInstance& disk : list.disks) {
        const double begin = list.space.place(glm::dvec3(disk.base)).z;
        const double end = begin + disk.height() / list.space.time_height;
        EXPECT_GT(end, 9 - 1e-4);
        EXPECT_LT(begin, 11 + 1e-4);
    }
    asked.time_window = 3;
    EXPECT_GT(build_draw_list(run, asked, kGoldenSize).disks.size(), list.disks.size());
}

TEST_F(CrowdPicture, WhomTheCameraFollowsStaysInTheMiddle) {
    ViewState asked = view(Show::moment, 6);
    asked.follow = run.scene().crowd->agents[3].name;
    asked.camera.target = glm::dvec3(0);
    asked.camera.distance = 40;
    for (const Show show : {Show::moment, Show::space_time}) {
        asked.show = show;
        for (const double time : {6.0, 6.4, 9.0}) {
            asked.time = time;
            const DrawList list = build_draw_list(run, asked, kGoldenSize);
            const auto place = followed_place(run, asked, time);
            ASSERT_TRUE(place);
            const auto at =
                list.projection.project(list.space.point(place->x, place->y, show == Show::moment ? 0 : time));
            ASSERT_TRUE(at);
            EXPECT_NEAR(at->x, 320, 0.01);
            EXPECT_NEAR(at->y, 180, 0.01);
        }
    }
}

TEST_F(CrowdPicture, TheFollowedIsSeenFromNear) {
    for (const Show show : {Show::moment, Show::space_time}) {
        ViewState asked = view(show, 6);
        asked.follow = run.scene().crowd->agents[3].name;
        asked.camera.preset = CameraPreset::top;
        asked.camera = framing_followed(run, asked, build_draw_list(run, asked, kGoldenSize));
        EXPECT_EQ(asked.camera.pitch_deg, 90) << "seen as before";
        for (const double time : {6.0, 9.0}) {
            asked.time = time;
            const DrawList list = build_draw_list(run, asked, kGoldenSize);
            const glm::dvec2 place = followed_place(run, asked, time).value();
            const double level = show == Show::moment ? 0 : time;
            const glm::vec2 at =
                list.projection.project(list.space.point(place.x, place.y + kAroundFollowed, level)).value();
            // The picture's height has so much of it but for a margin.
            EXPECT_NEAR(std::abs(at.y - 180), 0.8 * 180, 1);
        }
    }
}

TEST_F(CrowdPicture, OfASceneTheFollowedIsSeenAtItsTime) {
    Scene scene = run.scene();
    scene.crowd = nullptr;
    scene.agents = {{"late", 0, {{30, 40}, 0, 500}, std::nullopt}};
    const FittedScene fitted(std::move(scene), {});
    ViewState asked = view(Show::space_time, 500.2);
    asked.follow = "late";
    asked.camera = framing_followed(fitted, asked, build_draw_list(fitted, asked, kGoldenSize));
    const DrawList list = build_draw_list(fitted, asked, kGoldenSize);
    const glm::dvec2 place = followed_place(fitted, asked, 500.2).value();
    const glm::vec2 at = list.projection.project(list.space.point(place.x, place.y, 500.2)).value();
    EXPECT_NEAR(at.x, 320, 1);
    EXPECT_NEAR(at.y, 180, 40);
}

TEST_F(CrowdPicture, FollowingNobodyThereIsIsRefused) {
    ViewState asked = view(Show::moment, 6);
    asked.follow = "nobody";
    EXPECT_THROW(build_draw_list(run, asked, kGoldenSize), std::invalid_argument);
}

TEST_F(CrowdPicture, CandidatesAreDrawnWithWhoRulesThemOut) {
    const auto [name, time] = discarding();
    for (const Show show : {Show::moment, Show::space_time}) {
        ViewState asked = view(show, time + 1e-3);
        asked.follow = name;
        const DrawList with = build_draw_list(run, asked, kGoldenSize);
        const LineStyle style = outcome_style_of(CandidateOutcome::ruled_out, with.palette);
        const auto is_discarded = [&](const LineInstance& line) {
            return glm::vec3(line.color) == glm::vec3(style.color) && line.dash != kSolid;
        };
        EXPECT_TRUE(std::any_of(with.lines.begin(), with.lines.end(), is_discarded));
        const MoveSet moves(run);
        const auto choice = choice_in_view(moves, asked);
        ASSERT_TRUE(choice);
        EXPECT_EQ(choice->choice.time, time);
        std::set<std::string> rulers;
        for (const Candidate& candidate : choice->choice.candidates) {
            if (!candidate.blocker) continue;
            rulers.insert(run.scene().crowd->agents[static_cast<std::size_t>(candidate.blocker->agent)].name);
        }
        const bool named = std::any_of(with.texts.begin(), with.texts.end(),
                                       [&](const TextRun& text) { return rulers.contains(text.text); });
        EXPECT_TRUE(named);
        asked.candidates = false;
        const DrawList without = build_draw_list(run, asked, kGoldenSize);
        EXPECT_FALSE(std::any_of(without.lines.begin(), without.lines.end(), is_discarded));
    }
}

/// What a picture says at its top.
std::string caption_of(const DrawList& list) {
    std::string out;
    for (const TextRun& text : list.texts) {
        if (text.box.max.y < 0.25f * static_cast<float>(list.size.height)) out += text.text + '\n';
    }
    return out;
}

TEST_F(CrowdPicture, OutsideOfTheRunNobodyIsThereAndNothingIsChosen) {
    for (const Show show : {Show::moment, Show::space_time}) {
        for (const auto& [time, told] : {std::pair(999.0, "999 s"), std::pair(-1.0, "-1 s")}) {
            ViewState asked = view(show, time);
            asked.follow = run.scene().crowd->agents[3].name;
            const DrawList list = build_draw_list(run, asked, kLarge);
            const std::string caption = caption_of(list);
            if (time > 20) {
                EXPECT_EQ(caption.rfind("Nobody is on the floor at 999.00 s", 0), 0u) << caption;
            }
            EXPECT_NE(caption.find(std::string(told) + " lies outside 0..20 s"), std::string::npos) << caption;
            EXPECT_EQ(caption.find("chose"), std::string::npos) << caption;
            const auto is_fate = [](const LegendEntry& entry) {
                return entry.text == outcome_words(CandidateOutcome::taken);
            };
            EXPECT_TRUE(std::none_of(list.legend.begin(), list.legend.end(), is_fate));
        }
        EXPECT_EQ(caption_of(build_draw_list(run, view(show, 6), kLarge)).find("outside"), std::string::npos);
    }
}

/// Whether some panel has all words of the caption on it.
bool has_caption_on_a_panel(const DrawList& list) {
    const auto holds = [&](const OverlayPanel& panel) {
        return std::count_if(list.texts.begin(), list.texts.end(), [&](const TextRun& text) {
                   return panel.rect.contains(text.box) && text.box.min.y < 60;
               }) >= 2;
    };
    return std::any_of(list.panels.begin(), list.panels.end(), holds);
}

TEST_F(CrowdPicture, TheCaptionStandsOnAPanel) {
    Scene pair = run.scene();
    pair.crowd = nullptr;
    pair.file = "pair.json";
    pair.agents = {{"a", 0, {}, std::nullopt}, {"b", 1, {{3, 0}, 0, 0}, std::nullopt}};
    const FittedScene scene(std::move(pair), {});
    for (const FittedScene* fitted : {&std::as_const(run), &scene}) {
        for (const Show show : {Show::moment, Show::space_time}) {
            ViewState asked = view(show, 0.2);
            asked.legend = false;
            EXPECT_TRUE(has_caption_on_a_panel(build_draw_list(*fitted, asked, kLarge)));
            asked.caption = false;
            EXPECT_FALSE(has_caption_on_a_panel(build_draw_list(*fitted, asked, kLarge)));
        }
    }
}

TEST_F(CrowdPicture, TheSentenceKeepsFatesApart) {
    const auto named = [&](int agent) { return run.scene().crowd->agents[static_cast<std::size_t>(agent)].name; };
    FollowedChoice followed;
    followed.agent = 4;
    followed.choice.time = 2.5;
    const Candidate free;
    Candidate off;
    off.leaves_floor = true;
    Candidate in_the_way;
    in_the_way.in_the_way = true;
    const auto met = [](int agent) {
        Candidate out;
        out.met = Met::play;
        out.blocker = Blocker{agent, 1, {}};
        return out;
    };
    followed.choice.candidates = {free, met(5), met(7), in_the_way, in_the_way, off};
    EXPECT_EQ(choice_sentence(run.scene(), followed),
              named(4) + " chose among 6 moves at 2.50 s: 1 free; 2 ruled out by " + named(5) + ", " + named(7) +
                  "; 2 in the way of others; 1 leaves the floor");
    Candidate no_way_on;
    no_way_on.no_way_on = true;
    Candidate against_plan = met(5);
    against_plan.met = Met::plan;
    against_plan.blocker->planned = 2;
    followed.choice.candidates = {free, no_way_on, against_plan};
    EXPECT_EQ(choice_sentence(run.scene(), followed),
              named(4) + " chose among 3 moves at 2.50 s: 1 free; 1 ruled out by " + named(5) + "; 1 has no way on");
    EXPECT_EQ(outcome_of(followed.choice, 1), CandidateOutcome::no_way_on);
    const std::string clip = run.scene().clips[0].name;
    EXPECT_EQ(candidate_sentence(run.scene(), followed.choice, 1), clip + ": no way on");
    EXPECT_EQ(candidate_sentence(run.scene(), followed.choice, 2),
              clip + ": meets what " + named(5) + " plans at 0.00 s");
    followed.choice.kind = PlayKind::forced;
    followed.choice.candidates = {met(5), off, off};
    EXPECT_EQ(choice_sentence(run.scene(), followed),
              named(4) + " was forced at 2.50 s, as none of its 3 moves was free: 1 ruled out by " + named(5) +
                  "; 2 leave the floor");
    followed.choice.candidates = {met(5)};
    EXPECT_EQ(choice_sentence(run.scene(), followed),
              named(4) + " was forced at 2.50 s, as its only move was not free: 1 ruled out by " + named(5));
}

TEST(Candidates, EveryFateHasAColourAndALineOfItsOwn) {
    const Palette& colors = palette(Theme::dark);
    const CandidateOutcome all[] = {CandidateOutcome::taken,        CandidateOutcome::free,
                                    CandidateOutcome::in_the_way,   CandidateOutcome::no_way_on,
                                    CandidateOutcome::leaves_floor, CandidateOutcome::ruled_out};
    for (const CandidateOutcome a : all) {
        for (const CandidateOutcome b : all) {
            if (a == b) continue;
            const LineStyle one = outcome_style_of(a, colors);
            const LineStyle other = outcome_style_of(b, colors);
            EXPECT_NE(one.color, other.color);
            EXPECT_TRUE(one.dash != other.dash || one.width != other.width);
        }
    }
}

}  // namespace
}  // namespace mobbscope
