/// All pictures of a run in one, small, each with the name of its case: what did not pass stands first, with its
/// outcome in words and a coloured frame; also where there is no picture of it.
#pragma once

#include <cases/case_result.h>
#include <render/gl/renderer.h>
#include <render/image/image.h>

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace mobbscope::picture_tests {

class ContactSheet {
  public:
    /// For so many cases: the more, the smaller are their pictures.
    explicit ContactSheet(std::size_t cases);

    /// Keeps a small picture of a result that has one.
    void add(const CaseResult& result);
    /// `columns`: none: about as many as rows. Nothing if there are no results. Throws std::invalid_argument if it
    /// would be too large, MachineError if OpenGL reports an error.
    std::optional<Image> draw(std::span<const CaseResult> results, std::optional<int> columns,
                              Renderer& renderer) const;

  private:
    PictureSize most_;
    std::map<std::string, Image> pictures_;  ///< by name of the case
};

}  // namespace mobbscope::picture_tests
