// A frame costs what has changed: what it allocates while nothing changes is counted, in a program of its own.
#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

namespace {

std::atomic<std::size_t> allocated_blocks = 0, allocated_bytes = 0;

}  // namespace

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocated_blocks;
    allocated_bytes += size;
    return std::malloc(size);
}
void* operator new(std::size_t size) {
    if (void* block = operator new(size, std::nothrow)) return block;
    throw std::bad_alloc();
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace mobbscope::app {
namespace {

constexpr int kTracks = 1000;

/// Tracks of five samples on a floor of 100 m by 100 m, each a little later than the one before.
std::string tracks_csv() {
    std::string text = "id,t,x,y,r\n";
    for (int id = 0; id < kTracks; ++id) {
        for (int i = 0; i < 5; ++i) {
            text += std::to_string(id) + ',' + std::to_string(0.02 * id + 0.1 * i) + ',' +
                    std::to_string(3.1 * (id % 32) + 0.1 * i) + ',' + std::to_string(3.1 * (id / 32)) + ",0.3\n";
        }
    }
    return text;
}

struct Cost {
    std::size_t blocks = 0, bytes = 0;
};

/// Of a frame in which nothing changes.
Cost cost_of_frame(HeadlessWindow& window) {
    constexpr std::size_t kFrames = 10;
    window.settle();
    const Cost before{allocated_blocks, allocated_bytes};
    for (std::size_t i = 0; i < kFrames; ++i) window.frame();
    return {(allocated_blocks - before.blocks) / kFrames, (allocated_bytes - before.bytes) / kFrames};
}

TEST(FrameCost, OneAloneOfAThousandTracksCostsNoMoreThanAll) {
    FolderWindow<TempFolder> w({1280, 800});
    w.open(w.folder.write("tracks.csv", tracks_csv()));
    ASSERT_EQ(w.session.workspace.fitted().placed_agents().size(), std::size_t{kTracks});
    ASSERT_EQ(w.session.answers.known()->asked, std::size_t{kTracks} * (kTracks - 1) / 2) << "hits are listed first";
    w.run("go.agent", "1");
    const Cost all = cost_of_frame(w.window);
    w.run("agent.solo");
    ASSERT_EQ(w.session.workspace.view().hidden.size(), std::size_t{kTracks - 1});
    const Cost alone = cost_of_frame(w.window);
    RecordProperty("blocks", std::to_string(all.blocks) + ", " + std::to_string(alone.blocks));
    EXPECT_LT(all.blocks, 1500u);
    EXPECT_LT(all.bytes, 500'000u);
    EXPECT_LT(alone.blocks, 1500u);
    EXPECT_LT(alone.bytes, 500'000u);
}

}  // namespace
}  // namespace mobbscope::app
