/// Clips for measurements, from files.
#pragma once

#include <mobb/clip.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobb::bench {

/// A held clip as `mobbscope convert` writes it: CSV with the columns t,x,y,r. Throws std::runtime_error.
inline ClipPtr clip_from_csv(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    if (line != "t,x,y,r") throw std::runtime_error(path + ": the first line is not t,x,y,r");
    std::vector<Disk> samples;
    double first = 0, last = 0;
    while (std::getline(file, line)) {
        Disk disk;
        char comma = 0;
        std::istringstream in(line);
        if (!(in >> last >> comma >> disk.x >> comma >> disk.y >> comma >> disk.r)) {
            throw std::runtime_error(path + ": cannot read " + line);
        }
        if (samples.empty()) first = last;
        samples.push_back(disk);
    }
    if (samples.size() < 2) throw std::runtime_error(path + ": fewer than two samples");
    const double dt = (last - first) / static_cast<double>(samples.size() - 1);
    return std::make_shared<const Clip>(dt, std::move(samples));
}

}  // namespace mobb::bench
