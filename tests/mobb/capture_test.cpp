// What a program remembers of its queries (mobb/capture.h). tests/scene/capture_file_test.cpp reads the files back.
#include <gtest/gtest.h>
#include <mobb/capture.h>
#include <mobb/random_motion.h>
#include <support/temp_folder.h>

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace mobb {
namespace {

using mobbscope::slurp;
using mobbscope::TempFolder;

ClipPtr walk_of(int samples) {
    std::vector<Disk> path;
    for (int i = 0; i < samples; ++i) path.push_back({i * 0.02, 0.0, 0.5});
    return std::make_shared<const Clip>(0.02, path);
}

/// A query of one sample each, `apart` metres: that is how a test knows it again.
Capture apart(double metres) {
    return {{walk_of(1), {}}, {walk_of(1), {.translate = {metres, 0}}}, {}, metres < 1, {}, {}};
}

std::vector<double> distances(const std::vector<Capture>& captures) {
    std::vector<double> out;
    for (const Capture& capture : captures) out.push_back(capture.b.placement.translate.x);
    return out;
}

std::string dumped(const CaptureRing& ring, const TempFolder& folder) {
    const auto file = folder.path() / "dump.json";
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    const bool whole = ring.dump(descriptor);
    ::close(descriptor);
    EXPECT_EQ(whole, !slurp(file).empty());
    return slurp(file);
}

int count_of(const std::string& text, const std::string& what) {
    int count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

// By another program: FNV-1a over the bytes that the documents name.
TEST(CaptureDigest, IsThatOfTheNumbersAndTheMotion) {
    const std::vector<Disk> samples{{1, 2, 0.5}, {-0.0, 1e-3, 0}};
    EXPECT_EQ(digest(0.25, samples, Motion::held), 0x7110979caab07a4du);
    EXPECT_EQ(digest(Clip(0.25, samples, Motion::linear)), 0x1306d665644cc3b7u);
    const auto clip = std::make_shared<const Clip>(0.25, samples, Motion::linear);
    EXPECT_EQ(count_of(scene_text(Capture{{clip, {}}, {clip, {}}}), "\"digest\": \"1306d665644cc3b7\""), 1);
}

TEST(CaptureRing, HoldsTheLastQueriesTheOldestFirst) {
    CaptureRing ring(3);
    EXPECT_EQ(ring.size(), 3);
    EXPECT_TRUE(ring.captures().empty());
    for (int i = 0; i < 2; ++i) ring.push(apart(i));
    EXPECT_EQ(distances(ring.captures()), (std::vector<double>{0, 1}));
    for (int i = 2; i < 8; ++i) ring.push(apart(i));
    EXPECT_EQ(distances(ring.captures()), (std::vector<double>{5, 6, 7}));
    EXPECT_THROW(CaptureRing(0), std::invalid_argument);
}

TEST(CaptureRing, AsksWhatAQueryAsks) {
    test::Random random(1);
    CaptureRing ring(2);
    for (int i = 0; i < 2000; ++i) {
        const ClipPtr a = test::random_motion(random, test::random_clip(random, 200));
        const ClipPtr b = test::random_motion(random, test::random_partner(random, *a, 200));
        const FitOptions fit = test::random_any_fit(random);
        const Tree tree_a(a, fit), tree_b(b, fit);
        Placement at_a, at_b;
        test::random_placements(random, *a, *b, at_a, at_b);
        const PlacedTree placed_a(tree_a, at_a), placed_b(tree_b, at_b);
        const auto answer = query(placed_a, placed_b);
        ASSERT_EQ(ring.query(placed_a, placed_b), answer);
        ASSERT_EQ(NoCaptureRing::query(placed_a, placed_b), answer);
        const Capture last = ring.captures().back();
        EXPECT_EQ(last.a.clip, a);
        EXPECT_EQ(last.b.clip, b);
        EXPECT_EQ(last.a.placement, at_a);
        EXPECT_EQ(last.b.placement, at_b);
        EXPECT_EQ(last.fit, fit);
        EXPECT_EQ(last.collides, answer.has_value());
        EXPECT_EQ(last.contact, answer);
        EXPECT_EQ(last.trace, nullptr);
    }
}

TEST(CaptureRing, KeepsClipsAliveUntilTheirLastQueryHasLeft) {
    CaptureRing ring(2);
    std::weak_ptr<const Clip> first;
    {
        const ClipPtr clip = walk_of(30);
        first = clip;
        const Tree tree(clip, {});
        const PlacedTree placed(tree, {});
        ring.query(placed, placed);
    }
    ring.push(apart(1));
    ASSERT_FALSE(first.expired());
    EXPECT_EQ(ring.captures().front().a.clip->count(), 30);
    ring.push(apart(2));
    EXPECT_TRUE(first.expired());
}

TEST(CaptureRing, LeavesOutTheQueryThatASignalInterrupts) {
    const TempFolder folder;
    CaptureRing ring(3);
    std::string in_between;
    // The push that ends its life is the one that is interrupted.
    const ClipPtr ends(new Clip(0.02, {{1, 2, 3}}), [&](const Clip* clip) {
        in_between = dumped(ring, folder);
        delete clip;
    });
    ring.push({{ends, {}}, {ends, {.translate = {100, 0}}}, {}, false, {}, {}});
    const_cast<ClipPtr&>(ends).reset();
    for (int i = 1; i <= 2; ++i) ring.push(apart(i));
    EXPECT_EQ(count_of(dumped(ring, folder), "\"expect\":"), 3);
    ring.push(apart(3));
    EXPECT_EQ(count_of(in_between, "\"expect\":"), 2);
    EXPECT_EQ(count_of(in_between, "\"translate\": [100, 0]"), 0);
    EXPECT_EQ(count_of(in_between, "\"translate\": [1, 0]"), 1);
    EXPECT_EQ(count_of(in_between, "\"translate\": [2, 0]"), 1);
    EXPECT_EQ(count_of(in_between, "\"translate\": [3, 0]"), 0);
    EXPECT_EQ(distances(ring.captures()), (std::vector<double>{1, 2, 3}));
}

TEST(CaptureRing, IsReadByOtherThreads) {
    CaptureRing ring(4);
    std::atomic<bool> ends{false};
    std::thread asks([&] {
        const Tree still(walk_of(1), {});
        for (int i = 0; !ends; ++i) {
            const ClipPtr clip = walk_of(1 + i % 7);
            const Tree tree(clip, {});
            ring.query(PlacedTree(still, {}), PlacedTree(tree, {.translate = {0.9 * clip->count(), 0}}));
        }
    });
    const TempFolder folder;
    int read = 0;
    while (read < 2000) {
        for (const Capture& capture : ring.captures()) {
            ++read;
            EXPECT_EQ(capture.b.placement.translate.x, 0.9 * capture.b.clip->count());
            if (!capture.collides) continue;
            EXPECT_EQ(*capture.collides, capture.b.clip->count() < 2);
            EXPECT_EQ(capture.contact.has_value(), *capture.collides);
        }
        if (read % 10 == 0) dumped(ring, folder);
    }
    ends = true;
    asks.join();
}

TEST(CaptureRing, SaysWhenADumpFails) {
    CaptureRing ring(2);
    EXPECT_FALSE(ring.dump(STDERR_FILENO));  // nothing is there
    ring.push(apart(1));
    EXPECT_FALSE(ring.dump(-1));
    const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
    ASSERT_GE(full, 0);
    EXPECT_FALSE(ring.dump(full));
    ::close(full);
}

TEST(Capture, RefusesWhatNoFileCanHold) {
    const auto refuses = [](const auto& change) {
        Capture capture = apart(0);
        capture.contact = Contact{0, 0, 0, 0, 1};
        EXPECT_NO_THROW(check(capture));
        change(capture);
        EXPECT_THROW(check(capture), std::invalid_argument);
        EXPECT_THROW(CaptureRing(1).push(capture), std::invalid_argument);
    };
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    refuses([](Capture& c) { c.a.clip = nullptr; });
    refuses([](Capture& c) { c.b.clip = nullptr; });
    refuses([](Capture& c) { c.b.placement.start = kNone; });
    refuses([](Capture& c) { c.fit.leaf = 0; });
    refuses([](Capture& c) { c.collides = false; });
    refuses([](Capture& c) { c.collides.reset(); });
    refuses([](Capture& c) { c.contact->b_sample = 1; });
    refuses([](Capture& c) { c.contact->time = kNone; });
    refuses([](Capture& c) { c.contact->distance = -1; });
}

TEST(Capture, IsWrittenWholeOrNotAtAll) {
    const TempFolder folder;
    const auto file = folder.write("query.json", "before");
    Capture bad = apart(1);
    bad.a.clip = nullptr;
    EXPECT_THROW(write_capture(file, bad), std::invalid_argument);
    EXPECT_THROW(write_captures(file, {}), std::invalid_argument);
    EXPECT_EQ(slurp(file), "before");
    write_capture(file, apart(1));
    EXPECT_EQ(slurp(file).substr(0, 20), "{\n  \"mobbscope\": 1,\n");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);

    const auto nowhere = folder.path() / "none" / "query.json";
    try {
        write_capture(nowhere, apart(1));
        FAIL();
    } catch (const std::filesystem::filesystem_error& error) {
        EXPECT_EQ(error.path1(), nowhere);
        EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
        EXPECT_NE(std::string(error.what()).find("cannot write captured queries"), std::string::npos);
    }
    // A folder does not give its name away.
    std::filesystem::create_directories(folder.path() / "folder" / "in it");
    EXPECT_THROW(write_capture(folder.path() / "folder", apart(1)), std::filesystem::filesystem_error);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(Capture, TheTextIsTheFiles) {
    const TempFolder folder;
    std::vector<Capture> captures{apart(1), apart(0.1)};
    captures[0].a.clip = walk_of(5000);  // more than one buffer
    write_captures(folder.path() / "two.json", captures);
    EXPECT_EQ(scene_text(captures), slurp(folder.path() / "two.json"));
    EXPECT_EQ(count_of(scene_text(captures[1]), "\"expect\""), 1);
    EXPECT_THROW(scene_text(std::vector<Capture>{}), std::invalid_argument);
}

TEST(CrashCapture, LeavesNothingWhereNothingCrashes) {
    const TempFolder folder;
    CaptureRing ring(2);
    ring.push(apart(1));
    {
        const CrashCapture crash(ring, folder.path() / "crash.json");
        EXPECT_FALSE(std::filesystem::is_empty(folder.path()));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_THROW(CrashCapture(ring, folder.path() / "none" / "crash.json"), std::filesystem::filesystem_error);

    std::vector<std::unique_ptr<CrashCapture>> many;
    for (int i = 0; i < 64; ++i)
        many.push_back(std::make_unique<CrashCapture>(ring, folder.path() / std::to_string(i)));
    EXPECT_THROW(CrashCapture(ring, folder.path() / "one too many"), std::length_error);
    many.clear();
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace mobb
