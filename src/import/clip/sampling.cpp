#include <base/text.h>
#include <import/clip/sample_times.h>
#include <import/clip/sampling.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr double kHeadingDistance = 0.1;  // metres: the contract's least distance that gives a heading

}  // namespace

bool is_in_milliseconds(double t) {
    const double count = t / kMillisecond;
    constexpr double kNoise = 8 * std::numeric_limits<double>::epsilon();
    return std::abs(count - std::round(count)) <= kNoise * std::abs(count);
}

double time_tolerance(double step, double rounding) {
    constexpr double kFewest = 4;         // so many times what times are rounded to, steps are still told apart
    constexpr double kNearly = 1 - 1e-6;  // a whole one off is no rounding
    return std::max(kFrameTolerance * step, step >= kFewest * rounding ? kNearly * rounding : 0);
}

std::optional<std::size_t> first_out_of_step(std::span<const TimedDisk> frames, double rounding) {
    const double begin = frames.front().t;
    const double dt = (frames.back().t - begin) / static_cast<double>(frames.size() - 1);
    const double tolerance = time_tolerance(dt, rounding);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (std::abs(frames[i].t - (begin + static_cast<double>(i) * dt)) > tolerance) return i;
    }
    return std::nullopt;
}

double sample_count(double begin, double end, double step) {
    return std::max(std::floor((end - begin) / step + kEndTolerance), 0.0) + 1;
}

SampleGrid sample_grid(double first, double last, const std::optional<std::pair<double, double>>& trim, double step,
                       std::size_t most) {
    check_file_times(step, std::max(std::abs(first), std::abs(last)));
    const double length = last - first;
    const auto [from, to] = trim.value_or(std::pair{0.0, length});
    if (from > length) {
        throw std::invalid_argument("trim begins at " + format_double(from) + " s but the file lasts " +
                                    format_double(length) + " s");
    }
    const double count = sample_count(from, std::min(to, length), step);
    if (count > static_cast<double>(most)) {
        throw std::invalid_argument("its times make more than " + std::to_string(most) +
                                    " samples; check them, or lower fps");
    }
    return {first + from, step, static_cast<std::size_t>(count)};
}

mobb::Disk mix(const mobb::Disk& a, const mobb::Disk& b, double share) {
    return {std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share), std::lerp(a.r, b.r, share)};
}

std::vector<mobb::Disk> sample(std::span<const TimedDisk> frames, const SampleGrid& grid) {
    std::vector<mobb::Disk> out;
    out.reserve(grid.count);
    std::size_t next = 0;  // the first frame not before the time
    for (std::size_t k = 0; k < grid.count; ++k) {
        const double t = grid.time(k);
        while (next < frames.size() && frames[next].t < t) ++next;
        if (next == 0) {
            out.push_back(frames.front().disk);
        } else if (next == frames.size()) {
            out.push_back(frames.back().disk);
        } else {
            const TimedDisk& a = frames[next - 1];
            const TimedDisk& b = frames[next];
            // In a long gap a share of it would be many samples.
            const double near = kFrameTolerance * std::min(b.t - a.t, grid.step);
            if (t - a.t <= near) {
                out.push_back(a.disk);
            } else if (b.t - t <= near) {
                out.push_back(b.disk);
            } else {
                out.push_back(mix(a.disk, b.disk, (t - a.t) / (b.t - a.t)));
            }
        }
    }
    return out;
}

mobb::Rotation put_at_origin(std::vector<mobb::Disk>& samples, Origin origin) {
    if (origin == Origin::keep) return {};
    const mobb::Disk start = samples.front();
    for (mobb::Disk& disk : samples) {
        disk.x -= start.x;
        disk.y -= start.y;
    }
    if (origin == Origin::start) return {};
    for (const mobb::Disk& ahead : samples) {
        const double distance = std::hypot(ahead.x, ahead.y);
        if (distance < kHeadingDistance) continue;
        const mobb::Rotation turn{ahead.x / distance, -ahead.y / distance};
        for (mobb::Disk& disk : samples) {
            const glm::dvec2 turned = turn({disk.x, disk.y});
            disk = {turned.x, turned.y, disk.r};
        }
        return turn;
    }
    return {};
}

void turn_headings(std::vector<double>& headings, const mobb::Rotation& turn) {
    for (double& heading : headings) heading += std::atan2(turn.s, turn.c) * (180 / std::numbers::pi);
}

}  // namespace mobbscope
