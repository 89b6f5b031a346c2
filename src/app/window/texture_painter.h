/// The viewports' pictures, and those of panels, as textures.
#pragma once

#include <app/ui/ui.h>
#include <app/window/adaptive_quality.h>
#include <app/window/shell.h>
#include <app/window/window_gl.h>
#include <render/drawlist/draw_list.h>
#include <render/gl/renderer.h>

#include <deque>
#include <limits>
#include <map>
#include <memory>

namespace mobbscope::app {

/// "Never", as seconds.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Has textures of its own: the renderer's holds what else it draws soon. Where coarse pictures come first
/// (DrawingPolicy), they stand in for fine ones that take long, which are painted in slices while nothing changes.
class TexturePainter final : public Painter {
  public:
    TexturePainter(Renderer& renderer, const Shell::Clock& clock) : renderer_(renderer), clock_(clock) {}

    Shown picture(std::size_t place, Changed changed, Interaction interaction, double now) override;
    ImTextureID image(std::size_t slot, const std::shared_ptr<const Image>& image, bool smooth) override;

    /// Those that no panel has asked for since the last time are gone.
    void drop_images();
    /// Paints what has changed since the last time.
    void paint_changes(std::size_t place, const DrawList& list);
    /// Seconds until the fine picture of what a place shows is to be gone on with.
    double fine_due_in(std::size_t place, double now) const;
    /// Goes on with it for a slice.
    void paint_on(std::size_t place, const DrawList& list);

    Shell::Painted painted() const { return painted_; }

  private:
    struct Picture {
        PictureCopy copy;
        Changed changed = Changed::nothing;
        Interaction interaction = Interaction::unattended;
        AdaptiveQuality quality;
        AdaptiveQuality::Needs needs = AdaptiveQuality::Needs::all;  ///< of the fine picture
        bool is_fine = true;
        double changed_at = 0;
        double seconds = 0;  ///< that the fine one has taken so far
    };
    struct Held {
        std::unique_ptr<ImageTexture> texture;
        bool is_asked_for = false;
    };

    void take(Picture& asked, const Texture& fine, const DrawList& list);
    bool paint_fine(Picture& asked, const DrawList& list, double seconds);
    void paint_coarse(Picture& asked, const DrawList& list);

    Renderer& renderer_;
    const Shell::Clock& clock_;
    std::deque<Picture> pictures_;        ///< by place
    std::map<std::size_t, Held> images_;  ///< by slot
    Shell::Painted painted_;
};

}  // namespace mobbscope::app
