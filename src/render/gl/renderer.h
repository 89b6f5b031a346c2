/// Turns draw lists into pixels.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/gl/gl_context.h>
#include <render/gl/gl_objects.h>
#include <render/image/image.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// For how long to paint, by which clock (seconds).
struct PaintPace {
    const std::function<double()>& clock;
    double seconds;
};

/// How far the nearest disk is, from 0 (near) to 1 (far, or none), a number a pixel, rows from top to bottom.
struct DepthImage {
    int width = 0;
    int height = 0;
    std::vector<float> depths;

    /// At pixel (x, y), which must lie in the image.
    float at(int x, int y) const {
        return depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

/// Holds a context and what it keeps between pictures. Pictures depend on the draw list alone, and not on what others
/// left switched on in the context; they leave it with a framebuffer of their own bound, and with state of their own.
/// Not for several threads.
class Renderer {
  public:
    /// Throws MachineError if there is no such context.
    explicit Renderer(Backend backend = Backend::automatic);
    /// Draws in a context that exists (not null). Throws MachineError if it is not OpenGL 3.3 core.
    explicit Renderer(std::unique_ptr<GlContext> context);
    ~Renderer();

    /// The name of the context in use: "osmesa", "egl", or "window".
    std::string_view backend() const { return context().name(); }
    /// For what else draws in it.
    GlContext& context();
    const GlContext& context() const;

    /// What the last picture took; of one that is seen through the second half.
    const DrawStatistics& statistics() const;

    /// What a person is to be told of the pictures that were painted: that they have fewer samples, as memory lacks.
    /// Empty: nothing.
    const std::string& notice() const;

    /// Throws MachineError, saying the most it can, if the context cannot draw so many samples per pixel.
    void check_samples(int samples);

    /// Draws without reading back. `samples` per pixel of the scene (>= 1; 1 is no multisampling, and its cost). The
    /// texture is RGBA8 of the list's size, opaque, its first row the lowest; it holds the picture until the next paint
    /// or draw. A background that is seen through is drawn as the palette's. Where memory lacks for so many samples it
    /// has one, and `notice` says so. Throws MachineError if OpenGL reports an error or cannot do the samples.
    const Texture& paint(const DrawList& list, int samples);

    /// As paint with one sample, but for disks and faces, which are drawn on every `divisor`-th (>= 1) pixel across and
    /// down, and enlarged.
    const Texture& paint_coarse(const DrawList& list, int divisor);

    /// As paint, in parts, where the policy has slices: paint_more goes on for about so long, and returns the picture
    /// once it stands, else null. Until then the list stays as it is, but for its highlights; another picture ends it.
    void begin_paint(const DrawList& list, int samples);
    const Texture* paint_more(const DrawList& list, const PaintPace& pace);
    /// Whether paint_more may be called.
    bool is_painting(const DrawList& list) const;

    /// Until all that was drawn stands, where the policy finishes.
    void wait() const;

    /// Whether paint_highlights has less to do than paint.
    bool has_scene(const DrawList& list, int samples) const;

    /// Whether paint has fewer than all disks to draw, as the last such picture shows them in the same places: they may
    /// have other colours. Ends what is painted in parts.
    bool has_disks(const DrawList& list, int samples);

    /// As paint for a list of which nothing but the highlights has changed since it was painted: if that was the last
    /// picture and is multisampled, the highlights' lines are all that is uploaded and drawn of the scene.
    const Texture& paint_highlights(const DrawList& list, int samples);

    /// Paints and reads back; has alpha if the list's background is seen through. Throws MachineError as paint does,
    /// and where memory lacks for the samples.
    Image draw(const DrawList& list, int samples = kPictureSamples);

    /// As draw with one sample, but as paint_coarse has it: a preview. `divisor` >= 1; 1 is draw with one sample.
    /// Throws MachineError as draw does.
    Image draw_coarse(const DrawList& list, int divisor);

    /// What is nearest in each pixel: disks, and the boxes of nodes whether or not their faces are shown.
    IdImage draw_ids(const DrawList& list);

    /// The depths that lines are held against.
    DepthImage draw_depths(const DrawList& list);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mobbscope
