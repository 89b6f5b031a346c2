#include <base/work_queue.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <future>
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
    std::promise<void> go;
    std::atomic<int> done = 0;
    std::promise<void> begun;
    std::thread opens;
    {
        WorkQueue queue(3);
        queue.add([&] {
            begun.set_value();
            go.get_future().wait();
            ++done;
        });
        begun.get_future().wait();
        for (int i = 0; i < 3; ++i) queue.add([&] { done += 10; });
        opens = std::thread([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            go.set_value();
        });
    }
    opens.join();
    EXPECT_EQ(done, 1);
}

}  // namespace
}  // namespace mobbscope
