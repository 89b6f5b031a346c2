#include <crowd/graph/alike_moves.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mobbscope {

namespace {

constexpr double kAlikePath = 0.15;      // metres
constexpr double kAlikeHeading = 10;     // degrees
constexpr double kAlikeDuration = 0.15;  // seconds
constexpr std::size_t kPlaces = 5;  // at which paths are compared, at equal shares of their time; the last is the end

struct Course {
    std::array<glm::dvec2, kPlaces> places;  // metres, from the hub that the piece begins in
    double turn_deg;
    double seconds;
};

Course course_of(const std::vector<Recording>& recordings, const Piece& piece) {
    const PoseTrack& track = recordings[static_cast<std::size_t>(piece.begin.recording)].track;
    const mobb::Rotation turn = mobb::Rotation::from_degrees(-piece.begin.heading_deg);
    const int frames = piece.end.frame - piece.begin.frame;
    Course course{{}, piece.end.heading_deg - piece.begin.heading_deg, frames * track.dt};
    const glm::dvec2 begin = track.root[static_cast<std::size_t>(piece.begin.frame)];
    for (std::size_t k = 0; k < kPlaces; ++k) {
        const int frame = piece.begin.frame + static_cast<int>((k + 1) * static_cast<std::size_t>(frames) / kPlaces);
        course.places[k] = turn(track.root[static_cast<std::size_t>(frame)] - begin);
    }
    return course;
}

/// At most 1 if they are alike.
double difference(const Course& a, const Course& b) {
    double most = std::abs(a.seconds - b.seconds) / kAlikeDuration;
    most = std::max(most, std::abs(std::remainder(a.turn_deg - b.turn_deg, 360.0)) / kAlikeHeading);
    for (std::size_t k = 0; k < kPlaces; ++k) {
        most = std::max(most, glm::distance(a.places[k], b.places[k]) / kAlikePath);
    }
    return most;
}

}  // namespace

std::vector<std::size_t> different_pieces(const std::vector<Recording>& recordings, const std::vector<Piece>& pieces,
                                          std::size_t most) {
    if (pieces.empty()) return {};
    std::vector<Course> courses;
    for (const Piece& piece : pieces) courses.push_back(course_of(recordings, piece));
    const auto to_hubs = [](const Piece& piece) { return piece.begin.distance + piece.end.distance; };
    const auto best = std::min_element(pieces.begin(), pieces.end(),
                                       [&](const Piece& a, const Piece& b) { return to_hubs(a) < to_hubs(b); });
    auto next = static_cast<std::size_t>(best - pieces.begin());
    std::vector<std::size_t> out;
    std::vector<double> to_nearest(pieces.size(), std::numeric_limits<double>::infinity());
    while (out.size() < most) {
        out.push_back(next);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            to_nearest[i] = std::min(to_nearest[i], difference(courses[i], courses[next]));
        }
        next = static_cast<std::size_t>(std::max_element(to_nearest.begin(), to_nearest.end()) - to_nearest.begin());
        if (to_nearest[next] <= 1) break;
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace mobbscope
