/// The files that `render` writes, and that it writes nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_set>
#include <vector>

namespace mobbscope::cli {

/// What is made of one view; an empty name is not asked for.
struct RenderOutputs {
    std::filesystem::path image;  ///< the picture, .png, .svg or .pdf; or of several pictures the film, .mp4 or .webm
    std::filesystem::path ids;    ///< object ids, .png
    std::filesystem::path draw_list;  ///< what is drawn, .json

    bool any() const { return !image.empty() || !ids.empty() || !draw_list.empty(); }
    /// Those that are asked for.
    std::vector<std::filesystem::path> all() const;
};

/// Throws InputError if a name is none for what is written there, before anything is read.
void check_names(const RenderOutputs& outputs);

/// "walk.png" as "walk_0012.png". None of a film, which no single picture is.
RenderOutputs numbered(const RenderOutputs& outputs, int number, int digits);

/// Watches over all outputs of a run, when all is read and before the first is written.
class OutputCheck {
  public:
    /// Throws as check_output does, and InputError if a file would be written twice: better said before anything is
    /// drawn.
    void writes(const RenderOutputs& outputs);

  private:
    std::unordered_set<std::string> written_;
};

}  // namespace mobbscope::cli
