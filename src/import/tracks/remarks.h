/// What comments of a text say of its frame rate and unit. They are written for people: what is not understood is
/// ignored, never refused.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

class Remarks {
  public:
    /// Takes in one comment, without the sign that begins it.
    void read(std::string_view comment);

    std::optional<double> rate() const { return rate_.value; }  ///< frames per second, over 0 to kMaxFrameRate
    std::optional<double> unit() const { return unit_.value; }  ///< metres per unit of the coordinates

    /// What was ignored, a sentence each.
    const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    /// What was said, and how plainly.
    struct Said {
        std::optional<double> value{};
        int weight = 0;
    };

    void read_rate(const std::vector<std::string>& words, std::string_view comment);
    void read_unit(const std::vector<std::string>& words);
    /// The plainer one stays, of equals the first.
    void take(Said& said, double value, int weight, const std::string& what);

    Said rate_;
    Said unit_;
    std::vector<std::string> warnings_;
};

}  // namespace mobbscope
