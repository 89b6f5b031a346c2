// What each command does to the session, and that undo takes it back where it edits.
#include <app/commands/picture_order.h>
#include <render/drawlist/view_projection.h>
#include <render/image/png.h>
#include <render/pictures/build_draw_list.h>
#include <review/review_screen.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {
namespace {

/// A session over the scene of a folder, with everything that a window would bring.
struct CommandWorld {
    CrossingFolder folder;
    Session session{false};
    TestDesktop desktop;
    struct Maker : PictureMaker {
        std::optional<DrawList> drawn;  ///< the last picture that was asked for
        int samples = 0;

        Image draw(const DrawList& list, int wanted) override {
            drawn = list;
            samples = wanted;
            return Image(list.size.width, list.size.height);
        }
        std::string file_bytes(const std::filesystem::path& /*file*/, const DrawList& list, int wanted) override {
            return png_bytes(draw(list, wanted));
        }
    } maker;

    CommandWorld() {
        desktop.has_picture_clipboard = true;
        add_review(session);
        session.desktop = &desktop;
        session.picture_maker = &maker;
        session.sweeps.timer = [](Protocol, const FitTrees& trees, std::span<const ClipQuery> queries,
                                  std::size_t stretch) {
            const bool is_best = trees.front()->options().tree == mobb::TreeKind::blocks;
            return std::vector<double>((queries.size() + stretch - 1) / stretch, is_best ? 10 : 100);
        };
        session.views.picture = {{800, 600}, 0};
        session.settings.recent = {folder.file("walk.csv")};
        session.settings.last.files = {folder.file("walk.csv"), folder.file("stand.csv")};
        session.files.open({folder.scene});
        EXPECT_EQ(all_messages(session), "");
        // A query with the first event of its trace alone.
        folder.write("stored.json", R"({"clips": {"walk": {"source": "walk.csv"}},
            "queries": [{"a": {"clip": "walk"}, "b": {"clip": "walk", "translate": [1, -1], "rotate_deg": 90},
            "trace": [{"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "time", "outcome": "overlap"}]}]})");
        std::filesystem::create_directory(folder.file("1"));
        folder.write("1/scene.unsaved", "a copy that cannot be read");
        session.recovery.keep_in(folder.scene.parent_path());
        session.recovery.look();
        session.notifications.clear();
    }

    const ViewState& view() const { return session.workspace.view(); }
    const Agent& agent(std::size_t i) const { return session.workspace.scene().agents[i]; }
    std::string path(const std::string& name) const { return folder.file(name).string(); }
};

/// One use of a command.
struct CommandCase {
    std::string id;
    std::string argument;  ///< "@name" stands for that file in the folder
    std::vector<std::pair<std::string, std::string>> before;
    std::function<void(CommandWorld&)> check;
    bool edits = false;  ///< undo must bring the very scene back
};

const std::pair<std::string, std::string> kSelectB{"go.agent", "B"};
const std::pair<std::string, std::string> kFirstQuery{"query.select", "0"};
const std::pair<std::string, std::string> kFirstStep{"step.first", ""};

mobb::Outcome outcome_now(const CommandWorld& world) {
    const mobb::Trace& trace = world.session.workspace.recorded()->trace;
    return trace[world.session.workspace.step()].outcome;
}

void expect_node(const CommandWorld& world, int node) {
    EXPECT_EQ(world.session.workspace.selection, (Selection{Selection::Kind::node, {1, -1, 0}, node}));
}

std::vector<CommandCase> cases() {
    std::vector<CommandCase> out;
    const auto add = [&](CommandCase c) { out.push_back(std::move(c)); };
    const auto look = [&](std::string id, std::string argument, std::function<void(CommandWorld&)> check) {
        add({std::move(id), std::move(argument), {}, std::move(check)});
    };
    const auto edit = [&](std::string id, std::string argument, std::function<void(CommandWorld&)> check) {
        add({std::move(id), std::move(argument), {kSelectB}, std::move(check), true});
    };
    const auto in_query = [&](std::string id, std::string argument, std::function<void(CommandWorld&)> check) {
        add({std::move(id), std::move(argument), {kFirstQuery, kFirstStep}, std::move(check)});
    };

    // File
    look("file.open", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::open); });
    look("file.open", "@walk.csv", [](CommandWorld& w) {
        EXPECT_TRUE(w.session.workspace.scene().agents.empty());
        EXPECT_EQ(w.session.workspace.title(), "walk");
    });
    look("file.add", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::add); });
    add({"file.add",
         "@walk.csv",
         {},
         [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.scene().clips.size(), 3u);
             EXPECT_EQ(w.session.workspace.scene().agents.size(), 4u);
         },
         true});
    look("file.recent", "@walk.csv", [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.scene().clips.size(), 1u); });
    look("file.reopen_last", "", [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.title(), "2 files"); });
    look("file.recover", "@1/scene.unsaved", [](CommandWorld& w) {
        EXPECT_NE(all_messages(w.session).find("the copy is kept"), std::string::npos) << all_messages(w.session);
    });
    look("file.discard_unsaved", "@1/scene.unsaved", [](CommandWorld& w) {
        EXPECT_FALSE(std::filesystem::exists(w.folder.file("1/scene.unsaved")));
        EXPECT_FALSE(w.session.recovery.has_left());
    });
    look("file.demo", "", [](CommandWorld& w) {
        EXPECT_EQ(w.agent(0).name, "A");
        EXPECT_EQ(w.session.workspace.scene().agents.size(), 2u);
        EXPECT_FALSE(w.session.workspace.file);
    });
    add({"file.reload", "", {{"view.floor", ""}}, [](CommandWorld& w) {
             EXPECT_TRUE(w.view().floor);
             EXPECT_EQ(w.session.workspace.file, w.folder.scene);
         }});
    look("crowd.build_graph", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::build_graph); });
    look("crowd.build_graph", "whole", [](CommandWorld& w) {
        ASSERT_TRUE(w.session.workspace.scene().graph);
        EXPECT_EQ(w.session.workspace.scene().graph->moves.size(), 2u);
        EXPECT_TRUE(w.session.workspace.modified());
    });
    add({"crowd.simulate", "", {{"crowd.build_graph", "whole"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.dialogs.now, Dialog::simulate);
         }});
    add({"crowd.simulate", "agents=2 area=30x30 seconds=4", {{"crowd.build_graph", "whole"}}, [](CommandWorld& w) {
             ASSERT_TRUE(w.session.workspace.crowd());
             EXPECT_EQ(w.session.workspace.crowd()->agents.size(), 2u);
         }});
    add({"file.save", "", {kSelectB, {"agent.move", "4 5"}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.session.workspace.modified());
             EXPECT_EQ(load_scene(w.folder.scene).agents[1].placement.translate, glm::dvec2(4, 5));
         }});
    look("file.save_as", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::save_as); });
    look("file.save_as", "@other.json", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.title(), "other.json");
        EXPECT_EQ(load_scene(w.folder.file("other.json")).agents.size(), 3u);
    });
    look("file.export_picture", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::export_picture); });
    add({"file.export_picture", "@p.png", {{"picture.size", "640x360"}}, [](CommandWorld& w) {
             ASSERT_TRUE(std::filesystem::exists(w.folder.file("p.png")));
             EXPECT_EQ(w.maker.drawn->size, (PictureSize{800, 600})) << "the viewport's, whatever the dialog says";
         }});
    look("file.export_film", "", [](CommandWorld& w) {
        EXPECT_EQ(w.session.dialogs.now, Dialog::export_picture);
        EXPECT_EQ(w.session.dialogs.exporting.file, w.path("scene.mp4"));
    });
    const auto films = [&](const std::string& option, const std::string& text, const std::string& said) {
        add({"picture." + option, text, {}, [said](CommandWorld& w) {
                 const PictureOrder order =
                     ordered_for("f.mp4", order_of_viewport(w.session.workspace, w.session.views), w.session.settings);
                 const auto line = render_line(w.session.workspace, w.session.files, w.session.dialogs, order, "f.mp4");
                 EXPECT_TRUE(line->ends_with(said + " -o f.mp4")) << *line;
             }});
    };
    films("film", "turn", " --turntable 120");
    films("rate", "12", " --play --rate 12");
    look("picture.turntable", "60",
         [](CommandWorld& w) { EXPECT_EQ(w.session.settings.picture_export.turntable, 60); });
    look("file.copy_picture", "", [](CommandWorld& w) {
        EXPECT_EQ(w.maker.drawn->size, (PictureSize{800, 600}));
        EXPECT_GT(w.desktop.picture_bytes, 100u);
    });
    look("picture.file", "@here.png",
         [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.exporting.file, w.path("here.png")); });
    look("picture.browse", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::export_file); });
    const auto exports = [&](const std::string& option, const std::string& text,
                             std::function<void(CommandWorld&)> check) {
        add({"picture." + option, text, {}, [check](CommandWorld& w) {
                 run_command(w.session, "picture.write", w.path("x.png"));
                 ASSERT_TRUE(std::filesystem::exists(w.folder.file("x.png")));
                 check(w);
             }});
    };
    exports("size", "640x360", [](CommandWorld& w) { EXPECT_EQ(w.maker.drawn->size, (PictureSize{640, 360})); });
    look("picture.shape", "free", [](CommandWorld& w) { EXPECT_FALSE(w.session.settings.picture_export.keeps_shape); });
    exports("scale", "2", [](CommandWorld& w) {
        EXPECT_NE(render_line(w.session.workspace, w.session.files, w.session.dialogs,
                              order_to_export(w.session.settings, w.session.workspace, w.session.views), "p.png")
                      ->find(" --scale 2 "),
                  std::string::npos);
    });
    exports("samples", "8", [](CommandWorld& w) { EXPECT_EQ(w.maker.samples, 8); });
    exports("background", "transparent", [](CommandWorld& w) { EXPECT_EQ(w.maker.drawn->background->a, 0); });
    exports("theme", "light", [](CommandWorld& w) {
        EXPECT_FALSE(w.maker.drawn->palette.dark);
        EXPECT_EQ(w.view().theme, Theme::dark) << "of the picture alone";
    });
    exports("without", "legend boxes", [](CommandWorld& w) {
        EXPECT_TRUE(w.maker.drawn->boxes.empty());
        EXPECT_TRUE(w.view().boxes);
    });
    add({"picture.write", "@p.png", {{"picture.size", "640x360"}}, [](CommandWorld& w) {
             EXPECT_TRUE(std::filesystem::exists(w.folder.file("p.png")));
             EXPECT_EQ(w.maker.drawn->size, (PictureSize{640, 360}));
         }});
    add({"picture.copy", "", {{"picture.size", "640x360"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.maker.drawn->size, (PictureSize{640, 360}));
             EXPECT_GT(w.desktop.picture_bytes, 100u);
         }});
    add({"picture.copy_command", "", {{"picture.size", "640x360"}, {"picture.without", "legend"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.desktop.text, "mobbscope render " + w.path("scene.json") + " --no-legend --size 640x360 -o " +
                                           w.path("scene.png"));
         }});
    look("file.copy_command", "", [](CommandWorld& w) {
        EXPECT_EQ(w.desktop.text, "mobbscope render " + w.path("scene.json") + " --size 800x600 -o picture.png");
    });
    look("file.review", "", [](CommandWorld& w) {
        EXPECT_EQ(w.session.dialogs.now, Dialog::folder);
        EXPECT_EQ(w.session.dialogs.name(), "review");
    });
    look("file.quit", "", [](CommandWorld& w) { EXPECT_TRUE(w.session.files.closed()); });

    // Clips
    look("clip.import", "", [](CommandWorld& w) {
        EXPECT_EQ(w.session.dialogs.now, Dialog::import_clip);
        EXPECT_EQ(w.session.imports.edited.clip, 0);
    });
    look("clip.import", "stand unit", [](CommandWorld& w) {
        EXPECT_EQ(w.session.imports.edited.clip, 1);
        EXPECT_EQ(w.session.imports.edited.field, "unit");
    });
    edit("clip.set", "unit cm", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.scene().clips[0].options.unit, "cm");
        EXPECT_NEAR(w.session.workspace.fitted().tree(0).clip().samples()[30].x, 0.01, 1e-9);
    });
    add({"clip.set", "trim", {{"clip.set", "trim 0.5 1"}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.session.workspace.scene().clips[0].options.trim);
             EXPECT_EQ(w.session.workspace.fitted().tree(0).clip().count(), 60);
         }});
    edit("clip.motion", "linear", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.scene().clips[0].options.motion, mobb::Motion::linear);
        EXPECT_EQ(w.session.workspace.fitted().tree(0).clip().motion(), mobb::Motion::linear);
    });

    // Edit
    add({"edit.undo", "", {kSelectB, {"agent.move", "4 5"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.agent(1).placement.translate, glm::dvec2(1, -1));
             EXPECT_FALSE(w.session.workspace.modified());
         }});
    add({"edit.redo", "", {kSelectB, {"agent.move", "4 5"}, {"edit.undo", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.agent(1).placement.translate, glm::dvec2(4, 5));
         }});
    add({"view.previous", "", {{"view.top", ""}, {"view.boxes", ""}}, [](CommandWorld& w) {
             EXPECT_TRUE(w.view().boxes);
             EXPECT_EQ(w.view().camera.preset, CameraPreset::top);
         }});
    add({"view.next", "", {{"view.boxes", ""}, {"view.previous", ""}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.view().boxes);
         }});
    look("edit.history", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::history); });
    add({"edit.go_to",
         "1",
         {kSelectB, {"agent.move", "4 5"}, {"agent.move", "6 7"}, {"agent.turn", "8"}},
         [](CommandWorld& w) {
             EXPECT_EQ(w.agent(1).placement.translate, glm::dvec2(4, 5));
             EXPECT_EQ(w.agent(1).placement.rotate_deg, 90);
             run_command(w.session, "edit.go_to", "3");
             EXPECT_EQ(w.agent(1).placement.rotate_deg, 8) << "and on again";
             EXPECT_NE(refusal(w.session, "edit.go_to", "4"), "");
         }});
    add({"edit.copy_figures", "", {{"go.node", "B 1"}}, [](CommandWorld& w) {
             EXPECT_TRUE(w.desktop.text.starts_with("B 1.0\n")) << w.desktop.text;
             EXPECT_NE(w.desktop.text.find("\nsamples\t0..29 (30)\n"), std::string::npos) << w.desktop.text;
         }});
    edit("agent.add", "stand", [](CommandWorld& w) {
        ASSERT_EQ(w.session.workspace.scene().agents.size(), 4u);
        EXPECT_EQ(w.agent(3).name, "stand");
        EXPECT_EQ(w.session.workspace.selection.path.agent, 3);
        EXPECT_GT(w.agent(3).placement.translate.y, 9.4) << "beside the others";
    });
    add({"agent.make",
         "",
         {{"file.open", "@walk.csv"}},
         [](CommandWorld& w) {
             ASSERT_EQ(w.session.workspace.scene().agents.size(), 1u);
             EXPECT_EQ(w.agent(0).name, "walk");
         },
         true});
    edit("agent.duplicate", "", [](CommandWorld& w) {
        ASSERT_EQ(w.session.workspace.scene().agents.size(), 4u);
        EXPECT_EQ(w.agent(3).name, "B 2");
        EXPECT_NEAR(glm::distance(w.agent(3).placement.translate, w.agent(1).placement.translate), 1, 1e-9);
        EXPECT_EQ(w.session.workspace.selection.path.agent, 3);
    });
    edit("agent.remove", "", [](CommandWorld& w) {
        ASSERT_EQ(w.session.workspace.scene().agents.size(), 2u);
        EXPECT_EQ(w.agent(1).name, "C");
        EXPECT_EQ(w.session.workspace.selection, Selection{});
    });
    edit("agent.rename", "late walker", [](CommandWorld& w) { EXPECT_EQ(w.agent(1).name, "late walker"); });
    edit("agent.move", "2.5 -3", [](CommandWorld& w) {
        EXPECT_EQ(w.agent(1).placement.translate, glm::dvec2(2.5, -3));
        EXPECT_EQ(w.session.workspace.history.undo_title(), "moving B: x 2.50 m, y -3.00 m");
    });
    edit("agent.nudge", "0.5 1",
         [](CommandWorld& w) { EXPECT_EQ(w.agent(1).placement.translate, glm::dvec2(1.5, 0)); });
    edit("agent.turn", "-45", [](CommandWorld& w) { EXPECT_EQ(w.agent(1).placement.rotate_deg, -45); });
    edit("agent.start", "3", [](CommandWorld& w) { EXPECT_EQ(w.agent(1).placement.start, 3); });
    add({"agent.shift_start",
         "-2",
         {{"go.agent", "C"}},
         [](CommandWorld& w) { EXPECT_EQ(w.agent(2).placement.start, -1.5); },
         true});
    edit("agent.color", "#102030", [](CommandWorld& w) { EXPECT_EQ(w.agent(1).color, (Color{0x10, 0x20, 0x30})); });
    add({"agent.color",
         "none",
         {kSelectB, {"agent.color", "#102030"}},
         [](CommandWorld& w) { EXPECT_FALSE(w.agent(1).color); },
         true});

    // View
    add({"view.iso", "", {{"view.top", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().camera.preset, CameraPreset::iso);
         }});
    add({"view.top", "", {{"view.zoom_in", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().camera.preset, CameraPreset::top);
             EXPECT_TRUE(w.view().camera.target) << "it turns, and stays as near";
         }});
    look("view.front", "", [](CommandWorld& w) { EXPECT_EQ(w.view().camera.preset, CameraPreset::front); });
    look("view.side", "", [](CommandWorld& w) { EXPECT_EQ(w.view().camera.preset, CameraPreset::side); });
    look("view.perspective", "", [](CommandWorld& w) { EXPECT_FALSE(w.view().camera.perspective); });
    add({"view.frame", "", {{"go.agent", "C"}}, [](CommandWorld& w) {
             ASSERT_TRUE(w.view().camera.target);
             EXPECT_NEAR(w.view().camera.target->x, 1, 0.1);
             EXPECT_NEAR(w.view().camera.target->y, 9, 0.1);
             EXPECT_NEAR(w.view().camera.target->z, 1.5 * w.view().time_height, 0.1);
         }});
    add({"view.frame", "", {{"view.zoom_in", ""}}, [](CommandWorld& w) { EXPECT_FALSE(w.view().camera.target); }});
    look("view.follow_test", "", [](CommandWorld& w) { EXPECT_TRUE(w.session.views.follow_test); });
    add({"view.frame_all", "", {{"view.orbit", "10 5"}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.view().camera.target);
             EXPECT_NEAR(w.view().camera.yaw_deg, orientation(Camera{}).yaw_deg - 10, 1e-4) << "the direction stays";
         }});
    add({"view.zoom", "2", {{"view.zoom", "1"}}, [](CommandWorld& w) {
             const double near_by = w.view().camera.distance;
             w.session.edits.previous_view();
             run_command(w.session, "view.zoom", "1");
             EXPECT_NEAR(w.view().camera.distance, 2 * near_by, 1e-6 * near_by);
         }});
    add({"view.zoom_in", "", {{"view.zoom", "1"}}, [](CommandWorld& w) {
             const double distance = w.view().camera.distance;
             run_command(w.session, "view.zoom_in");
             EXPECT_LT(w.view().camera.distance, distance);
         }});
    add({"view.zoom_out", "", {{"view.zoom", "1"}}, [](CommandWorld& w) {
             const double distance = w.view().camera.distance;
             run_command(w.session, "view.zoom_out");
             EXPECT_GT(w.view().camera.distance, distance);
         }});
    look("view.orbit", "10 -5", [](CommandWorld& w) {
        EXPECT_EQ(w.view().camera.preset, CameraPreset::free);
        EXPECT_NEAR(w.view().camera.yaw_deg, orientation(Camera{}).yaw_deg - 10, 1e-4);
        EXPECT_NEAR(w.view().camera.pitch_deg, orientation(Camera{}).pitch_deg - 5, 1e-4);
        EXPECT_GT(w.view().time_height, 0) << "the target is measured in it";
    });
    look("view.orbit_left", "",
         [](CommandWorld& w) { EXPECT_NEAR(w.view().camera.yaw_deg, orientation(Camera{}).yaw_deg + 5, 1e-4); });
    look("view.orbit_right", "",
         [](CommandWorld& w) { EXPECT_NEAR(w.view().camera.yaw_deg, orientation(Camera{}).yaw_deg - 5, 1e-4); });
    look("view.orbit_up", "",
         [](CommandWorld& w) { EXPECT_NEAR(w.view().camera.pitch_deg, orientation(Camera{}).pitch_deg - 5, 1e-4); });
    look("view.orbit_down", "",
         [](CommandWorld& w) { EXPECT_NEAR(w.view().camera.pitch_deg, orientation(Camera{}).pitch_deg + 5, 1e-4); });
    add({"view.pan", "100 0", {{"view.top", ""}, {"view.zoom", "1"}}, [](CommandWorld& w) {
             const glm::dvec3 moved = *w.view().camera.target;
             run_command(w.session, "view.pan", "-100 0");
             EXPECT_LT(moved.x, w.view().camera.target->x) << "the scene moves right, the eye left";
         }});
    add({"view.moment", "", {{"view.zoom_in", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().show, Show::moment);
             EXPECT_FALSE(w.view().camera.target) << "heights mean something else: the scene is framed anew";
             const double time_height = w.view().time_height;
             run_command(w.session, "view.zoom_in");
             ASSERT_TRUE(w.view().camera.target);
             EXPECT_EQ(w.view().time_height, time_height) << "a moment says nothing of time's height";
             run_command(w.session, "go.agent", "C");
             run_command(w.session, "view.frame");
             EXPECT_NEAR(w.view().camera.target->x, 1, 0.1);
             EXPECT_NEAR(w.view().camera.target->y, 9, 0.1);
             EXPECT_NEAR(w.view().camera.target->z, 0.875, 0.01) << "half a person's height";
             run_command(w.session, "view.moment");
             EXPECT_EQ(w.view().show, Show::space_time);
             EXPECT_TRUE(w.view().camera.target) << "as it was before";
             run_command(w.session, "view.moment");
         }});
    look("view.plan", "", [](CommandWorld& w) {
        EXPECT_EQ(w.view().show, Show::plan);
        EXPECT_EQ(w.view().camera.preset, CameraPreset::top);
    });
    look("view.slab", "0.5:1.25", [](CommandWorld& w) { EXPECT_EQ(w.view().slab, (ValueRange{0.5, 1.25})); });
    add({"view.no_slab", "", {{"view.slab", "0.5:1.25"}}, [](CommandWorld& w) { EXPECT_FALSE(w.view().slab); }});
    look("view.measure", "", [](CommandWorld& w) {
        EXPECT_TRUE(w.session.workspace.measuring.picks);
        EXPECT_TRUE(find_command("view.measure")->checked(w.session));
        run_command(w.session, "view.measure");
        EXPECT_TRUE(w.session.workspace.measuring.is_nothing());
    });
    look("view.measure", "1,2,3:4,6,3.5", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.measuring.line(), (MeasuredLine{{1, 2, 3}, {4, 6, 3.5}}));
        EXPECT_FALSE(w.session.workspace.measuring.picks);
        EXPECT_FALSE(find_command("view.measure")->checked(w.session)) << "choosing it measures anew";
    });
    add({"view.copy_measured", "", {{"view.measure", "0,0,0:3,4,2"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.desktop.text, "distance\t5 m\ntime\t2 s\nspeed\t2.5 m/s\nplaces\t0,0,0:3,4,2\n");
         }});
    look("view.split", "", [](CommandWorld& w) {
        ASSERT_EQ(w.session.views.count(), 2u);
        EXPECT_EQ(w.session.views.at(0).fitted->options().tree, mobb::TreeKind::mobb);
        EXPECT_EQ(w.session.views.at(1).fitted->options().tree, mobb::TreeKind::umobb);
        run_command(w.session, "view.split");
        EXPECT_EQ(w.session.views.count(), 1u);
        run_command(w.session, "tree.kind", "umobb");
        run_command(w.session, "view.split");
        EXPECT_EQ(w.session.views.at(1).fitted->options().tree, mobb::TreeKind::mobb);
        // What another view was fitted with before is not kept for the next.
        run_command(w.session, "view.split");
        run_command(w.session, "tree.leaf", "7");
        run_command(w.session, "view.split");
        EXPECT_EQ(w.session.views.at(1).fitted->options().leaf, 7);
        EXPECT_EQ(w.session.workspace.document().fitted->fits().size(), 2u);
        // A kind that was changed in its view is not taken for what the view was split with.
        run_command(w.session, "view.other");
        run_command(w.session, "tree.kind", "umobb");
        run_command(w.session, "view.split");
        run_command(w.session, "view.split");
        EXPECT_NE(w.session.views.at(0).fitted->options().tree, w.session.views.at(1).fitted->options().tree);
    });
    add({"view.other", "", {{"view.split", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.views.active(), 1u);
             EXPECT_EQ(w.session.workspace.fitted().options().tree, mobb::TreeKind::umobb);
             run_command(w.session, "view.other");
             EXPECT_EQ(w.session.views.active(), 0u);
         }});
    add({"file.copy_command", "", {{"view.split", ""}, {"view.other", ""}}, [](CommandWorld& w) {
             EXPECT_NE(w.desktop.text.find(" --tree umobb --leaf 4 --levels 0 --axes endpoints --time-scale 1 "),
                       std::string::npos)
                 << "the file has another fit: " << w.desktop.text;
             run_command(w.session, "view.other");
             run_command(w.session, "view.split");
             run_command(w.session, "file.copy_command");
             EXPECT_EQ(w.desktop.text.find("--tree"), std::string::npos) << w.desktop.text;
         }});
    add({"view.link_cameras", "", {{"view.split", ""}}, [](CommandWorld& w) {
             run_command(w.session, "view.top");
             EXPECT_EQ(w.session.views.at(1).view.camera.preset, CameraPreset::iso);
             run_command(w.session, "view.link_cameras");
             EXPECT_EQ(w.session.views.at(1).view.camera.preset, CameraPreset::top);
         }});
    add({"view.link_times", "", {{"view.split", ""}}, [](CommandWorld& w) {
             run_command(w.session, "time.at", "0.3");
             EXPECT_FALSE(w.session.views.at(1).view.time);
             run_command(w.session, "view.link_times");
             EXPECT_EQ(w.session.views.at(1).view.time, 0.3);
         }});
    add({"view.link_levels", "", {{"view.split", ""}}, [](CommandWorld& w) {
             run_command(w.session, "view.level", "1");
             EXPECT_EQ(w.session.views.at(1).view.levels, LevelRange());
             run_command(w.session, "view.link_levels");
             EXPECT_EQ(w.session.views.at(1).view.levels.last, 1);
         }});
    add({"view.link_queries", "", {{"view.split", ""}}, [](CommandWorld& w) {
             run_command(w.session, "query.select", "0");
             EXPECT_FALSE(w.session.views.at(1).view.query);
             run_command(w.session, "view.link_queries");
             EXPECT_EQ(w.session.views.at(1).view.query, 0);
         }});
    add({"view.link_selections", "", {{"view.split", ""}, {"go.node", "A 1.1"}}, [](CommandWorld& w) {
             run_command(w.session, "view.other");
             EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::path) << "other trees have other nodes";
             run_command(w.session, "view.link_selections");
             run_command(w.session, "go.node", "A 1.1");
             run_command(w.session, "view.other");
             EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::node);
         }});
    look("compare.paper", "", [](CommandWorld& w) {
        ASSERT_EQ(w.session.views.count(), 2u);
        EXPECT_EQ(w.session.views.at(0).fitted->options().tree, mobb::TreeKind::mobb);
        EXPECT_EQ(w.session.views.at(1).fitted->options().tree, mobb::TreeKind::umobb);
        EXPECT_EQ(w.view().levels.last, 2);
    });
    look("compare.fits", "mobb,leaf=10 moving aabb,levels=2", [](CommandWorld& w) {
        ASSERT_EQ(w.session.views.count(), 3u);
        EXPECT_EQ(w.session.views.at(0).fitted->options().leaf, 10);
        EXPECT_EQ(w.session.views.at(1).fitted->options().leaf, 4) << "as in the active view";
        EXPECT_EQ(w.session.views.at(2).fitted->options().levels, 2);
        EXPECT_NE(refusal(w.session, "compare.fits", "mobb"), "");
        EXPECT_NE(refusal(w.session, "compare.fits", "mobb oak"), "");
    });
    look("compare.add", "moving", [](CommandWorld& w) {
        ASSERT_EQ(w.session.views.count(), 2u);
        EXPECT_EQ(w.session.views.at(1).fitted->options().tree, mobb::TreeKind::moving);
    });
    add({"view.close", "0", {{"view.split", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.views.count(), 1u);
             EXPECT_EQ(w.session.workspace.fitted().options().tree, mobb::TreeKind::umobb);
         }});
    for (const ViewOption& option : view_options()) {
        if (!option.toggle || !option.command.starts_with("view.")) continue;
        look(std::string(option.command), "", [&option](CommandWorld& w) {
            const bool now = !(ViewState{}.*option.toggle);
            EXPECT_EQ(w.view().*option.toggle, now) << option.key;
            EXPECT_EQ(find_command(option.command)->checked(w.session), now);
        });
    }
    add({"node.isolate", "", {{"go.node", "B 1.0"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().subtree, (DrawnNode{1, 1}));
             run_command(w.session, "file.save");
             run_command(w.session, "node.isolate");
             EXPECT_EQ(w.view().subtree, std::nullopt);
             run_command(w.session, "file.copy_command");
             EXPECT_NE(w.desktop.text.find(" --subtree none"), std::string::npos) << w.desktop.text;
         }});
    add({"node.show_all", "", {{"go.node", "B 1.0"}, {"node.isolate", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().subtree, std::nullopt);
             run_command(w.session, "node.isolate");
             run_command(w.session, "file.copy_command");
             EXPECT_NE(w.desktop.text.find(" --subtree B:1"), std::string::npos) << w.desktop.text;
         }});
    add({"agent.hide", "", {kSelectB}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().hidden, std::vector<std::string>{"B"});
             run_command(w.session, "file.save");
             run_command(w.session, "agents.hide", "A");
             run_command(w.session, "file.copy_command");
             EXPECT_NE(w.desktop.text.find(" --hide A B"), std::string::npos) << w.desktop.text;
             run_command(w.session, "agent.show_all");
             run_command(w.session, "file.copy_command");
             EXPECT_NE(w.desktop.text.find(" --hide none"), std::string::npos) << w.desktop.text;
         }});
    add({"agent.solo", "", {kSelectB}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().hidden, (std::vector<std::string>{"A", "C"}));
         }});
    look("agents.pin", "C", [](CommandWorld& w) { EXPECT_EQ(w.view().pinned, std::vector<std::string>{"C"}); });
    add({"agent.pin", "", {kSelectB}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().pinned, std::vector<std::string>{"B"});
         }});
    look("agents.foreground", "C", [](CommandWorld& w) {
        EXPECT_EQ(w.view().foreground, std::vector<std::string>{"C"});
        run_command(w.session, "file.save");
        run_command(w.session, "agents.foreground", "A");
        run_command(w.session, "file.copy_command");
        EXPECT_NE(w.desktop.text.find(" --foreground A C"), std::string::npos) << w.desktop.text;
    });
    add({"agent.foreground", "", {kSelectB}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().foreground, std::vector<std::string>{"B"});
             run_command(w.session, "agent.foreground");
             EXPECT_TRUE(w.view().foreground.empty());
         }});
    add({"agent.all_in_full", "", {{"agents.foreground", "A"}, {"view.top", ""}}, [](CommandWorld& w) {
             EXPECT_TRUE(w.view().foreground.empty());
             EXPECT_NE(w.view().camera.preset, CameraPreset::top) << "seen from where it was before";
         }});
    look("agents.hide", "clip:walk", [](CommandWorld& w) { EXPECT_EQ(w.view().hidden.size(), 3u); });
    look("agents.solo", "A", [](CommandWorld& w) {
        EXPECT_EQ(w.view().hidden, (std::vector<std::string>{"B", "C"}));
        run_command(w.session, "agents.solo", "A");
        EXPECT_TRUE(w.view().hidden.empty());
    });
    add({"agent.show_all", "", {{"agents.hide", "A"}}, [](CommandWorld& w) { EXPECT_TRUE(w.view().hidden.empty()); }});
    look("view.arrange", "", [](CommandWorld& w) {
        EXPECT_EQ(w.view().arrange, Arrange::grid);
        run_command(w.session, "view.arrange", "none");
        EXPECT_EQ(w.view().arrange, Arrange::none);
    });
    add({"view.projection", "", {{"go.sample", "A 7"}}, [](CommandWorld& w) {
             const mobb::Node& leaf = w.session.workspace.fitted()
                                          .tree(0)
                                          .nodes()[static_cast<std::size_t>(w.view().projection.value().node)];
             EXPECT_TRUE(leaf.is_leaf() && leaf.first <= 7 && 7 < leaf.end());
             EXPECT_EQ(w.view().projection->agent, 0);
             EXPECT_EQ(w.view().projection->sample, 7);
             EXPECT_NO_THROW(build_draw_list(w.session.workspace.fitted(), w.view(), PictureSize{320, 240}));
             w.session.workspace.select({});
             run_command(w.session, "tree.levels", "1");
             EXPECT_FALSE(w.view().projection) << "its leaf is gone";
             EXPECT_FALSE(find_command("view.projection")->enabled(w.session));
         }});
    add({"view.projection", "", {{"go.sample", "A 7"}, {"view.projection", ""}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.view().projection) << "once more: all else again";
         }});
    look("view.color_by", "", [](CommandWorld& w) { EXPECT_EQ(w.view().color_by, ColorBy::level); });
    look("view.color_by", "agent", [](CommandWorld& w) { EXPECT_EQ(w.view().color_by, ColorBy::agent); });
    look("view.color_range", "0:5", [](CommandWorld& w) { EXPECT_EQ(w.view().color_range, (ValueRange{0, 5})); });
    in_query("view.level", "1:3", [](CommandWorld& w) {
        EXPECT_EQ(w.view().levels, (LevelRange{1, 3, false}));
        EXPECT_FALSE(w.view().query);
    });
    add({"view.finer", "", {{"view.level", "1:2"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().levels, (LevelRange{2, 3, false}));
         }});
    add({"view.coarser", "", {{"view.level", "1:2"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().levels, (LevelRange{0, 1, false}));
         }});
    add({"view.coarser", "", {{"view.leaves", ""}}, [](CommandWorld& w) {
             const int deepest = w.session.workspace.fitted().tree(0).depth() - 1;
             EXPECT_EQ(w.view().levels, (LevelRange{deepest, deepest, false}));
         }});
    look("view.leaves", "", [](CommandWorld& w) { EXPECT_TRUE(w.view().levels.leaves); });
    look("view.time_height", "2.5", [](CommandWorld& w) { EXPECT_EQ(w.view().time_height, 2.5); });
    add({"view.time_height", "auto", {{"view.time_height", "3"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().time_height, 0);
         }});
    look("view.past", "", [](CommandWorld& w) { EXPECT_EQ(w.view().past, Past::siblings) << "from ancestors on"; });
    look("view.past", "pair", [](CommandWorld& w) { EXPECT_EQ(w.view().past, Past::pair); });
    add({"view.past", "", {{"view.past", "all"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().past, Past::pair) << "the first follows the last";
         }});
    look("view.inset", "", [](CommandWorld& w) { EXPECT_FALSE(w.view().inset); });
    add({"view.fold_legend", "", {{"view.fold_legend", ""}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.view().fold_legend);
         }});
    look("bottom.show", "nodes", [](CommandWorld& w) { EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::nodes); });
    look("view.theme", "", [](CommandWorld& w) { EXPECT_EQ(w.view().theme, Theme::light); });
    look("view.theme", "dark", [](CommandWorld& w) { EXPECT_EQ(w.view().theme, Theme::dark); });
    look("window.scale", "1.3", [](CommandWorld& w) { EXPECT_EQ(w.session.settings.ui_scale, 1.3); });
    add({"window.larger", "", {{"window.scale", "1.25"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.settings.ui_scale, 1.5);
         }});
    add({"window.smaller", "", {{"window.scale", "1.3"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.settings.ui_scale, 1.25);
         }});
    add({"window.scale_reset", "", {{"window.scale", "1.3"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.settings.ui_scale, 0);
         }});

    // Time
    look("time.at", "0.75", [](CommandWorld& w) { EXPECT_EQ(w.view().time, 0.75); });
    add({"time.clear", "", {{"time.at", "1"}}, [](CommandWorld& w) { EXPECT_FALSE(w.view().time); }});
    look("time.play", "", [](CommandWorld& w) {
        EXPECT_TRUE(w.session.playback.playing());
        EXPECT_EQ(w.view().time, 0);
    });
    add({"time.play", "", {{"time.play", ""}}, [](CommandWorld& w) { EXPECT_FALSE(w.session.playback.playing()); }});
    look("time.start", "", [](CommandWorld& w) { EXPECT_EQ(w.view().time, 0); });
    look("time.end", "", [](CommandWorld& w) { EXPECT_NEAR(*w.view().time, 2.5, 1e-6); });
    add({"time.forward", "", {{"time.at", "1.01"}}, [](CommandWorld& w) {
             EXPECT_NEAR(*w.view().time, 31 / 30.0, 1e-4);
         }});
    add({"time.back", "", {{"time.at", "1.01"}}, [](CommandWorld& w) {
             EXPECT_NEAR(*w.view().time, 30 / 30.0, 1e-4);
         }});
    look("time.speed", "0.25", [](CommandWorld& w) { EXPECT_EQ(w.session.playback.speed, 0.25); });

    // Tree
    edit("tree.kind", "umobb", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.scene().fit.tree, mobb::TreeKind::umobb);
        EXPECT_EQ(w.session.workspace.fitted().tree(0).options().tree, mobb::TreeKind::umobb);
    });
    edit("tree.axes", "covariance", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.fitted().tree(0).options().axes, mobb::Axes::covariance);
    });
    edit("tree.leaf", "7", [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.fitted().tree(0).options().leaf, 7); });
    edit("tree.levels", "2", [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.fitted().tree(0).depth(), 2); });
    edit("tree.time_scale", "2.5",
         [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.fitted().tree(0).time_scale(), 2.5); });
    look("tree.cost_of", "queries",
         [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.workload(), QueryWorkload::Kind::queries); });

    edit("tree.fit", "moving,leaf=7", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.scene().fit.tree, mobb::TreeKind::moving);
        EXPECT_EQ(w.session.workspace.scene().fit.leaf, 7);
    });
    look("tree.sweep", "", [](CommandWorld& w) { EXPECT_TRUE(w.session.sweeps.result()->rows->has_ended()); });
    look("tree.sweep_axes", "", [](CommandWorld& w) { EXPECT_TRUE(w.session.sweeps.over_axes); });
    look("tree.sweep_time_scale", "", [](CommandWorld& w) { EXPECT_TRUE(w.session.sweeps.over_time_scale); });
    add({"tree.sweep_apply",
         "",
         {{"tree.sweep", ""}},
         [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.scene().fit.tree, mobb::TreeKind::blocks) << "planted as the fastest";
         },
         true});

    // The walk of 2 s in free boxes: its levels grow, and its leaves of 4 samples are too small.
    const std::pair<std::string, std::string> in_free_boxes{"tree.kind", "umobb"};
    add({"tree.next_finding", "", {in_free_boxes}, [](CommandWorld& w) {
             const int last = w.session.workspace.fitted().tree(0).depth() - 1;
             EXPECT_EQ(w.view().levels, (LevelRange{last, last, false}));
             EXPECT_NE(all_messages(w.session).find("Boxes grow below level 0"), std::string::npos);
         }});
    add({"tree.see_finding", "1", {in_free_boxes}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.notices.of(0)->seen, 1);
         }});
    add({"tree.mend",
         "0",
         {in_free_boxes},
         [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.scene().fit.tree, mobb::TreeKind::mobb); },
         true});
    add({"tree.mend",
         "",
         {in_free_boxes, {"tree.see_finding", "1"}},
         [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.scene().fit.leaf, 64); },
         true});

    // Query
    look("query.select", "2", [](CommandWorld& w) {
        EXPECT_EQ(w.view().query, 2);
        EXPECT_EQ(w.view().step, Step{});
    });
    look("query.next", "", [](CommandWorld& w) { EXPECT_EQ(w.view().query, 0); });
    in_query("query.next", "", [](CommandWorld& w) {
        EXPECT_EQ(w.view().query, 1);
        EXPECT_EQ(w.view().step, Step{});
    });
    look("query.previous", "", [](CommandWorld& w) { EXPECT_EQ(w.view().query, 2); });
    add({"query.previous", "", {{"query.select", "2"}}, [](CommandWorld& w) { EXPECT_EQ(w.view().query, 1); }});
    add({"query.none", "", {kSelectB, kFirstQuery}, [](CommandWorld& w) {
             EXPECT_FALSE(w.view().query);
             EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::path) << "one thing after the other";
         }});
    // Asked already, as all pairs are: only shown.
    add({"query.add", "C", {kSelectB}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().query, 2);
             EXPECT_FALSE(w.session.workspace.modified());
         }});
    add({"query.add",
         "C",
         {{"query.select", "2"}, {"query.remove", ""}, kSelectB},
         [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.fitted().queries().size(), 3u);
             EXPECT_EQ(w.view().query, 2);
             EXPECT_EQ(w.session.workspace.fitted().queries()[2].b.name, "C");
         },
         true});
    add({"query.remove",
         "",
         {kFirstQuery},
         [](CommandWorld& w) {
             ASSERT_EQ(w.session.workspace.scene().queries.size(), 2u);
             EXPECT_EQ(w.session.workspace.fitted().queries()[0].b.name, "C");
             EXPECT_FALSE(w.view().query);
         },
         true});
    in_query("query.judge", "",
             [](CommandWorld& w) { EXPECT_TRUE(w.session.queries.findings()->recursion.avoidable.all_judged()); });
    // The table of nodes
    const std::pair<std::string, std::string> of_nodes{"bottom.show", "nodes"};
    look("nodes.filter", "fill < 50 %", [](CommandWorld& w) {
        EXPECT_EQ(w.session.nodes.filter->text(), "fill < 50 %");
        EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::nodes);
    });
    add({"nodes.all", "", {{"nodes.filter", "leaf"}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.session.nodes.filter);
             EXPECT_EQ(static_cast<int>(w.session.nodes.listed()->size()), w.session.nodes.values()->size());
         }});
    look("nodes.sort", "level", [](CommandWorld& w) {
        EXPECT_EQ(w.session.nodes.by, NodeField::level);
        EXPECT_FALSE(w.session.nodes.descending);
        EXPECT_EQ(w.session.nodes.listed()->front(), 0);
        EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::nodes) << "the table is shown";
    });
    look("nodes.count", "", [](CommandWorld& w) {
        EXPECT_TRUE(w.session.nodes.values()->has(NodeField::tests));
        EXPECT_TRUE(w.session.nodes.values()->has(NodeField::avoidable));
    });
    add({"nodes.copy", "", {{"nodes.filter", "level < 1"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.desktop.text.substr(0, 10), "node\tlevel");
         }});
    add({"nodes.copy_csv", "", {{"nodes.filter", "level < 1"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.desktop.text.substr(0, 10), "node,level");
         }});
    look("rows.find", "", [](CommandWorld& w) {
        EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::nodes);
        EXPECT_EQ(w.session.keys.field, "nodes.filter");
    });
    add({"rows.next", "", {of_nodes}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.nodes.selected(), w.session.nodes.listed()->front());
         }});
    add({"rows.previous", "", {of_nodes}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.nodes.selected(), w.session.nodes.listed()->back());
         }});
    look("query.blame", "", [](CommandWorld& w) {
        ASSERT_NE(w.session.workspace.blame(), nullptr);
        EXPECT_NE(all_messages(w.session).find(" in 3 queries"), std::string::npos) << all_messages(w.session);
        w.session.workspace.edit({"moving", ""}, [](Scene& scene) { scene.agents[0].placement.start += 0.5; });
        EXPECT_EQ(w.session.workspace.blame(), nullptr) << "of another scene nobody has counted";
    });
    add({"query.expect",
         "",
         {kFirstQuery},
         [](CommandWorld& w) {
             ASSERT_TRUE(w.session.workspace.scene().queries[0].expect);
             EXPECT_EQ(w.session.workspace.scene().queries[0].expect->collides, true);
             EXPECT_EQ(w.session.workspace.scene().queries[0].expect->contact, w.session.workspace.recorded()->contact);
         },
         true});
    add({"query.expect",
         "",
         {kFirstQuery, {"query.expect", ""}},
         [](CommandWorld& w) { EXPECT_FALSE(w.session.workspace.scene().queries[0].expect); },
         true});
    in_query("map.panel", "",
             [](CommandWorld& w) { EXPECT_TRUE(w.session.settings.folded.contains(std::string(kMapSection))); });
    look("map.show", "tests", [](CommandWorld& w) { EXPECT_EQ(w.session.maps.choice.show, MapShow::tests); });
    look("map.axes", "dy,dstart", [](CommandWorld& w) {
        EXPECT_EQ(w.session.maps.choice.across, MapAxis::dy);
        EXPECT_EQ(w.session.maps.choice.up, MapAxis::dstart);
    });
    in_query("map.extent", "-1:2,-3:4", [](CommandWorld& w) {
        ASSERT_TRUE(w.session.maps.choice.extent);
        EXPECT_EQ(w.session.maps.choice.extent->second, (MapRange{MapAxis::dy, -3, 4}));
    });
    in_query("map.range", "0:2.5",
             [](CommandWorld& w) { EXPECT_EQ(w.session.maps.choice.colors, std::pair(0.0, 2.5)); });
    add({"map.place",
         "1.5 -2",
         {kFirstQuery},
         [](CommandWorld& w) { EXPECT_EQ(w.session.maps.query().b.placement.translate, glm::dvec2(1.5, -2)); },
         true});
    add({"query.capture", "0", {}, [](CommandWorld& w) {
             ASSERT_TRUE(w.session.workspace.in_excerpt());
             for (const SceneClip& clip : w.session.workspace.scene().clips) EXPECT_FALSE(clip.source) << clip.name;
             ASSERT_EQ(w.session.workspace.scene().queries.size(), 1u);
             ASSERT_TRUE(w.session.workspace.scene().queries[0].expect);
             EXPECT_EQ(w.session.workspace.scene().queries[0].expect->collides, true);
             EXPECT_EQ(w.session.workspace.scene().queries[0].expect->contact, w.session.workspace.recorded()->contact);
         }});
    look("query.copy_command", "2", [](CommandWorld& w) {
        EXPECT_EQ(w.view().query, 2);
        EXPECT_NE(w.desktop.text.find(" --query 2 "), std::string::npos) << w.desktop.text;
    });
    look("query.copy_answer", "0", [](CommandWorld& w) {
        EXPECT_EQ(w.view().query, 0);
        EXPECT_TRUE(w.desktop.text.starts_with("They collide at ")) << w.desktop.text;
    });
    add({"step.next_of_node", "", {kFirstQuery, kFirstStep, {"go.node", "A 0"}}, [](CommandWorld& w) {
             const mobb::Trace& trace = w.session.workspace.recorded()->trace;
             EXPECT_EQ(w.session.workspace.step(), 1) << "the roots' boxes, behind their times";
             for (int tests = 0; tests < 3; ++tests) {
                 run_command(w.session, "step.next_of_node");
                 EXPECT_EQ(trace[w.session.workspace.step()].a, 0);
             }
             w.session.workspace.select({});
             EXPECT_NE(refusal(w.session, "step.next_of_node"), "");
         }});
    add({"step.first", "", {kFirstQuery}, [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.step(), 0); }});
    look("step.first", "", [](CommandWorld& w) {
        EXPECT_EQ(w.view().query, 0) << "without a query in view the first is shown";
        EXPECT_EQ(w.session.workspace.step(), 0);
    });
    add({"step.back", "", {kFirstQuery, {"step.to", "5"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.step(), 4);
         }});
    in_query("step.back", "", [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.step(), 0); });
    in_query("step.forward", "", [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.step(), 1); });
    add({"step.forward", "", {kFirstQuery}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.step(), w.session.workspace.recorded()->trace.size() - 1);
         }});
    in_query("step.last", "", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.step(), w.session.workspace.recorded()->trace.size() - 1);
    });
    in_query("step.to", "3", [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.step(), 3); });
    in_query("step.to", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::palette); });
    add({"step.next_separated", "", {{"query.select", "1"}, kFirstStep}, [](CommandWorld& w) {
             EXPECT_EQ(outcome_now(w), mobb::Outcome::separated);
         }});
    in_query("step.next_separated", "", [](CommandWorld& w) {
        // The first two walk into each other at once: wherever it stands, it is the next such test or the same.
        const bool found = outcome_now(w) == mobb::Outcome::separated;
        EXPECT_NE(found, all_messages(w.session).find("no later test") != std::string::npos);
    });
    in_query("step.next_overlap", "", [](CommandWorld& w) {
        EXPECT_EQ(outcome_now(w), mobb::Outcome::overlap);
        EXPECT_GT(w.session.workspace.step(), 0);
    });
    add({"step.next_avoidable", "", {{"query.select", "1"}, kFirstStep}, [](CommandWorld& w) {
             const Recursion& recursion = w.session.queries.findings()->recursion;
             const bool found = recursion.avoidable.at(w.session.workspace.step()) != nullptr;
             EXPECT_NE(found, all_messages(w.session).find("voidable") != std::string::npos);
         }});
    add({"step.previous_avoidable", "", {{"query.select", "1"}}, [](CommandWorld& w) {
             const Recursion& recursion = w.session.queries.findings()->recursion;
             const bool found = recursion.avoidable.at(w.session.workspace.step()) != nullptr;
             EXPECT_NE(found, all_messages(w.session).find("voidable") != std::string::npos);
         }});
    in_query("step.next_hit", "", [](CommandWorld& w) { EXPECT_EQ(outcome_now(w), mobb::Outcome::hit); });
    in_query("step.next_leaf", "", [](CommandWorld& w) {
        const mobb::Tree& tree = w.session.workspace.fitted().tree(0);
        const mobb::Trace::Event event = w.session.workspace.recorded()->trace[w.session.workspace.step()];
        EXPECT_TRUE(tree.is_leaf(event.a) && tree.is_leaf(event.b));
    });
    in_query("step.next_depth", "2", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.recorded()->trace[w.session.workspace.step()].depth, 2);
    });
    add({"step.previous_depth", "0", {kFirstQuery}, [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.step(), 1); }});
    add({"step.previous_leaf", "", {kFirstQuery}, [](CommandWorld& w) {
             const mobb::Trace& trace = w.session.workspace.recorded()->trace;
             const auto& sides = w.session.queries.findings()->sides;
             const auto ends_leaves = [&](int event) {
                 const mobb::Trace::Event test = trace[event];
                 return sides[0].placed.tree().is_leaf(test.a) && sides[1].placed.tree().is_leaf(test.b) &&
                        (trace[event + 1].a != test.a || trace[event + 1].b != test.b);
             };
             int wanted = trace.size() - 2;
             while (wanted > 0 && !ends_leaves(wanted)) --wanted;
             ASSERT_GT(wanted, 0);
             EXPECT_EQ(w.session.workspace.step(), wanted);
         }});
    for (const auto& [id, outcome] : {std::pair("step.previous_separated", mobb::Outcome::separated),
                                      std::pair("step.previous_overlap", mobb::Outcome::overlap)}) {
        add({id, "", {{"query.select", "1"}}, [outcome = outcome](CommandWorld& w) {
                 const mobb::Trace& trace = w.session.workspace.recorded()->trace;
                 const int step = w.session.workspace.step();
                 const bool found = step < trace.size() - 1 && trace[step].outcome == outcome;
                 EXPECT_NE(found, all_messages(w.session).find("no test before") != std::string::npos);
             }});
    }
    in_query("step.previous_hit", "", [](CommandWorld& w) {
        EXPECT_NE(all_messages(w.session).find("There is no test before that found a hit"), std::string::npos);
    });
    in_query("step.into", "", [](CommandWorld& w) {
        const mobb::Trace& trace = w.session.workspace.recorded()->trace;
        EXPECT_EQ(trace[w.session.workspace.step()].depth, 1);
        EXPECT_EQ(trace[w.session.workspace.step() - 1].depth, 0) << "the first test of the first pair that was called";
    });
    add({"step.over_back", "", {kFirstQuery}, [](CommandWorld& w) {
             const mobb::Trace& trace = w.session.workspace.recorded()->trace;
             int wanted = trace.size() - 2;
             while (trace[wanted].depth > trace[trace.size() - 1].depth) --wanted;
             EXPECT_EQ(w.session.workspace.step(), wanted);
         }});
    in_query("step.over", "", [](CommandWorld& w) {
        const mobb::Trace& trace = w.session.workspace.recorded()->trace;
        EXPECT_EQ(w.session.workspace.step(), 1) << "the root pair's other test";
        // From an inner pair whose tests led to others, to one that is not below it.
        for (int event = 2; event + 1 < trace.size(); ++event) {
            if (trace[event + 1].depth <= trace[event].depth) continue;
            run_command(w.session, "step.to", std::to_string(event));
            if (!find_command("step.over")->enabled(w.session)) continue;
            run_command(w.session, "step.over");
            EXPECT_GT(w.session.workspace.step(), event + 1);
            EXPECT_LE(trace[w.session.workspace.step()].depth, trace[event].depth);
        }
    });
    add({"step.out", "", {kFirstQuery}, [](CommandWorld& w) {
             const mobb::Trace& trace = w.session.workspace.recorded()->trace;
             EXPECT_EQ(w.session.workspace.step(), trace[trace.size() - 1].parent);
         }});
    add({"step.before", "", {kFirstQuery, {"step.to", "3"}, kFirstStep}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.step(), 3);
             w.session.workspace.close_group();
             run_command(w.session, "step.before");
             EXPECT_EQ(w.session.workspace.step(), 0) << "and back";
         }});
    // The proof. B passes where A has not come yet, so some line keeps the two apart.
    const auto line_now = [](CommandWorld& w) { return w.session.queries.findings()->proof.at(*w.view().time); };
    const std::pair<std::string, std::string> kMiss{"query.select", "1"};
    add({"proof.next", "", {kMiss, kFirstStep}, [line_now](CommandWorld& w) {
             EXPECT_EQ(line_now(w), w.session.queries.findings()->proof.tightest);
             EXPECT_EQ(w.view().step, Step{}) << "where the walls are shown";
         }});
    add({"proof.previous", "", {kMiss}, [line_now](CommandWorld& w) {
             EXPECT_EQ(line_now(w), w.session.queries.findings()->proof.tightest);
         }});
    add({"proof.line", "0", {kMiss}, [line_now](CommandWorld& w) { EXPECT_EQ(line_now(w), 0u); }});
    add({"proof.save", "", {kMiss}, [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::save_proof); }});
    add({"proof.save", "@proof.json", {kMiss}, [](CommandWorld& w) {
             EXPECT_TRUE(std::filesystem::exists(w.path("proof.json")));
         }});
    in_query("step.percent", "50", [](CommandWorld& w) { EXPECT_EQ(w.view().step, (Step{Step::Unit::percent, 50})); });

    // Events, breakpoints, bookmarks
    in_query("events.show", "", [](CommandWorld& w) { EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::events); });
    const std::pair<std::string, std::string> separated{"events.filter", "outcome = separated"};
    in_query("events.filter", "gap < 5 cm", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.events.filter->text(), "gap < 5 cm");
        EXPECT_EQ(*w.session.queries.listed_events(),
                  steps_that_pass(w.session.queries.events(), EventFilter("gap < 0.05")));
        EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::events);
    });
    add({"events.all", "", {kFirstQuery, separated}, [](CommandWorld& w) {
             EXPECT_FALSE(w.session.workspace.events.filter);
             EXPECT_EQ(static_cast<int>(w.session.queries.listed_events()->size()), w.session.queries.events().size());
         }});
    add({"events.sort", "tests_below", {kFirstQuery, {"events.sort", "tests_below"}}, [](CommandWorld& w) {
             EXPECT_TRUE(w.session.workspace.events.descending);
             const EventValues values = w.session.queries.events();
             EXPECT_TRUE(std::ranges::is_sorted(*w.session.queries.listed_events(), std::greater(), [&](int step) {
                 return values.value(EventField::tests_below, 0, step).least;
             }));
         }});
    add({"rows.next", "", {kFirstQuery, kFirstStep, separated}, [](CommandWorld& w) {
             EXPECT_EQ(outcome_now(w), mobb::Outcome::separated) << "the present one is not listed, but has its place";
             EXPECT_EQ(w.session.workspace.step(), w.session.queries.listed_events()->front());
         }});
    add({"rows.previous", "", {kFirstQuery, separated, {"step.last", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.step(), w.session.queries.listed_events()->back());
         }});
    const std::pair<std::string, std::string> saved{"events.save", "apart"};
    add({"events.save",
         "apart",
         {kFirstQuery, separated},
         [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.scene().debug.filters,
                       (std::vector<NamedFilter>{{"apart", "outcome = separated"}}));
         },
         true});
    add({"events.saved", "apart", {kFirstQuery, separated, saved, {"events.all", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.events.filter->text(), "outcome = separated");
         }});
    add({"events.rename_saved",
         "separations",
         {kFirstQuery, separated, saved},
         [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.scene().debug.filters[0].name, "separations"); },
         true});
    add({"events.remove_saved",
         "apart",
         {kFirstQuery, separated, saved},
         [](CommandWorld& w) { EXPECT_TRUE(w.session.workspace.scene().debug.filters.empty()); },
         true});
    add({"events.copy", "", {kFirstQuery, separated}, [](CommandWorld& w) {
             EXPECT_TRUE(w.desktop.text.starts_with("step\tnode(a)\tnode(b)\t")) << w.desktop.text;
             EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(w.desktop.text, '\n')),
                       w.session.queries.listed_events()->size() + 1);
         }});
    add({"events.copy_csv", "", {kFirstQuery, separated}, [](CommandWorld& w) {
             EXPECT_TRUE(w.desktop.text.starts_with("step,node(a),node(b),")) << w.desktop.text;
         }});
    const auto breakpoints = [](const CommandWorld& w) { return w.session.workspace.scene().debug.breakpoints; };
    const std::pair<std::string, std::string> at_separations{"breakpoint.add", "outcome = separated"};
    add({"breakpoint.here",
         "",
         {kFirstQuery, kFirstStep},
         [=](CommandWorld& w) {
             EXPECT_EQ(breakpoints(w), (std::vector<Breakpoint>{{"node(a) = 0.0 and node(b) = 0.0", true}}));
         },
         true});
    add({"breakpoint.here",
         "",
         {kFirstQuery, kFirstStep, {"breakpoint.here", ""}},
         [=](CommandWorld& w) { EXPECT_TRUE(breakpoints(w).empty()); },
         true});
    add({"breakpoint.add",
         "gap < 0.1",
         {},
         [=](CommandWorld& w) {
             EXPECT_EQ(breakpoints(w), (std::vector<Breakpoint>{{"gap < 0.1", true}}));
         },
         true});
    add({"breakpoint.switch",
         "outcome = separated",
         {at_separations},
         [=](CommandWorld& w) { EXPECT_FALSE(breakpoints(w).at(0).on); },
         true});
    add({"breakpoint.remove",
         "outcome = separated",
         {at_separations},
         [=](CommandWorld& w) { EXPECT_TRUE(breakpoints(w).empty()); },
         true});
    add({"breakpoint.next", "", {kFirstQuery, kFirstStep, at_separations}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.step(), w.session.queries.break_steps().front());
             EXPECT_EQ(outcome_now(w), mobb::Outcome::separated);
         }});
    add({"breakpoint.previous", "", {kFirstQuery, at_separations, {"step.last", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.step(), w.session.queries.break_steps().back());
         }});
    const auto bookmarks = [](const CommandWorld& w) { return w.session.workspace.scene().debug.bookmarks; };
    const std::pair<std::string, std::string> to_3{"step.to", "3"}, turn{"bookmark.add", "the turn"};
    add({"bookmark.add",
         "the turn",
         {kFirstQuery, to_3},
         [=](CommandWorld& w) {
             EXPECT_EQ(bookmarks(w), (std::vector<Bookmark>{{"the turn", 0, 3, ""}}));
         },
         true});
    add({"bookmark.add",
         "",
         {kFirstQuery, kFirstStep},
         [=](CommandWorld& w) { EXPECT_EQ(bookmarks(w).at(0).name, "A 0.0, B 0.0"); },
         true});
    add({"bookmark.go", "the turn", {kFirstQuery, to_3, turn, {"query.select", "1"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().query, 0);
             EXPECT_EQ(w.session.workspace.step(), 3);
         }});
    add({"bookmark.rename",
         "the bend",
         {kFirstQuery, to_3, turn},
         [=](CommandWorld& w) { EXPECT_EQ(bookmarks(w).at(0).name, "the bend"); },
         true});
    add({"bookmark.note",
         "B's box is loose",
         {kFirstQuery, to_3, turn},
         [=](CommandWorld& w) { EXPECT_EQ(bookmarks(w).at(0).note, "B's box is loose"); },
         true});
    add({"bookmark.remove",
         "the turn",
         {kFirstQuery, to_3, turn},
         [=](CommandWorld& w) { EXPECT_TRUE(bookmarks(w).empty()); },
         true});
    const auto named = [](const CommandWorld& w) { return w.session.workspace.scene().debug.views; };
    const std::pair<std::string, std::string> level_1{"view.level", "1"}, coarse{"view.save_as", "coarse"};
    add({"view.save_as",
         "coarse",
         {level_1},
         [=](CommandWorld& w) {
             ASSERT_EQ(named(w).size(), 1u);
             EXPECT_EQ(named(w)[0].name, "coarse");
             EXPECT_EQ(named(w)[0].view.levels, (LevelRange{1, 1, false}));
         },
         true});
    add({"view.go", "coarse", {level_1, coarse, {"view.leaves", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().levels, (LevelRange{1, 1, false}));
         }});
    add({"view.rename", "rough", {coarse}, [=](CommandWorld& w) { EXPECT_EQ(named(w).at(0).name, "rough"); }, true});
    add({"view.remove", "coarse", {coarse}, [=](CommandWorld& w) { EXPECT_TRUE(named(w).empty()); }, true});
    add({"step.visited_back", "", {kFirstQuery, kFirstStep, to_3}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.step(), 0);
         }});
    add({"step.visited_forward", "", {kFirstQuery, kFirstStep, to_3, {"step.visited_back", ""}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.step(), 3);
         }});
    add({"step.copy_link", "", {kFirstQuery, to_3}, [](CommandWorld& w) {
             EXPECT_EQ(w.desktop.text, w.path("scene.json") + "#q0@3");
         }});
    // Reasons and costs
    in_query("reasons.at", "0.5", [](CommandWorld& w) {
        EXPECT_EQ(w.view().time, 0.5);
        EXPECT_FALSE(w.session.queries.reasons()->pairs.empty());
    });
    in_query("reasons.of_point", "0.5 0.7",
             [](CommandWorld& w) { EXPECT_EQ(w.session.queries.reasons()->of, "0.50 s by 0.70 s"); });
    in_query("reasons.of_sample", "b 3", [](CommandWorld& w) {
        EXPECT_EQ(w.session.queries.reasons()->of, "sample 3 of B");
        EXPECT_NE(refusal(w.session, "reasons.of_sample", "c 3"), "");
        EXPECT_NE(refusal(w.session, "reasons.of_sample", "a 60"), "");
    });
    add({"reasons.of_selection", "", {kFirstQuery, {"go.sample", "B 5"}}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.queries.reasons()->of, "sample 5 of B");
         }});
    add({"reasons.none", "", {kFirstQuery, {"reasons.at", "0.5"}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.session.queries.reasons());
         }});
    in_query("compare.with", "umobb,leaf=3", [](CommandWorld& w) {
        EXPECT_EQ(w.session.queries.comparison()->trees[0]->options().leaf, 3);
        EXPECT_NE(refusal(w.session, "compare.with", "oak"), "");
        EXPECT_NE(refusal(w.session, "compare.with", "stored"), "") << "no trace is stored";
    });
    const std::pair<std::string, std::string> umobb{"compare.with", "umobb"};
    add({"compare.leaf", "7", {kFirstQuery, umobb}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.compare_with->fit->leaf, 7);
         }});
    add({"compare.at", "0.2", {kFirstQuery, umobb}, [](CommandWorld& w) {
             EXPECT_EQ(w.view().time, 0.2);
             const TraversalComparison& both = w.session.queries.comparison()->traversals;
             EXPECT_EQ(w.session.workspace.step(), both.decision(*both.at(0.2), 0).step);
         }});
    add({"compare.difference",
         "",
         {{"file.open", "@stored.json"}, kFirstQuery, {"compare.with", "stored"}},
         [](CommandWorld& w) {
             EXPECT_FALSE(w.session.queries.stored_check().agrees());
             EXPECT_EQ(w.session.workspace.step(), 1);
         }});
    add({"compare.none", "", {kFirstQuery, umobb}, [](CommandWorld& w) {
             EXPECT_FALSE(w.session.workspace.compare_with);
         }});
    in_query("focus.branch", "", [](CommandWorld& w) { EXPECT_EQ(w.session.workspace.look.focus.branch, 0); });
    in_query("focus.time", "0.1:0.2", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.look.focus.time->t1, 0.2);
        EXPECT_NE(refusal(w.session, "focus.time", "2:1"), "");
    });
    add({"focus.none", "", {kFirstQuery, {"focus.branch", "3"}}, [](CommandWorld& w) {
             EXPECT_TRUE(w.session.workspace.look.focus.is_all());
         }});
    in_query("recursion.zoom", "1:3", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.look.zoom, (EventRange{1, 4}));
    });
    add({"recursion.zoom_all", "", {kFirstQuery, {"recursion.zoom", "1:3"}}, [](CommandWorld& w) {
             EXPECT_FALSE(w.session.workspace.look.zoom);
         }});
    look("branches.of", "scene", [](CommandWorld& w) { EXPECT_EQ(w.session.costs.costs()->tests.size(), 3u); });
    look("branches.of_node", "walk 1.0", [](CommandWorld& w) { EXPECT_EQ(w.session.costs.sandwich()->of.node, 1); });
    look("query.sort", "tests",
         [](CommandWorld& w) { EXPECT_EQ(w.session.costs.listed(), w.session.costs.costs()->by_tests); });
    look("query.worst", "", [](CommandWorld& w) { EXPECT_EQ(w.view().query, w.session.costs.costs()->by_tests[0]); });

    // Go
    look("go.palette", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::palette); });
    add({"go.agent", "C", {kFirstQuery}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.selection, (Selection{Selection::Kind::path, {2, -1, 0}, -1}));
             EXPECT_FALSE(w.view().query) << "the query does not show C";
         }});
    add({"go.agent", "B", {kFirstQuery}, [](CommandWorld& w) { EXPECT_TRUE(w.view().query); }});
    look("go.clip", "stand", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.selection, (Selection{Selection::Kind::clip, {}, 1}));
    });
    look("go.node", "B 1.1", [](CommandWorld& w) {
        expect_node(w, w.session.workspace.fitted().tree(0).children(0)[1]);
        EXPECT_EQ(w.view().levels, (LevelRange{1, 1, false})) << "its level is shown";
    });
    look("go.node", "B 3", [](CommandWorld& w) { expect_node(w, 3); });
    look("go.sample", "B 59", [](CommandWorld& w) {
        EXPECT_EQ(w.session.workspace.selection, (Selection{Selection::Kind::sample, {1, -1, 0}, 59}));
    });
    add({"go.parent", "", {{"go.node", "B 1.1"}}, [](CommandWorld& w) { expect_node(w, 0); }});
    add({"go.parent", "", {{"go.sample", "B 59"}}, [](CommandWorld& w) {
             const mobb::Tree& tree = w.session.workspace.fitted().tree(0);
             expect_node(w, static_cast<int>(tree.nodes().size()) - 1);
         }});
    add({"go.child", "", {kSelectB}, [](CommandWorld& w) { expect_node(w, 0); }});
    add({"go.child", "", {{"go.node", "B 0"}}, [](CommandWorld& w) { expect_node(w, 1); }});
    add({"go.last_child", "", {{"go.node", "B 0"}}, [](CommandWorld& w) {
             expect_node(w, w.session.workspace.fitted().tree(0).children(0)[1]);
         }});
    add({"go.next_node", "", {{"go.node", "B 1.0"}}, [](CommandWorld& w) {
             expect_node(w, w.session.workspace.fitted().tree(0).children(0)[1]);
         }});
    add({"go.previous_node", "", {{"go.node", "B 1.1"}}, [](CommandWorld& w) { expect_node(w, 1); }});
    in_query("go.contact", "", [](CommandWorld& w) {
        EXPECT_EQ(w.view().time, w.session.workspace.recorded()->contact->time);
        EXPECT_EQ(outcome_now(w), mobb::Outcome::hit);
    });
    add({"go.none", "", {kSelectB, kFirstQuery}, [](CommandWorld& w) {
             EXPECT_EQ(w.session.workspace.selection, Selection{});
             EXPECT_EQ(w.view().query, 0) << "the query stays";
         }});
    look("go.next_panel", "", [](CommandWorld& w) { EXPECT_EQ(w.session.keys.move, FocusMove::next_panel); });
    look("go.previous_panel", "", [](CommandWorld& w) { EXPECT_EQ(w.session.keys.move, FocusMove::previous_panel); });
    look("go.menu", "", [](CommandWorld& w) { EXPECT_EQ(w.session.keys.move, FocusMove::menu_bar); });
    look("go.menu_of_this", "", [](CommandWorld& w) { EXPECT_EQ(w.session.keys.move, FocusMove::menu_of_this); });

    // Help
    look("help.shortcuts", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::help); });
    look("help.messages", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::messages); });
    add({"help.clear_messages", "", {{"file.export_picture", "@p.png"}}, [](CommandWorld& w) {
             EXPECT_TRUE(w.session.notifications.all().empty());
         }});
    look("help.about", "", [](CommandWorld& w) { EXPECT_EQ(w.session.dialogs.now, Dialog::about); });
    return out;
}

std::string argument_in(const CommandWorld& world, const std::string& argument) {
    return argument.starts_with('@') ? world.path(argument.substr(1)) : argument;
}

TEST(CommandEffects, EveryCommandIsTried) {
    std::set<std::string> tried, known;
    for (const CommandCase& c : cases()) tried.insert(c.id);
    for (const Command& command : commands_with_review()) {
        // crowd_test.cpp has a crowd to try them on; what makes one is tried here.
        const bool of_crowd = command.id.starts_with("crowd.") || command.id.starts_with("conflicts.");
        if (of_crowd && !tried.contains(std::string(command.id))) continue;
        // sweep_test.cpp has a sweep that is under way.
        if (command.id == "tree.sweep_cancel") continue;
        // review_test.cpp has picture tests.
        if (command.id.starts_with("review.")) continue;
        known.emplace(command.id);
    }
    for (const std::string& id : known) EXPECT_TRUE(tried.contains(id)) << id << " needs a line in cases()";
    for (const std::string& id : tried) EXPECT_TRUE(known.contains(id)) << id << " is not a command";
}

TEST(CommandEffects, AreWhatTheyAreSaidToBe) {
    for (const CommandCase& c : cases()) {
        SCOPED_TRACE(c.id + ' ' + c.argument);
        CommandWorld world;
        Session& session = world.session;
        try {
            for (const auto& [id, argument] : c.before) {
                run_command(session, id, argument_in(world, argument));
                session.workspace.close_group();
            }
            const std::shared_ptr<const FittedScene> before = session.workspace.document().fitted;
            const bool was_modified = session.workspace.modified();
            run_command(session, c.id, argument_in(world, c.argument));
            c.check(world);
            if (!c.edits) continue;
            EXPECT_NE(session.workspace.document().fitted, before);
            EXPECT_TRUE(session.workspace.modified());
            run_command(session, "edit.undo");
            EXPECT_EQ(&session.workspace.scene(), &before->scene()) << "the very scene from before";
            EXPECT_EQ(session.workspace.fitted().options(), before->options());
            EXPECT_EQ(session.workspace.modified(), was_modified);
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

// A prompt begins with the present value: taking it changes nothing.
TEST(CommandEffects, ThePresentValueOfAPromptChangesNothing) {
    std::size_t tried = 0;
    for (const Command& command : commands()) {
        if (!command.present) continue;
        CommandWorld world;
        Session& session = world.session;
        for (const auto& [id, argument] : {kSelectB,
                                           {"agent.move", "1.5 -2.25"},
                                           {"agent.turn", "33"},
                                           {"time.at", "0.4"},
                                           {"view.measure", "0,0,0:3,4,2"},
                                           {"nodes.filter", "leaf"},
                                           {"view.save_as", "here"}}) {
            run_command(session, id, argument);
        }
        // One fit is compared with none.
        if (command.id == "compare.fits") run_command(session, "view.split");
        if (command.id.starts_with("step.")) run_command(session, "query.select", "0");
        if (!command.enabled(session)) continue;
        SCOPED_TRACE(command.id);
        ++tried;
        const std::string text = command.present(session);
        ASSERT_NE(text, "");
        const ViewState view = session.workspace.view();
        const auto scene_alone = [&] {
            Scene scene = session.workspace.scene();
            scene.view = {};
            return to_json(scene);
        };
        const std::string scene = scene_alone();
        const double speed = session.playback.speed;
        run_command(session, command.id, text);
        ViewState after = session.workspace.view();
        if (command.id.starts_with("step.")) after.step = view.step;
        EXPECT_EQ(after, view);
        EXPECT_EQ(scene_alone(), scene);
        EXPECT_EQ(session.playback.speed, speed);
        EXPECT_EQ(command.present(session), text);
    }
    EXPECT_GE(tried, 12u);
}

// A command that only looks leaves the scene as it is.
TEST(CommandEffects, LookingIsNoEdit) {
    for (const CommandCase& c : cases()) {
        const bool looks = c.id.starts_with("view.") || c.id.starts_with("time.") || c.id.starts_with("step.");
        if (!looks || c.edits) continue;
        SCOPED_TRACE(c.id);
        CommandWorld world;
        for (const auto& [id, argument] : c.before) run_command(world.session, id, argument);
        const Scene* before = &world.session.workspace.scene();
        run_command(world.session, c.id, c.argument);
        EXPECT_EQ(&world.session.workspace.scene(), before);
    }
}

}  // namespace
}  // namespace mobbscope::app
