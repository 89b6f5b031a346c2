#include <base/work_queue.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mobbscope {
namespace {

TEST(WorkQueue, DoesAllInOrderOnAnotherThread) {
    std::vector<int> done;
    std::thread::id by;
    WorkQueue queue(2);
    for (int i = 0; i < 100; ++i) {
        queue.add([&done, &by, i] {
            done.push_back(i);
            by = std::this_thread::get_id();
        });
    }
    queue.finish();
    ASSERT_EQ(done.size(), 100u);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
    EXPECT_NE(by, std::this_thread::get_id());
    queue.finish();
}

TEST(WorkQueue, WhatAPieceThrowsComesOutAndEndsTheWork) {
    std::atomic<int> done = 0;
    WorkQueue queue(1);
    queue.add([] { throw std::runtime_error("broken"); });
    EXPECT_THROW(queue.finish(), std::runtime_error);
    EXPECT_THROW(queue.add([&] { ++done; }), std::runtime_error);
    EXPECT_EQ(done, 0);
}

TEST(WorkQueue, WhatWaitsAtItsEndIsDropped) {
    std::promise<void> begun, go;
    std::atomic<int> done = 0;
    {
        WorkQueue queue(3);
        queue.add([&] {
            begun.set_value();
            go.get_future().wait();
            ++done;
        });
        begun.get_future().wait();
        // That they are dropped lets the first one end, so the queue waits for ever if it keeps them.
        const auto lets_go = [&go](const int*) { go.set_value(); };
        std::shared_ptr<const int> dropped(nullptr, lets_go);
        for (int i = 0; i < 3; ++i) queue.add([&done, dropped] { done += 10; });
        dropped = nullptr;
    }
    EXPECT_EQ(done, 1);
}

}  // namespace
}  // namespace mobbscope
