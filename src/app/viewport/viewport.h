/// The picture in the middle of the window, and what the mouse does in it.
#pragma once

#include <app/commands/camera_commands.h>
#include <app/document/views.h>
#include <app/ui/ui.h>
#include <app/viewport/agent_handles.h>
#include <app/viewport/conflict_marks.h>
#include <app/viewport/flight.h>
#include <app/viewport/measuring.h>
#include <render/drawlist/draw_list.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/kept_paths.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

class Viewport {
  public:
    /// Of views that share their camera, and have framed the scene in the last frame, one has all of it in each
    /// picture.
    static void frame_together(std::span<Viewport> viewports);

    /// Draws the picture of the session's view at a place into the current ImGui child window; of the active view
    /// handles and what is under the mouse too. A press makes a view the active one. A camera that is to frame the
    /// scene by itself does so here, and stands until the picture has another size; one that somebody has moved keeps
    /// its scale then.
    void draw(Ui& ui, std::size_t place);

    /// What the last frame's layout has found out goes into the document: the size of the pictures, a camera that
    /// framed the scene by itself, and the way to a pair under test. Between frames. Returns whether there was
    /// anything.
    bool settle(Views& views, Workspace& workspace);

    /// What it showed last, as `render` would draw it but for a flight under way and what is pointed out; null for an
    /// empty scene.
    const DrawList* shown() const { return list_ ? &*list_ : nullptr; }

    /// The record of the query that a view of the session shows here; null: it shows none.
    const RecordedQuery* recorded_in(const SceneView& seen);

  private:
    /// All that the picture depends on.
    struct Key {
        std::shared_ptr<const FittedScene> fitted;
        ViewState view;
        PictureSize size;
        double scale = 0;
        std::pair<int, int> choice{-1, -1};         ///< agent and play whose candidates are shown
        std::string selected{};                     ///< as PictureOptions has it
        std::int64_t counted = 0;                   ///< SceneFigures::revision, where the colours depend on it
        std::shared_ptr<const BoxColors> colors{};  ///< of boxes of levels; null: their agents'
        friend bool operator==(const Key&, const Key&) = default;
    };
    enum class Drag { none, orbit, pan, handle, measured };

    struct LaidOut {
        std::optional<PictureSize> size;
        std::optional<Framed> framed;
        Camera camera;                                                    ///< that has it in the picture
        std::optional<std::pair<TestCorners, std::vector<Rect>>> to_see;  ///< beside these panels
    };

    bool is_active(const Ui& ui) const { return view_place_ == ui.session.views.active(); }
    void update_picture(Ui& ui, PictureSize size);
    Key wanted(const Ui& ui, PictureSize size, const FollowedChoice* choice) const;
    void stand(Ui& ui, Key& next, const FollowedChoice* choice);
    void follow_test(Ui& ui);
    KeptPaths& paths_of(const Key& key);
    static PictureOptions options_of(const Key& key);
    void build(const Key& key, const FollowedChoice* choice);
    void take_off(Ui& ui, const Key& next);
    void update_highlights(const Ui& ui);
    void show(Ui& ui, ImVec2 corner);
    void sign_of_work(Ui& ui, ImVec2 end) const;
    void mouse(Ui& ui, const ShownPicture& picture);
    void wheel(Ui& ui, glm::vec2 pixel);
    void take_end(Ui& ui, glm::vec2 pixel, LineEnd which) const;
    void press(Ui& ui, const ShownPicture& picture, glm::vec2 pixel);
    void drag(Ui& ui, glm::vec2 pixel);
    void release(Ui& ui, glm::vec2 pixel);
    void hover(Ui& ui, glm::vec2 pixel);
    void click(Ui& ui, glm::vec2 pixel);
    void ask(Ui& ui, glm::vec2 pixel);
    ImVec2 place_of_selection(const Session& session, const ShownPicture& picture) const;
    void tooltip(Ui& ui) const;
    void handle_tooltip(Ui& ui, const mobb::Placement& placement) const;
    void decorate(Ui& ui, const ShownPicture& picture);
    void decorate_overlays(Ui& ui, const ShownPicture& picture) const;
    Camera shown_camera() const;
    void move_camera(Ui& ui, const Camera& camera);
    /// The agent that can be dragged, as it is selected and in the picture.
    struct Handles {
        PlacedAgent who;
        HandlePlaces places;
    };
    static std::optional<Handles> handles(Ui& ui, const ShownPicture& picture);
    static std::optional<DragPromise> promise_of(const Ui& ui, const HandleDrag& drag);
    bool drags_on_promise() const { return drag_ == Drag::handle && moved_ && promise_; }
    void promise_words(Ui& ui, const mobb::Placement& now) const;
    std::optional<HandleDrag> take_hold(Ui& ui, const ShownPicture& picture, glm::vec2 pixel) const;

    std::optional<KeptPaths> paths_;  ///< of key_'s scene
    std::shared_ptr<SceneFigures> figures_;
    std::shared_ptr<const RecordedQuery> recorded_;  ///< kept, as long as it is shown
    std::size_t view_place_ = 0;                     ///< of the session's views
    std::optional<Key> key_;                         ///< what the document asks for, a flight apart
    std::optional<PictureSize> size_;                ///< of the last picture
    std::optional<DrawList> list_;
    std::string why_not_;  ///< there is no list: the reason
    std::optional<Flight> flight_;
    using Changed = Painter::Changed;
    Changed unpainted_ = Changed::nothing;                ///< what has changed since the painter was told
    std::optional<std::pair<int, int>> test_looked_for_;  ///< query and step whose test the camera has followed to
    int restore_count_ = 0;                               ///< Session's, when that was asked

    LaidOut laid_out_;  ///< not settled yet

    Drag drag_ = Drag::none;
    HandleDrag handle_drag_;
    std::optional<DragPromise> promise_;   ///< of the answer when that drag began; none: nothing is promised
    Handle lit_ = Handle::none;            ///< under the mouse or held
    std::vector<ConflictMark> conflicts_;  ///< marked in the picture
    int lit_conflict_ = -1;                ///< whose mark is under the mouse
    glm::vec2 pressed_at_{0};
    glm::vec2 last_{0};
    LineEnd held_end_ = LineEnd::none;     ///< of what is measured, while it is dragged
    std::optional<MeasuredEnd> next_end_;  ///< that a click at the mouse would take
    bool on_measured_ = false;             ///< the mouse is on a measured number
    bool moved_ = false;                   ///< since the button went down: no click
    bool asks_ = false;                    ///< it is the right button: a click opens a menu
    bool over_nothing_ = false;            ///< the menu is the picture's
    std::size_t depth_ = 0;                ///< of the last click: another click at its place selects what lies behind
    glm::vec2 clicked_at_{-1e6f};
    std::optional<glm::dvec3> place_;  ///< under the mouse: x, y, t; in the picture of a moment the height
};

/// Buttons above the picture: where from, what is shown.
void viewport_toolbar(Ui& ui);

}  // namespace mobbscope::app
