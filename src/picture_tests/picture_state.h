/// What a picture shows, as data that is the same on every machine: the golden `NAME.state.json` beside `NAME.png`.
///
///     {"mobbscope_state": 1,
///      "panels": [{"title": "root", "size": [640, 360],
///        "agents": [{"name": "A", "translate": [1, 2], "rotate_deg": 30, "start": 0.25,
///                    "clip": {"samples", "dt", "motion", "sum"}, "tree": {"nodes", "digest", "sum"}}],
///        "fit": {...}, "view": {...},                       as in scene files
///        "query": {"a", "b", "step": 14, "sentence"},       or null
///        "camera": {"camera": {...}, "time_height": 2},     as in a view, also where it frames the scene by itself
///        "words": {"caption": [...], "tick": [...], ...},   by what the text is (TextRole)
///        "drawn": {"boxes of A, level 2": {"count", "digest", "places", "sizes", "colors", "order"}, ...}}]}
///
/// `agents` are those that are drawn. Of a window the one panel is its state (app/script/state_json.h), and "imgui" is
/// the version of Dear ImGui that drew its words. Compilers may round the last digit of a number otherwise, so digests
/// are of names and whole numbers alone. Other numbers are in sums of absolute values: metres, pixels, colours. In
/// `order` each of them has a weight that follows from its place in the order of drawing.
#pragma once

#include <picture_tests/shot.h>
#include <render/drawlist/draw_list.h>

#include <string>
#include <vector>

namespace mobbscope::picture_tests {

inline constexpr int kStateVersion = 1;

/// The state of a shot without a window. `lists`: of its panels (panel_lists).
std::string picture_state(const Shot& shot, const std::vector<DrawList>& lists);

/// The state of a window, of what its panels show (window_picture.h).
std::string window_state(const std::string& panels);

/// What differs in two states.
struct StateDifferences {
    /// One line each, the cause first: "B moved by (0.1, 0)", "level 3 was 2", "boxes of A, level 2: other colours".
    /// What follows from a cause, such as where boxes are drawn, is only told where no cause is known.
    std::vector<std::string> lines;
    std::string other_imgui;  ///< of two windows "1.90.1 for 1.86"; empty: it is the same one
};

/// Numbers of the scene and the view agree within 1e-9 or 1e-8 of their size; those of the camera, of what is drawn and
/// of a window within 1e-4 or 2e-5. Throws InputError if the golden is no state; `file` stands for it in messages.
StateDifferences compare_states(const std::string& actual, const std::string& golden, const std::string& file);

}  // namespace mobbscope::picture_tests
