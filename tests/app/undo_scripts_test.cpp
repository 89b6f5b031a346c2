// Whatever is done in the window, undo leads back to the scene that it began with, redo to what it was, and so do the
// previous view and the next.
#include <app/commands/camera_commands.h>
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <base/error.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <scene/load_files.h>
#include <scene/view_options.h>

#include <support/temp_folder.h>

#include "app/crowded_run.h"
#include "app/random_script.h"
#include "render/backends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

constexpr PictureSize kLeast{320, 240};
constexpr PictureSize kMost{1100, 700};

/// How many random scripts the suite runs; MOBBSCOPE_SCRIPTS gives longer or shorter runs.
int script_budget() {
    const char* text = std::getenv("MOBBSCOPE_SCRIPTS");
    return text ? std::atoi(text) : 36;
}

/// A document's scene as text, and that which it is an excerpt of.
std::string scene_as_text(const Document& document) {
    Scene scene = document.fitted->scene();
    scene.view = {};
    std::string text = to_json(scene) + std::to_string(document.beside.size());
    if (document.excerpt_of) text += scene_as_text({document.excerpt_of->fitted, {}});
    return text;
}

/// How it is seen. A camera's distance goes with the height of the picture.
std::string view_as_text(ViewState view, int picture_height) {
    std::string distance;
    if (view.camera.target) distance = formatted("%.9g", std::exchange(view.camera.distance, 1) / picture_height);
    std::ostringstream text;
    JsonWriter out(text);
    write_view(out, view);
    return text.str() + distance;
}

/// A window in which random things are done.
class Worked {
  public:
    Worked(int seed, const std::filesystem::path& file)
        : session(seed % 4 == 3),
          window(GlContext::open(Backend::osmesa), session, size_of(seed), 1),
          script_(static_cast<std::uint64_t>(seed), size_of(seed), kLeast, kMost) {
        session.options.may_write = false;
        add_review(session);
        session.files.open({file});
        follow_opening();
        window.resize(size_of(seed));
        settle();
    }

    void work(int statements) {
        for (int i = 0; i < statements && !session.files.closed(); ++i) {
            const std::string lines = script_.next(session, window.shell().marks());
            done += lines + '\n';
            std::istringstream in(lines);
            for (std::string line; std::getline(in, line);) run(line);
            follow_opening();
        }
        session.playback.stop();
        settle();
        follow_opening();
    }

    std::string scene() const { return scene_as_text(session.workspace.document()); }
    std::string view() const { return view_as_text(session.workspace.view(), viewport_size(session.views).height); }
    /// The scene of the oldest state.
    const std::string& begun() const { return begun_; }

    Session session;
    HeadlessWindow window;
    std::string done;  ///< for who wants to see it again

  private:
    static PictureSize size_of(int seed) { return seed % 3 == 0 ? kLeast : kMost; }

    /// Another file was opened: what was done before is no past of it.
    void follow_opening() {
        if (session.workspace.in_excerpt() || session.workspace.document().opening == opening_) return;
        opening_ = session.workspace.document().opening;
        // In a window where the camera has something to frame the scene in.
        window.resize(kMost);
        settle();
        History history = session.workspace.history;
        while (history.can_undo()) history.undo();
        begun_ = scene_as_text(history.now());
    }

    void run(const std::string& line) {
        try {
            std::ostringstream out;
            Script::parse(line, "random", ScriptOutput::allowed, commands(session)).run(session, window, out);
        } catch (const InputError&) {
            // Not every command can be run everywhere.
        }
    }

    /// Until no job is left.
    void settle() {
        do {
            window.settle();
        } while (session.jobs.job());
    }

    RandomScript script_;
    std::string begun_;
    int opening_ = -1;
};

TEST(UndoScripts, AnyScriptUndoneIsTheSceneOfTheBeginAndRedoneAsItWas) {
    if (!has_or_skip(Backend::osmesa)) return;
    const TempFolder folder;
    const std::filesystem::path demos = demo_scene_file().parent_path();
    const std::vector<std::filesystem::path> files{demos / "crossing.json", demos / "collision.json",
                                                   demos / "circles.json", folder.write("run.json", crowded_run())};
    std::size_t undone = 0;
    int looked = 0;
    for (int seed = 0; seed < script_budget(); ++seed) {
        Worked worked(seed, files[static_cast<std::size_t>(seed / 4) % files.size()]);
        // Few of them are long.
        worked.work(seed % 13 == 12 ? 143 : 20);
        SCOPED_TRACE("script " + std::to_string(seed) + ":\n" + worked.done);
        Session& session = worked.session;
        const auto lines = static_cast<std::size_t>(std::count(worked.done.begin(), worked.done.end(), '\n'));
        ASSERT_LE(session.workspace.history.count(), 1 + 3 * lines) << "a statement is a state, or a few of them";
        const std::string view = worked.view();
        int looks = 0;
        for (; session.workspace.history.can_look_back(); ++looks) {
            ASSERT_LE(looks, 1000) << "looking back does not end";
            session.edits.previous_view();
            worked.window.frame();
        }
        looked += looks;
        for (; looks > 0; --looks) {
            ASSERT_TRUE(session.workspace.history.can_look_forward());
            session.edits.next_view();
            worked.window.frame();
        }
        ASSERT_EQ(worked.view(), view);
        std::vector<std::string> past;
        while (session.workspace.history.can_undo()) {
            past.push_back(worked.scene());
            ASSERT_LE(past.size(), 1000u) << "undo does not end";
            session.edits.undo();
            worked.window.frame();
        }
        ASSERT_EQ(worked.scene(), worked.begun());
        undone += past.size();
        for (; !past.empty(); past.pop_back()) {
            ASSERT_TRUE(session.workspace.history.can_redo());
            session.edits.redo();
            worked.window.frame();
            ASSERT_EQ(worked.scene(), past.back());
        }
        ASSERT_EQ(worked.view(), view) << "undone and redone, it is seen as before";
        ASSERT_EQ(worked.window.shell().frames_drawn(), 0) << "nobody looks";
    }
    EXPECT_GT(2 * undone, static_cast<std::size_t>(script_budget())) << "too little is done to prove anything";
    EXPECT_GT(looked, script_budget());
}

}  // namespace
}  // namespace mobbscope::app
