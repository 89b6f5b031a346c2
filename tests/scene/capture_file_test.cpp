// What a program captures of its queries (mobb/capture.h) is a scene that is read, and gives the same answers.
#include <mobb/capture.h>
#include <mobb/chain.h>
#include <mobb/placed_chain.h>
#include <mobb/random_chain.h>
#include <mobb/random_motion.h>
#include <scene/answer.h>
#include <scene/fitted_scene.h>
#include <scene/scene.h>
#include <support/temp_folder.h>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

using mobb::CaptureRing;
using mobb::CrashCapture;

bool same_numbers(const mobb::Clip& a, const mobb::Clip& b) {
    const auto same = [](double x, double y) { return x == y && std::signbit(x) == std::signbit(y); };
    return same(a.dt(), b.dt()) && a.motion() == b.motion() &&
           std::ranges::equal(a.samples(), b.samples(), [&](const mobb::Disk& p, const mobb::Disk& q) {
               return same(p.x, q.x) && same(p.y, q.y) && same(p.r, q.r);
           });
}

bool same_trace(const mobb::Trace& a, const mobb::Trace& b) {
    const auto same_pair = [](const mobb::MeasuredPair& p, const mobb::MeasuredPair& q) {
        return p.i == q.i && p.j == q.j && p.distance == q.distance;
    };
    bool same = a.size() == b.size() && a.events() == b.events();
    for (int step = 0; same && step < a.size(); ++step) {
        const auto p = a[step], q = b[step];
        same = p.parent == q.parent && p.depth == q.depth && p.a == q.a && p.b == q.b && p.test == q.test &&
               p.outcome == q.outcome && p.axis == q.axis && p.gap == q.gap &&
               std::ranges::equal(p.pairs, q.pairs, same_pair);
    }
    return same;
}

mobb::PlacedTree placed(const mobb::Tree& tree, const mobb::Placement& placement) { return {tree, placement}; }

/// Reads the only query of a file, and asks it again.
void expect_same_again(const std::filesystem::path& file, const mobb::Capture& captured) {
    const Scene scene = load_scene(file);
    ASSERT_EQ(scene.queries.size(), 1u);
    const SceneQuery& query = scene.queries.front();
    const auto clip_of = [&](const PlacedAgent& who) -> const mobb::Clip& {
        return *scene.clips[static_cast<std::size_t>(who.clip)].clip;
    };
    EXPECT_TRUE(same_numbers(clip_of(query.a), *captured.a.clip));
    EXPECT_TRUE(same_numbers(clip_of(query.b), *captured.b.clip));
    EXPECT_EQ(query.a.placement, captured.a.placement);
    EXPECT_EQ(query.b.placement, captured.b.placement);
    EXPECT_EQ(scene.fit, captured.fit);
    ASSERT_TRUE(query.expect.has_value());
    EXPECT_EQ(query.expect->collides, *captured.collides);
    EXPECT_EQ(query.expect->contact, captured.contact);

    const RecordedQuery again = record(FittedScene(scene, scene.fit), query);
    EXPECT_EQ(again.contact, captured.contact);
    ASSERT_EQ(query.trace == nullptr, captured.trace == nullptr);
    if (!captured.trace) return;
    EXPECT_TRUE(same_trace(*query.trace, *captured.trace));
    EXPECT_TRUE(same_trace(again.trace, *captured.trace));
}

TEST(CaptureFile, GivesBackClipsAnswersAndTracesOfEveryKindOfTree) {
    const TempFolder folder;
    const auto file = folder.path() / "query.json";
    mobb::test::Random random(37);
    int hits = 0;
    for (int i = 0; i < 400 && !HasFailure(); ++i) {
        const mobb::ClipPtr a = mobb::test::random_motion(random, mobb::test::random_clip(random, 100));
        const mobb::ClipPtr b = mobb::test::random_motion(random, mobb::test::random_partner(random, *a, 100));
        mobb::FitOptions fit = mobb::test::random_any_fit(random);
        fit.tree = mobb::kTreeKinds[static_cast<std::size_t>(i) % mobb::kTreeKindCount];
        const mobb::Tree tree_a(a, fit), tree_b(b, fit);
        mobb::Placement at_a, at_b;
        mobb::test::random_placements(random, *a, *b, at_a, at_b);
        mobb::TraceRecorder recorder;
        const auto answer = mobb::query(placed(tree_a, at_a), placed(tree_b, at_b), recorder);
        hits += answer.has_value();
        mobb::Capture capture = mobb::capture(placed(tree_a, at_a), placed(tree_b, at_b), answer);
        if (random.chance(0.7)) capture.trace = std::make_shared<const mobb::Trace>(recorder.take());
        mobb::write_capture(file, capture);
        expect_same_again(file, capture);
    }
    EXPECT_GT(hits, 50);
    EXPECT_LT(hits, 350);
}

TEST(CaptureFile, GivesBackAChainAsItsFlattenedClip) {
    const TempFolder folder;
    const auto file = folder.path() / "query.json";
    mobb::test::Random random(38);
    int hits = 0;
    for (int i = 0; i < 100 && !HasFailure(); ++i) {
        const double linear = i % 2;
        const mobb::Chain chain_a(mobb::test::random_running_links(random, 4, 1, 40, {}, linear));
        const mobb::Chain chain_b(mobb::test::random_running_links(random, 4, 1, 40, {}, linear));
        const auto a = std::make_shared<const mobb::Clip>(mobb::flattened(chain_a));
        const auto b = std::make_shared<const mobb::Clip>(mobb::flattened(chain_b));
        mobb::Placement at_a, at_b;
        mobb::test::random_placements(random, *a, *b, at_a, at_b);
        const auto answer = mobb::query(mobb::PlacedChain(chain_a, at_a), mobb::PlacedChain(chain_b, at_b));
        hits += answer.has_value();
        const mobb::Capture capture{{a, at_a}, {b, at_b}, {}, answer.has_value(), answer, {}};
        mobb::write_capture(file, capture);
        expect_same_again(file, capture);
    }
    EXPECT_GT(hits, 10);
    EXPECT_LT(hits, 90);
}

TEST(CaptureFile, SaysWhereATraceStopped) {
    const TempFolder folder;
    const auto file = folder.path() / "query.json";
    mobb::test::Random random(39);
    const mobb::Tree tree(mobb::test::random_clip(random, 100), {.leaf = 1});
    mobb::TraceRecorder recorder({.events = 2});
    const auto answer = mobb::query(placed(tree, {}), placed(tree, {.translate = {0.3, 0}}), recorder);
    mobb::Capture capture = mobb::capture(placed(tree, {}), placed(tree, {.translate = {0.3, 0}}), answer);
    capture.trace = std::make_shared<const mobb::Trace>(recorder.take());
    mobb::write_capture(file, capture);
    const Scene scene = load_scene(file);
    ASSERT_EQ(capture.trace->size(), 2);
    EXPECT_TRUE(same_trace(*scene.queries.front().trace, *capture.trace));
}

TEST(CaptureFile, KeepsEveryBitOfANumber) {
    const TempFolder folder;
    const auto file = folder.path() / "query.json";
    const auto clip = std::make_shared<const mobb::Clip>(
        1.0 / 3, std::vector<mobb::Disk>{{-0.0, 5e-324, 0}, {1e9, -1e9, 1e-300}, {0.1 + 0.2, 1234567.875, 0}});
    const mobb::Capture capture{{clip, {.translate = {-0.0, 0.1}, .rotate_deg = -1e9 / 3, .start = 1e11 / 7}},
                                {clip, {.translate = {2e8 / 3, -1e-17}, .start = -0.0}},
                                {.tree = mobb::TreeKind::umobb, .time_scale = 1e6},
                                false,
                                {},
                                {}};
    mobb::write_capture(file, capture);
    expect_same_again(file, capture);
    EXPECT_EQ(load_scene(file).clips.size(), 1u);  // each clip once
    EXPECT_TRUE(std::signbit(load_scene(file).queries.front().b.placement.start));
}

/// `queries` in the file, each with an answer that is right.
void expect_right_answers(const std::filesystem::path& file, std::size_t queries) {
    ASSERT_TRUE(std::filesystem::exists(file));
    const Scene scene = load_scene(file);
    EXPECT_EQ(scene.queries.size(), queries);
    const FittedScene fitted(scene, scene.fit);
    for (const SceneQuery& query : scene.queries) {
        EXPECT_TRUE(query.expect.has_value());
        EXPECT_EQ(disagreement(query, answer(fitted, query, {})), std::nullopt);
    }
}

// --- signals

/// Clips in trees, for queries at random.
struct Crowd {
    std::vector<mobb::Tree> trees;
    mobb::test::Random random{5};

    Crowd() {
        for (int i = 0; i < 8; ++i) trees.emplace_back(mobb::test::random_clip(random, 60, 0.05), mobb::FitOptions{});
    }
    mobb::PlacedTree any() {
        return {trees[static_cast<std::size_t>(random.integer(0, 7))],
                {.translate = {random.real(-4, 4), random.real(-4, 4)}, .rotate_deg = random.real(0, 360)}};
    }
    void ask(CaptureRing& ring, int times) {
        for (int i = 0; i < times; ++i) ring.query(any(), any());
    }
};

/// What became of a process that does this: the signal that ended it, or minus its status.
int end_of(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        // No core, and no sanitizer's report.
        for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV}) ::signal(signal, SIG_DFL);
        work();
        ::_exit(99);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : -WEXITSTATUS(status);
}

/// Fills the stack.
[[gnu::noinline]] int nested(int depth) {
    std::array<volatile int, 1000> filled;
    filled[static_cast<std::size_t>(depth % 1000)] = depth;
    return depth == 0 ? 0 : nested(depth - 1) + filled[static_cast<std::size_t>(depth % 999)];
}

TEST(CrashCaptureFile, HoldsTheLastQueriesWhateverEndsTheProgram) {
    const std::vector<std::pair<int, std::function<void()>>> ends{
        {SIGABRT, [] { std::abort(); }},
        {SIGSEGV, [] { *const_cast<volatile int*>(static_cast<int*>(nullptr)) = 1; }},
        {SIGSEGV, [] { nested(1 << 30); }},
        {SIGFPE, [] { ::raise(SIGFPE); }},
        {SIGILL, [] { ::kill(::getpid(), SIGILL); }},
        {SIGBUS, [] { std::thread([] { ::raise(SIGBUS); }).join(); }},
    };
    for (const auto& [signal, end] : ends) {
        const TempFolder folder;
        const auto file = folder.path() / "crash.json";
        EXPECT_EQ(end_of([&, end = end] {
                      CaptureRing ring(16);
                      const CrashCapture crash(ring, file);
                      Crowd().ask(ring, 100);
                      end();
                  }),
                  signal);
        expect_right_answers(file, 16);
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    }
}

TEST(CrashCaptureFile, IsWrittenForEachRingBeforeTheFormerHandler) {
    const TempFolder folder;
    EXPECT_EQ(end_of([&] {
                  ::signal(SIGABRT, [](int) { ::_exit(7); });
                  CaptureRing ring(4);
                  const CrashCapture crash(ring, folder.path() / "main.json");
                  Crowd().ask(ring, 100);
                  std::thread([&] {
                      CaptureRing own(8);
                      const CrashCapture own_crash(own, folder.path() / "thread.json");
                      Crowd().ask(own, 100);
                      std::abort();
                  }).join();
              }),
              -7);
    expect_right_answers(folder.path() / "main.json", 4);
    expect_right_answers(folder.path() / "thread.json", 8);
}

TEST(CrashCaptureFile, IsNotWrittenByAChild) {
    const TempFolder folder;
    CaptureRing ring(4);
    Crowd().ask(ring, 10);
    {
        const CrashCapture crash(ring, folder.path() / "crash.json");
        EXPECT_EQ(end_of([] { ::raise(SIGKILL); }), SIGKILL);
        const pid_t child = ::fork();
        if (child == 0) ::raise(SIGILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(WTERMSIG(status), SIGILL);
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "crash.json"));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CrashCaptureFile, HoldsTheQueryThatCrashed) {
    const TempFolder folder;
    const auto file = folder.path() / "crash.json";
    EXPECT_EQ(end_of([&] {
                  CaptureRing ring(4);
                  const CrashCapture crash(ring, file);
                  Crowd().ask(ring, 10);
                  // The time goes into long queries: side by side, never touching, measured sample by sample.
                  const mobb::Tree tree(
                      std::make_shared<const mobb::Clip>(0.1, std::vector<mobb::Disk>(100'000, {0, 0, 0.5})),
                      {.levels = 1});
                  const mobb::PlacedTree a(tree, {}), b(tree, {.translate = {0.8, 0.8}, .rotate_deg = 30});
                  ::signal(SIGVTALRM, [](int) { std::abort(); });
                  const itimerval soon{{0, 0}, {0, 50'000}};
                  ::setitimer(ITIMER_VIRTUAL, &soon, nullptr);
                  for (;;) ring.query(a, b);
              }),
              SIGABRT);
    ASSERT_TRUE(std::filesystem::exists(file));
    const Scene scene = load_scene(file);
    ASSERT_EQ(scene.queries.size(), 4u);
    EXPECT_TRUE(scene.queries[2].expect.has_value());
    EXPECT_FALSE(scene.queries[3].expect.has_value());
}

const CaptureRing* dumped_ring = nullptr;
int next_dump = 0;
std::array<int, 200> dump_files;

void dump_next(int) {
    if (next_dump < static_cast<int>(dump_files.size()))
        dumped_ring->dump(dump_files[static_cast<std::size_t>(next_dump++)]);
}

TEST(CaptureRingFile, IsWholeWheneverASignalComes) {
    const TempFolder folder;
    CaptureRing ring(5);
    dumped_ring = &ring;
    next_dump = 0;
    for (std::size_t i = 0; i < dump_files.size(); ++i) {
        const auto file = folder.path() / (std::to_string(i) + ".json");
        dump_files[i] = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
        ASSERT_GE(dump_files[i], 0);
    }
    mobb::test::Random random(3);
    Crowd crowd;
    crowd.ask(ring, 5);
    struct sigaction action {
    }, former{};
    action.sa_handler = dump_next;
    action.sa_flags = SA_RESTART;
    ASSERT_EQ(::sigaction(SIGVTALRM, &action, &former), 0);
    const itimerval often{{0, 1000}, {0, 1000}};
    ASSERT_EQ(::setitimer(ITIMER_VIRTUAL, &often, nullptr), 0);
    // Memory is taken and given back as queries come and go.
    while (next_dump < static_cast<int>(dump_files.size())) {
        const mobb::Tree tree(mobb::test::random_clip(random, 5, 0.05), {});
        for (int i = 0; i < 20; ++i) ring.query(crowd.any(), {tree, {.translate = {random.real(-4, 4), 0}}});
    }
    const itimerval never{};
    ::setitimer(ITIMER_VIRTUAL, &never, nullptr);
    ::sigaction(SIGVTALRM, &former, nullptr);
    for (std::size_t i = 0; i < dump_files.size(); ++i) {
        ::close(dump_files[i]);
        const Scene scene = load_scene(folder.path() / (std::to_string(i) + ".json"));
        const FittedScene fitted(scene, scene.fit);
        ASSERT_GE(scene.queries.size(), 4u);
        for (std::size_t k = 0; k < scene.queries.size(); ++k) {
            // The last one may be being asked.
            EXPECT_TRUE(scene.queries[k].expect.has_value() || k + 1 == scene.queries.size());
            EXPECT_EQ(disagreement(scene.queries[k], answer(fitted, scene.queries[k], {})), std::nullopt);
        }
    }
}

}  // namespace
}  // namespace mobbscope
