// Whatever is done in the window, undo leads back to where it began, and redo to where it was.
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <base/error.h>
#include <scene/load_files.h>

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

/// A document as text, what it is an excerpt of included.
std::string as_json(const Document& document) {
    Scene scene = document.fitted->scene();
    scene.view = document.view;
    std::string text = to_json(scene);
    if (document.excerpt_of) text += as_json({document.excerpt_of->fitted, document.excerpt_of->view});
    return text;
}

/// A window in which random things are done.
class Worked {
  public:
    Worked(int seed, const std::filesystem::path& file)
        : session(seed % 4 == 3),
          window(GlContext::open(Backend::osmesa), session, size_of(seed), 1),
          script_(static_cast<std::uint64_t>(seed), size_of(seed), kLeast, kMost) {
        session.may_write = false;
        session.open({file});
        settle();
        note_opening();
    }

    void work(int statements) {
        for (int i = 0; i < statements && !session.closed(); ++i) {
            const std::string lines = script_.next(session, window.shell().marks());
            done += lines + '\n';
            std::istringstream in(lines);
            for (std::string line; std::getline(in, line);) run(line);
            note_opening();
        }
        session.stop();
        settle();
        note_opening();
    }

    const Document& begun() const { return begun_; }

    Session session;
    HeadlessWindow window;
    std::string done;  ///< for who wants to see it again

  private:
    static PictureSize size_of(int seed) { return seed % 3 == 0 ? kLeast : kMost; }

    void run(const std::string& line) {
        try {
            std::ostringstream out;
            Script::parse(line, "random").run(session, window, out);
        } catch (const InputError&) {
            // Not every command can be run everywhere.
        }
    }

    /// Another file was opened, and maybe something done since: what was done before is no past of it.
    void note_opening() {
        if (session.in_excerpt() || session.opening() == opening_) return;
        opening_ = session.opening();
        int done_since = 0;
        for (; session.history().can_undo(); ++done_since) session.undo();
        begun_ = session.document();
        for (; done_since > 0; --done_since) session.redo();
    }

    /// Until no job is left.
    void settle() {
        do {
            window.settle();
        } while (session.job());
    }

    test::RandomScript script_;
    Document begun_ = session.document();
    int opening_ = session.opening();
};

TEST(UndoScripts, AnyScriptUndoneIsWhereItBeganAndRedoneWhereItWas) {
    if (!mobbscope::testing::open_or_skip(Backend::osmesa)) return;
    const mobbscope::testing::TempFolder folder;
    const std::filesystem::path demos = demo_scene_file().parent_path();
    const std::vector<std::filesystem::path> files{demos / "crossing.json", demos / "collision.json",
                                                   demos / "circles.json",
                                                   folder.write("run.json", testing::crowded_run())};
    std::size_t undone = 0;
    for (int seed = 0; seed < script_budget(); ++seed) {
        Worked worked(seed, files[static_cast<std::size_t>(seed / 4) % files.size()]);
        // Few of them are long.
        worked.work(seed % 13 == 12 ? 143 : 20);
        SCOPED_TRACE("script " + std::to_string(seed) + ":\n" + worked.done);
        Session& session = worked.session;
        const auto lines = static_cast<std::size_t>(std::count(worked.done.begin(), worked.done.end(), '\n'));
        ASSERT_LE(session.history().count(), 1 + 3 * lines) << "a statement is a state, or a few of them";
        std::vector<std::string> past;
        while (session.history().can_undo()) {
            past.push_back(as_json(session.document()));
            ASSERT_LE(past.size(), 1000u) << "undo does not end";
            session.undo();
            worked.window.frame();
        }
        ASSERT_EQ(as_json(session.document()), as_json(worked.begun()));
        undone += past.size();
        for (; !past.empty(); past.pop_back()) {
            ASSERT_TRUE(session.history().can_redo());
            session.redo();
            worked.window.frame();
            ASSERT_EQ(as_json(session.document()), past.back());
        }
        ASSERT_EQ(worked.window.shell().frames_drawn(), 0) << "nobody looks";
    }
    EXPECT_GT(undone, 2u * static_cast<std::size_t>(script_budget())) << "too little is done to prove anything";
}

}  // namespace
}  // namespace mobbscope::app
