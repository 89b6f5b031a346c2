/// What is another in two draw lists (draw_list_json.h), in words that name the thing: "the tick label '20 s' is
/// missing", "box of A, node 3, extents: 1.02 instead of 1".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

struct DrawListTerms {
    /// The golden was drawn with other fonts, whose words are wider or narrower. Where texts, overlays, panels, marks
    /// and overlay lines are is compared loosely, within 12 pixels or 4 % of the picture's longer side; a caption may
    /// break elsewhere, words may be cut elsewhere, a panel may have no room, and a label may be in one list alone
    /// where the other one has something else there. All that does not follow from widths is compared as ever.
    bool other_fonts = false;
    std::size_t most = 12;  ///< lines in each part of the result, at least 1; one more says how many are left out
};

struct DrawListComparison {
    /// What makes it another picture, one line for each thing: disks and boxes first, of them and of the rest what is
    /// missing or not in the golden before what differs; cameras last.
    std::vector<std::string> differences;
    std::size_t count = 0;  ///< of things, also those that are not told
    /// Of which things another number of pixels is seen: "disk of A, sample 3: 120 pixels instead of 200". It is only
    /// told, as another processor may decide otherwise what is in front where two are equally deep.
    std::vector<std::string> pixels;

    bool same() const { return count == 0; }
};

/// Compares two draw lists as JSON texts, two arrays of them (several panels: "picture 2, ..."), or any other JSON,
/// whose places are as in RFC 6901: "/view/levels: 2 instead of 3". Numbers agree within 1e-4 or 2e-5 of their size,
/// numbers of pixels within 16 or 1 %. Elements of arrays are held against what they stand for or are most like, so
/// that one that is missing makes no other differ. Of as many participants one with another name is the same one, and
/// its disks and boxes are compared. `id` counts only where no disk and no box is missing or added, `clip_from_world`
/// only where nothing else differs, and a text's `role` only where both lists have it. Takes time in proportion to the
/// texts. Throws InputError if one is no JSON; the names stand for the files.
DrawListComparison compare_draw_lists(std::string_view actual, const std::string& actual_name, std::string_view golden,
                                      const std::string& golden_name, const DrawListTerms& terms = {});

}  // namespace mobbscope
