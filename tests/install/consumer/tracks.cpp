// Who comes near whom, by the library of tracks: one walks past one that stands, a third is far away.
#include <mobb_tracks/encounter.h>
#include <mobb_tracks/people_conflicts.h>

#include <cstdio>
#include <vector>

int main() {
    std::vector<mobb::Disk> path;
    for (int i = 0; i < 9; ++i) path.push_back({0.5 * i, 0.0, 0.25});  // x, y, r in metres
    const mobb::Clip walk(0.5, path, mobb::Motion::linear);            // one sample every 0.5 s
    const mobb::Clip stand(4, {{2, 1, 0.25}}, mobb::Motion::linear);

    const std::vector<mobb::PlacedClip> crowd{{walk, {}}, {stand, {}}, {stand, {.translate = {50, 50}}}};
    mobb::ConflictSearch search;
    search.within = 1;
    const mobb::PeopleConflicts found(crowd, std::vector{0, 1, 2}, search);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const mobb::PeopleConflict pair = found[i];
        std::printf("%d and %d are %.2f m apart at %.1f s\n", pair.a, pair.b, pair.deepest.least_clearance,
                    pair.deepest.time);
    }
}
