// The import dialog, by clicks and keys.
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <support/temp_folder.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <thread>

namespace mobbscope::app {
namespace {

/// A body 170 units tall that goes along X, 1 m a second if the unit is cm: two joints, 60 frames.
std::string body_bvh(int frames = 60) {
    std::string text = R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Spine
  {
    OFFSET 0 60 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT Hand
    {
      OFFSET 40 0 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      End Site
      {
        OFFSET 0 20 0
      }
    }
  }
  JOINT Foot
  {
    OFFSET 0 -90 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 10 0 0
    }
  }
}
MOTION
)";
    text += "Frames: " + std::to_string(frames) + "\nFrame Time: 0.0333333\n";
    for (int i = 0; i < frames; ++i) {
        text += std::to_string(10 * i / 3.0) + " 90 0 0 0 0 0 0 0 0 0 0 0 0 0\n";
    }
    return text;
}

/// Three people of whom nobody knows the unit nor the frame rate; the second comes a frame later.
constexpr const char* kTracks = "0 1 0 0\n1 1 1 0\n2 1 2 0\n1 2 0 5\n2 2 1 5\n3 2 2 5\n0 3 0 9\n1 3 0.5 9\n";

struct ImportWindow : FolderWindow<TempFolder> {
    ImportWindow() : FolderWindow({1280, 800}) {
        folder.write("body.bvh", body_bvh());
        folder.write("people.txt", kTracks);
        folder.write("scene.json", R"({"clips": {"walk": {"source": "body.bvh", "unit": "m"},
                                                 "other": {"source": "body.bvh"}},
                                       "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "other"}]})");
    }

    void open(const std::string& file) {
        session.files.open({folder.path() / file});
        window.settle();
    }
    const SceneClip& clip(std::size_t index = 0) const { return session.workspace.scene().clips[index]; }
    glm::vec2 place(const std::string& mark) {
        const auto at = window.shell().marks().all().find(mark);
        EXPECT_NE(at, window.shell().marks().all().end()) << mark;
        return at == window.shell().marks().all().end() ? glm::vec2(0) : at->second.center();
    }
    void button(bool down) { window.shell().feed(MouseButton{0, down}); }
    void click(const std::string& mark, int times = 1) {
        window.run_for(0.5);
        window.shell().feed(MouseMove{place(mark)});
        window.settle();
        for (int i = 0; i < times; ++i) {
            button(true);
            window.frame();
            button(false);
            window.frame();
        }
        window.settle();
    }
    void drag(const std::string& mark, float right, float down = 0) {
        const glm::vec2 from = place(mark);
        window.shell().feed(MouseMove{from});
        window.settle();
        button(true);
        window.frame();
        for (int i = 1; i <= 5; ++i) {
            window.shell().feed(MouseMove{from + glm::vec2(right, down) * (static_cast<float>(i) / 5)});
            window.frame();
        }
        button(false);
        window.settle();
    }
    void key(const std::string& name) {
        const Chord chord = *chord_from_name(name);
        const auto send = [&](Key key, bool down) { window.shell().feed(KeyPress{key, down}); };
        if (chord.ctrl) send(Key::ctrl, true);
        send(chord.key, true);
        window.settle();
        send(chord.key, false);
        if (chord.ctrl) send(Key::ctrl, false);
        window.settle();
    }
    void type(const std::string& text) {
        for (const char c : text) window.shell().feed(TypedText{static_cast<char32_t>(c)});
        window.settle();
    }
};

TEST(ImportDialog, EachOptionThatMendsAWarningIsToldOfOnce) {
    ImportWindow w;
    w.open("people.txt");
    std::set<std::string> options;
    for (const SceneClip& clip : w.session.workspace.scene().clips) {
        for (const ImportWarning& warning : clip.facts.warnings) {
            if (!warning.option.empty()) options.insert(warning.option);
        }
    }
    ASSERT_GE(options.size(), 2u);
    std::size_t warnings = 0;
    for (const Message& message : w.session.notifications.all()) {
        warnings += message.level == MessageLevel::warning ? 1 : 0;
    }
    EXPECT_EQ(warnings, options.size()) << all_messages(w.session);
}

TEST(ImportDialog, AWrongUnitIsMendedFromItsMessageByTwoClicks) {
    ImportWindow w;
    w.open("scene.json");
    ASSERT_EQ(w.session.notifications.all().size(), 1u);
    EXPECT_NE(all_messages(w.session).find("check unit"), std::string::npos) << all_messages(w.session);
    w.click("message.0.offer");
    EXPECT_EQ(w.session.dialogs.now, Dialog::import_clip);
    EXPECT_EQ(w.session.imports.edited.clip, 0);
    EXPECT_EQ(w.session.imports.edited.field, "unit");
    EXPECT_EQ(all_messages(w.session), "") << "it stands at the field now";
    EXPECT_TRUE(w.has("import.unit.warning"));
    const auto before = w.session.workspace.document().fitted;

    w.click("import.unit");
    w.click("import.unit.cm");
    EXPECT_EQ(w.clip().options.unit, "cm");
    EXPECT_NEAR(w.clip().clip->samples()[30].x, 1, 1e-6);
    EXPECT_TRUE(w.clip().facts.warnings.empty());
    EXPECT_FALSE(w.has("import.unit.warning"));
    EXPECT_FALSE(w.clip(1).options.unit) << "of a motion each clip is for itself";
    EXPECT_EQ(&w.session.workspace.fitted().tree(0).clip(), w.clip().clip.get()) << "what is drawn has changed too";
    EXPECT_EQ(w.session.workspace.history.undo_title(), "changing the unit of walk: cm");

    w.key("Ctrl+Z");
    EXPECT_EQ(&w.session.workspace.scene(), &before->scene());
    EXPECT_EQ(w.session.dialogs.now, Dialog::import_clip) << "undo works in the dialog";
    w.key("Ctrl+Y");
    EXPECT_EQ(w.clip().options.unit, "cm");
    w.click("import.unit.reset");
    EXPECT_FALSE(w.clip().options.unit);
    EXPECT_NEAR(w.clip().facts.unit, 0.01, 1e-12) << "as its height says";
    w.key("Escape");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
}

TEST(ImportDialog, WhatCannotBeImportedIsSaidAtItsFieldAndChangesNothing) {
    ImportWindow w;
    w.open("body.bvh");
    w.session.queue.push([&] { run_command(w.session, "clip.import"); });
    w.window.settle();
    const FittedScene* const before = w.session.workspace.document().fitted.get();
    w.click("import.fps", 2);
    w.key("Ctrl+A");
    w.type("-5");
    w.key("Enter");
    EXPECT_TRUE(w.has("import.fps.error"));
    EXPECT_EQ(w.session.imports.edited.refused["fps"].why, "fps must be over 0 and at most 1000000");
    // In range, but not in this file: the file must be asked.
    w.session.queue.push([&] { run_command(w.session, "clip.set", "trim 90 95"); });
    w.window.settle();
    EXPECT_TRUE(w.has("import.trim.error"));
    EXPECT_NE(w.session.imports.edited.refused["trim"].why.find("trim begins"), std::string::npos)
        << w.session.imports.edited.refused["trim"].why;
    EXPECT_EQ(w.session.workspace.document().fitted.get(), before);
    EXPECT_EQ(all_messages(w.session), "");
    EXPECT_EQ(w.session.dialogs.now, Dialog::import_clip) << "Enter was the field's";
    w.session.queue.push([&] { run_command(w.session, "clip.set", "fps 60"); });
    w.window.settle();
    EXPECT_FALSE(w.has("import.fps.error")) << "what is right now is no longer complained of";
    EXPECT_EQ(w.clip().clip->dt(), 1 / 60.0);
}

TEST(ImportDialog, TrimHasAHandleAtEachEnd) {
    ImportWindow w;
    w.open("body.bvh");
    run_command(w.session, "clip.import");
    w.window.settle();
    const int before = w.clip().clip->count();
    w.drag("import.trim.begin", 100);
    ASSERT_TRUE(w.clip().options.trim);
    const double begin = w.clip().options.trim->first;
    EXPECT_GT(begin, 0.1);
    EXPECT_LT(w.clip().clip->count(), before);
    w.drag("import.trim.end", -100);
    EXPECT_EQ(w.clip().options.trim->first, begin);
    EXPECT_LT(w.clip().options.trim->second, 1.9);
    w.key("Ctrl+Z");
    EXPECT_EQ(w.clip().options.trim->first, begin) << "a drag is one edit";
    w.key("Ctrl+Z");
    EXPECT_FALSE(w.clip().options.trim);
}

/// More joints than are seen at once: a chain of fingers.
std::string bvh_of_many_joints() {
    std::string many = body_bvh();
    std::string fingers;
    for (int i = 0; i < 20; ++i) {
        fingers += "JOINT Finger" + std::to_string(i) + " {\nOFFSET 0 1 0\nCHANNELS 0\n";
    }
    fingers += "End Site\n{\nOFFSET 0 1 0\n}\n" + std::string(20, '}');
    many.replace(many.find("End Site"), 0, fingers + "\n");
    return many;
}

TEST(ImportDialog, JointsAreFoundByAFewLetters) {
    ImportWindow w;
    w.folder.write("many.bvh", bvh_of_many_joints());
    w.open("many.bvh");
    run_command(w.session, "clip.import");
    w.window.settle();
    w.click("import.root");
    EXPECT_TRUE(w.has("import.root.Finger2"));
    w.type("foo");
    EXPECT_FALSE(w.has("import.root.Finger2"));
    w.key("Enter");
    EXPECT_EQ(w.clip().options.root, "Foot");
    EXPECT_EQ(w.clip().facts.root, "Foot");
    EXPECT_EQ(w.session.dialogs.now, Dialog::import_clip);
    w.click("import.root");
    w.key("Escape");
    EXPECT_EQ(w.session.dialogs.now, Dialog::import_clip) << "Escape closes the list first";
    w.key("Escape");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
}

TEST(ImportDialog, ListsAreGoneThroughByKeys) {
    ImportWindow w;
    w.folder.write("many.bvh", bvh_of_many_joints());
    w.open("many.bvh");
    run_command(w.session, "clip.import");
    w.window.settle();
    for (int i = 0; i < 20 && w.session.keys.focus != "import.root"; ++i) w.key("Tab");
    ASSERT_EQ(w.session.keys.focus, "import.root");
    w.key("Enter");
    EXPECT_EQ(w.session.keys.focus, "import.root.search") << "one types what is looked for";
    w.key("Down");
    EXPECT_EQ(w.session.keys.focus, "import.root.default");
    for (int i = 0; i < 16; ++i) w.key("Down");
    EXPECT_EQ(w.session.keys.focus, "import.root.Finger12") << "beyond what is drawn at once";
    w.key("Home");
    w.key("Up");
    EXPECT_EQ(w.session.keys.focus, "import.root.default") << "what stands above the list";
    w.key("Down");
    w.key("Down");
    w.key("Enter");
    EXPECT_EQ(w.clip().options.root, "Spine");
    EXPECT_EQ(w.session.keys.focus, "import.root");
}

TEST(ImportDialog, ACrowdsUnitAndFrameTimeChangeForAllOfItsFile) {
    ImportWindow w;
    w.open("people.txt");
    ASSERT_EQ(w.session.workspace.scene().clips.size(), 3u);
    EXPECT_EQ(w.session.workspace.scene().agents[1].placement.start, 0.4);
    run_command(w.session, "clip.import", "2");
    w.window.settle();
    EXPECT_TRUE(w.has("import.whole_file"));
    w.click("import.unit");
    w.click("import.unit.cm");
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(w.clip(i).options.unit, "cm") << i;
    EXPECT_EQ(w.clip(0).clip->samples()[2].x, 0.02);
    EXPECT_EQ(w.clip(0).options.id, "1") << "whose path it is stays";
    run_command(w.session, "clip.set", "dt 2");
    EXPECT_EQ(w.clip(2).clip->dt(), 2);
    EXPECT_EQ(w.session.workspace.scene().agents[1].placement.start, 2) << "it comes a frame later, as its track does";
    w.click("import.whole_file");
    run_command(w.session, "clip.set", "radius 0.5");
    EXPECT_FALSE(w.clip(0).options.radius);
    EXPECT_EQ(w.clip(1).clip->samples()[0].r, 0.5);
    // Only what the format has is asked.
    for (const char* other : {"import.root", "import.up", "import.animation"}) EXPECT_FALSE(w.has(other)) << other;
}

TEST(ImportDialog, AColumnOfRadiiIsChosen) {
    ImportWindow w;
    w.folder.write("r.csv", "t,x,y,r,big\n0,0,0,1,2\n1,1,0,1,3\n");
    w.folder.write("r.json", R"({"clips": {"a": {"source": "r.csv", "radius": "big"}}})");
    w.open("r.json");
    EXPECT_EQ(w.clip().clip->samples()[1].r, 3);
    run_command(w.session, "clip.import");
    w.window.settle();
    run_command(w.session, "clip.set", "radius 0.5");
    EXPECT_EQ(w.clip().clip->samples()[1].r, 0.5) << "a column that means nothing else is ignored";
    w.click("import.radius");
    w.click("import.radius.big");
    EXPECT_EQ(w.clip().clip->samples()[0].r, 2);
    EXPECT_EQ(option_text(w.clip().options, *import_option("radius")), "big");
}

TEST(ImportDialog, TheFileIsReadOnceUntilItChanges) {
    ImportWindow w;
    w.open("body.bvh");
    run_command(w.session, "clip.import");
    const std::filesystem::path file = w.folder.path() / "body.bvh";
    const auto written = std::filesystem::last_write_time(file);
    // Other bytes with the same looks: whoever reads them sees that they are none.
    const std::string bytes(std::filesystem::file_size(file), 'x');
    w.folder.write("body.bvh", bytes);
    std::filesystem::last_write_time(file, written);
    run_command(w.session, "clip.set", "fps 10");
    EXPECT_EQ(w.clip().clip->dt(), 0.1);
    std::filesystem::last_write_time(file, written + std::chrono::seconds(2));
    run_command(w.session, "clip.set", "fps 20");
    EXPECT_NE(w.session.imports.edited.refused["fps"].why.find("BVH begins with HIERARCHY"), std::string::npos);
    EXPECT_EQ(w.clip().clip->dt(), 0.1);
}

TEST(ImportDialog, TheMomentOfTheSkeletonIsScrubbed) {
    ImportWindow w;
    w.open("body.bvh");
    run_command(w.session, "clip.import");
    w.window.settle();
    w.click("import.time");
    EXPECT_NEAR(w.session.imports.edited.time, 1, 0.05);
    w.click("import.radius_chart");
    EXPECT_GT(w.session.imports.edited.time, 1);
    EXPECT_FALSE(w.session.workspace.modified());
}

TEST(ImportDialog, ADoubleClickOnAClipOpensIt) {
    ImportWindow w;
    w.open("scene.json");
    w.click("clip.1", 2);
    EXPECT_EQ(w.session.dialogs.now, Dialog::import_clip);
    EXPECT_EQ(w.session.imports.edited.clip, 1);
    // From one clip to the next.
    w.click("import.clip");
    w.click("import.clip.0");
    EXPECT_EQ(w.session.imports.edited.clip, 0);
    EXPECT_TRUE(w.has("import.unit.reset"));
}

TEST(ImportDialog, WithoutTheDialogWhatIsRefusedIsAnError) {
    ImportWindow w;
    w.open("body.bvh");
    EXPECT_NE(refusal(w.session, "clip.set", "fps none").find("fps is a number"), std::string::npos);
    EXPECT_NE(refusal(w.session, "clip.set", "roof Hips").find("did you mean 'root'"), std::string::npos);
    run_command(w.session, "clip.set", "root Hisp");
    EXPECT_NE(all_messages(w.session).find("the nearest is 'Hips'"), std::string::npos) << all_messages(w.session);
    EXPECT_FALSE(w.session.workspace.modified());
}

// A person's session: imports are jobs, one after the other, and of a drag the last value counts.
TEST(ImportDialog, LongImportsRunBesideTheWindow) {
    const TempFolder folder;
    Session session(true);
    session.files.open({folder.write("long.bvh", body_bvh(20'000))});
    const auto wait = [&] {
        while (session.jobs.count() > 0) {
            session.poll();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    };
    wait();
    session.imports.open(0);
    for (const char* fps : {"31", "32", "33", "34"}) session.imports.set(0, false, "fps", fps);
    session.imports.set(0, false, "unit", "in");
    EXPECT_LE(session.jobs.count(), 2u) << "one at a time, beside the reading for the dialog";
    wait();
    EXPECT_EQ(session.workspace.scene().clips[0].options.fps, 34);
    EXPECT_EQ(session.workspace.scene().clips[0].options.unit, "in");
    EXPECT_EQ(session.workspace.scene().clips[0].facts.unit, 0.0254);
    EXPECT_EQ(all_messages(session), "The clip has another size now\n") << "as the camera stays";
}

TEST(ImportDialog, MotionBetweenSamplesIsAFieldThatIsUndone) {
    ImportWindow w;
    w.open("people.txt");
    w.session.workspace.select({Selection::Kind::clip, {}, 0});
    w.session.queue.push([&] { run_command(w.session, "clip.import"); });
    w.window.settle();
    ASSERT_TRUE(w.has("import.motion"));
    EXPECT_EQ(w.clip().clip->motion(), mobb::Motion::linear) << "tracks are";
    w.click("import.motion");
    w.click("import.motion.held");
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(w.clip(i).clip->motion(), mobb::Motion::held) << "for all of the file, " << i;
        EXPECT_EQ(w.clip(i).options.motion, mobb::Motion::held);
    }
    EXPECT_TRUE(w.has("import.motion.warning")) << "steps of 1 m are longer than 0.2 m";
    w.key("Ctrl+Z");
    EXPECT_EQ(w.clip().clip->motion(), mobb::Motion::linear);
    EXPECT_FALSE(w.has("import.motion.warning"));
    w.key("Ctrl+Y");
    EXPECT_EQ(w.clip(2).clip->motion(), mobb::Motion::held);
    w.click("import.motion.reset");
    EXPECT_FALSE(w.clip(2).options.motion);
    EXPECT_EQ(w.clip(2).clip->motion(), mobb::Motion::linear);
}

TEST(ImportDialog, SamplesInTheSceneGetAnotherMotionByACommand) {
    ImportWindow w;
    w.folder.write("inline.json", R"({"clips": {"stand": {"dt": 1, "samples": [[0,0,1]]},
        "far walk": {"dt": 1, "samples": [[0,0,0.5],[2,0,0.5]]}}})");
    w.open("inline.json");
    EXPECT_NE(all_messages(w.session).find("far walk: its disks are held, but it moves 2 m"), std::string::npos);
    w.click("message.0.offer");
    EXPECT_EQ(w.clip(1).clip->motion(), mobb::Motion::linear);
    EXPECT_EQ(w.clip(0).clip->motion(), mobb::Motion::held);
    EXPECT_EQ(w.session.workspace.fitted().tree(1).clip().motion(), mobb::Motion::linear);
    w.key("Ctrl+Z");
    EXPECT_EQ(w.clip(1).clip->motion(), mobb::Motion::held);
    EXPECT_EQ(refusal(w.session, "clip.motion", "fast"), "motion is held or linear, not 'fast'");
    EXPECT_NE(refusal(w.session, "clip.motion", "linear nobody"), "");
}

}  // namespace
}  // namespace mobbscope::app
