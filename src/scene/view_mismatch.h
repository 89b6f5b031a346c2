/// A view that does not fit its scene.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace mobbscope {

/// A view names something that its scene does not have. what() says so, and what there is.
class ViewMismatch : public std::invalid_argument {
  public:
    /// `key`: that of the view's JSON, such as "query".
    ViewMismatch(std::string key, const std::string& message) : std::invalid_argument(message), key_(std::move(key)) {}
    const std::string& key() const { return key_; }

  private:
    std::string key_;
};

}  // namespace mobbscope
