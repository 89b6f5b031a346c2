/// Names of one list on little room: what tells them apart stays.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mobbscope {

/// Whether a text has room where it is to stand.
using TextFits = std::function<bool(const std::string&)>;

/// The names of a list, of which each is told from those that begin alike.
class NameList {
  public:
    /// `name_of` is asked for the names when the first one is too long. It must live as long as this.
    NameList(std::size_t count, std::function<std::string(std::size_t)> name_of)
        : count_(count), name_of_(std::move(name_of)) {}
    explicit NameList(std::vector<std::string> names);

    /// A name of the list as it is if it fits. Else an ellipsis stands for what it has in common with those that begin
    /// alike ("\u202607_05_30hz", "cm\u202605\u2026"); where the rest is still too long, for all but what tells it
    /// from them ("\u202607_05\u2026" of "cmu_07_05_walk_30hz"); of one that stands alone for its middle.
    std::string shortened(std::string_view name, const TextFits& fits) const;

  private:
    void read() const;

    std::size_t count_;
    std::function<std::string(std::size_t)> name_of_;
    /// Names that begin with the same letters, by these; empty: not yet read.
    mutable std::unordered_map<std::string, std::vector<std::string>> kin_;
};

}  // namespace mobbscope
