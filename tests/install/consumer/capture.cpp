// Captured queries of docs/library.md: two people who walk past each other.
#include <mobb/capture.h>
#include <mobb/query.h>

#include <cstdio>
#include <memory>
#include <vector>

int main() {
    std::vector<mobb::Disk> path;
    for (int i = 0; i < 300; ++i) path.push_back({i * 0.02, 0.0, 0.5});
    const mobb::Tree tree(std::make_shared<const mobb::Clip>(0.02, path), {.tree = mobb::TreeKind::mobb, .leaf = 10});
    const mobb::PlacedTree east(tree, {.translate = {0, 0}});
    const mobb::PlacedTree west(tree, {.translate = {6, 2}, .rotate_deg = 180});

    mobb::CaptureRing asked(64);                          // one for each thread
    const mobb::CrashCapture crash(asked, "crash.json");  // what it holds, if the program crashes
    const auto answer = asked.query(east, west);          // in place of mobb::query
    if (!answer) mobb::write_capture("missed.json", mobb::capture(east, west, answer));
    asked.write("last.json");  // what it holds now

    if (!answer) std::puts("they miss");
}
