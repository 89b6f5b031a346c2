#include <render/gl/renderer.h>

#include <base/error.h>
#include <render/gl/box_buffer.h>
#include <render/gl/disk_pass.h>
#include <render/gl/driver_watch.h>
#include <render/gl/face_pass.h>
#include <render/gl/gl_objects.h>
#include <render/gl/line_pass.h>
#include <render/gl/overlay_pass.h>
#include <render/gl/resolve_pass.h>
#include <render/gl/targets.h>
#include <render/image/image.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace mobbscope {

namespace {

/// OpenGL's first row is the lowest.
template <class T>
void flip_rows(std::vector<T>& values, int width, int height, int per_pixel) {
    const auto row = static_cast<std::ptrdiff_t>(width) * per_pixel;
    for (std::ptrdiff_t low = 0, high = height - 1; low < high; ++low, --high) {
        std::swap_ranges(values.begin() + low * row, values.begin() + (low + 1) * row, values.begin() + high * row);
    }
}

Rgba ground_of(const DrawList& list) { return list.background.value_or(list.palette.background); }

bool is_seen_through(const DrawList& list) { return ground_of(list).a < 1; }

Rgba opaque_ground_of(const DrawList& list) {
    return is_seen_through(list) ? list.palette.background : ground_of(list);
}

// Of a picture that is painted in parts.
constexpr std::size_t kDisksAtFirst = 32;
constexpr double kPartSeconds = 0.01;

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
// Whose edges are drawn; of a coarse picture they would take longer than all else.
constexpr std::size_t kMostBoxesCoarse = 1000;

/// Makes the bound framebuffer's one colour take what shaders write to an output.
void write_output(GLsizei output) {
    std::array<GLenum, 3> outputs{GL_NONE, GL_NONE, GL_NONE};
    outputs[static_cast<std::size_t>(output)] = GL_COLOR_ATTACHMENT0;
    glDrawBuffers(output + 1, outputs.data());
}

std::unique_ptr<GlContext> made_current(std::unique_ptr<GlContext> context) {
    context->make_current();
    return context;
}

}  // namespace

/// The context is the first member, so that it outlives everything made in it.
struct Renderer::State {
    explicit State(std::unique_ptr<GlContext> drawn_in)
        : context(made_current(std::move(drawn_in))),
          disks(*context),
          faces(*context, boxes),
          lines(*context, boxes),
          overlay(*context),
          resolve(*context) {}

    /// Another picture: what was painted in parts is given up, and what stands is no longer taken for that of a list.
    void begin(PictureSize size) {
        statistics = {};
        work.reset();
        painted = {};
        resume(size);
    }

    void resume(PictureSize size) {
        context->make_current();
        reset_state();
        glViewport(0, 0, size.width, size.height);
    }

    /// Where pictures of one kind are made.
    struct Canvas {
        std::optional<Targets> targets;
        std::optional<DiskPass::VisibilityKey> visibility_key;  ///< that the targets have
        std::optional<DiskPass::VisibilityKey> colored_key;     ///< of the last picture whose visibility was not kept
        int samples = 0;                                        ///< that were asked for
    };

    /// Whether a picture may have fewer samples than were asked for, where memory lacks.
    enum class Fewer { allowed, refused };

    /// What a picture needs beside colours and depth.
    struct Needs {
        bool visibility = false;
        bool faces = false;
    };

    void prepare(Canvas& canvas, PictureSize size, int samples, Needs needs, Fewer fewer) {
        const bool fits = canvas.targets && canvas.targets->size() == size && canvas.samples == samples &&
                          (fewer == Fewer::allowed || canvas.targets->samples() == samples);
        context->check("drawing");
        try {
            if (!fits) {
                canvas = {};
                canvas.samples = samples;
                canvas.targets.emplace(size, samples);
            }
            if (needs.visibility) canvas.targets->need_visibility();
            if (needs.faces) canvas.targets->need_faces();
        } catch (const LacksMemory&) {
            if (samples == 1) throw;
            const std::string lacks = "this OpenGL (" + std::string(context->name()) + ") lacks memory for " +
                                      std::to_string(samples) + " samples of each pixel: ";
            if (fewer == Fewer::refused) throw MachineError(lacks + "take fewer, or make the picture smaller");
            canvas.targets.reset();
            prepare(canvas, size, 1, needs, Fewer::refused);
            canvas.samples = samples;
            notice = lacks + "edges are less smooth";
        }
    }

    /// What is left of a picture that is painted in parts.
    enum class Part { disks, colors, faces, lines, words };
    struct Work {
        Revision of;
        Canvas* canvas;
        Rgba ground;
        bool keeps_visibility = true;
        Part next = Part::disks;
        std::size_t disks_at_once = kDisksAtFirst;
        std::size_t most_boxes = kAll;
    };

    DiskPass::VisibilityKey visibility_key_of(const DrawList& list, int samples) {
        return disks.visibility_key(list, samples > 1 ? Detail::fine : Detail::coarse);
    }

    /// What a picture is drawn for: to be shown, while others follow; to be read back, once or on two grounds.
    enum class For { showing, reading, reading_twice };

    /// Into the result's framebuffer, on a ground that is taken for opaque. Which disks are seen where is the dearest
    /// part of a picture. Where the one before had the same, of whatever colours, it is taken from that: a query's
    /// steps and a time cursor move through them. Keeping it is dear, too: a picture that is read back, which may be
    /// the only one, does so only if the one before it could have been taken.
    void begin_paint(const DrawList& list, Canvas& canvas, int samples, Rgba ground, For what_for) {
        const Fewer fewer = what_for == For::showing ? Fewer::allowed : Fewer::refused;
        begin(list.size);
        check_samples(samples);
        visibility_key = visibility_key_of(list, samples);
        const bool keeps_visibility =
            what_for != For::reading || canvas.visibility_key == visibility_key || canvas.colored_key == visibility_key;
        prepare(canvas, list.size, samples, {keeps_visibility, FacePass::needed(list)}, fewer);
        if (canvas.targets->samples() != samples) visibility_key = visibility_key_of(list, canvas.targets->samples());
        boxes.keep(list, statistics);
        work.emplace(Work{list.revision, &canvas, ground, keeps_visibility});
        disks.begin(visibility_key, !keeps_visibility, statistics);
        if (canvas.visibility_key == visibility_key) {
            work->next = Part::colors;
            return;
        }
        canvas.visibility_key.reset();
        canvas.colored_key.reset();
        glClearDepth(1);
        if (keeps_visibility) {
            glBindFramebuffer(GL_FRAMEBUFFER, canvas.targets->visibility_buffer().name());
            glClearColor(0, 0, 0, 0);
        } else {
            glBindFramebuffer(GL_FRAMEBUFFER, canvas.targets->scene().name());
            glClearColor(ground.r, ground.g, ground.b, 1);
        }
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }
    void begin_paint(const DrawList& list, int samples, Rgba ground, For what_for) {
        begin_paint(list, samples > 1 ? fine : coarse, samples, ground, what_for);
    }

    void draw_faces(const Targets& targets, const DrawList& list) {
        if (!FacePass::needed(list)) return;
        glBindFramebuffer(GL_FRAMEBUFFER, targets.faces().name());
        faces.accumulate(list, targets.samples() > 1 ? &targets.scene_depth() : nullptr, statistics);
        glBindFramebuffer(GL_FRAMEBUFFER, targets.scene().name());
        faces.composite(targets.sums(), targets.weights(), list.size, statistics);
    }

    /// Draws the next part; true once the picture stands.
    bool draw_part(const DrawList& list, std::size_t most_disks) {
        Canvas& canvas = *work->canvas;
        const Targets& targets = *canvas.targets;
        const bool into_visibility = work->next == Part::disks && work->keeps_visibility;
        glBindFramebuffer(GL_FRAMEBUFFER, (into_visibility ? targets.visibility_buffer() : targets.scene()).name());
        switch (work->next) {
            case Part::disks:
                if (!work->keeps_visibility) {
                    write_output(2);
                    disks.draw_more(list, kAll, statistics);
                    write_output(0);
                    canvas.colored_key = visibility_key;
                    work->next = Part::faces;
                    return false;
                }
                if (!disks.draw_more(list, most_disks, statistics)) return false;
                canvas.visibility_key = visibility_key;
                work->next = Part::colors;
                return false;
            case Part::colors:
                glClearColor(work->ground.r, work->ground.g, work->ground.b, 1);
                glClear(GL_COLOR_BUFFER_BIT);
                if (!canvas.visibility_key->batches.empty()) disks.tint(list, targets.visibility(), statistics);
                work->next = Part::faces;
                return false;
            case Part::faces:
                draw_faces(targets, list);
                work->next = Part::lines;
                return false;
            case Part::lines:
                lines.draw_scene(list, work->most_boxes, statistics);
                work->next = Part::words;
                return false;
            case Part::words:
                overlay.keep(list, statistics);
                lines.keep_overlay(list, statistics);
                finish(targets, list);
                painted = {list.revision, &canvas};
                work.reset();
        }
        return true;
    }

    void paint(const DrawList& list, int samples, Rgba ground, For what_for) {
        begin_paint(list, samples, ground, what_for);
        while (!draw_part(list, kAll)) {
        }
    }

    /// For about so long, where the policy has slices; whether the picture stands.
    bool go_on(const DrawList& list, const PaintPace& pace) {
        resume(list.size);
        const DrawingPolicy& policy = context->policy();
        const double end = pace.clock() + pace.seconds;
        for (;;) {
            const double begun = pace.clock();
            const bool disks_drawn = work->next == Part::disks;
            if (draw_part(list, policy.slices ? work->disks_at_once : kAll)) return true;
            if (!policy.slices) continue;
            if (policy.finishes) glFinish();
            const double now = pace.clock();
            if (disks_drawn && now - begun < kPartSeconds / 2) work->disks_at_once *= 2;
            if (disks_drawn && now - begun > kPartSeconds)
                work->disks_at_once = std::max<std::size_t>(1, work->disks_at_once / 2);
            if (now >= end) return false;
        }
    }

    /// Disks and faces on fewer pixels; lines and words, which are narrow, on all.
    void paint_coarse(const DrawList& list, int divisor, Rgba ground, For what_for) {
        if (divisor == 1) return paint(list, 1, ground, what_for);
        const auto part = [&](int side) { return (side + divisor - 1) / divisor; };
        DrawList small;
        static_cast<PictureFrame&>(small) = static_cast<const PictureFrame&>(list);
        static_cast<DrawnWorld&>(small) = static_cast<const DrawnWorld&>(list);
        small.palette = list.palette;
        small.size = small.projection.size = {part(list.size.width), part(list.size.height)};
        begin_paint(small, low, 1, ground, what_for);
        while (work->next != Part::lines) draw_part(small, kAll);

        resume(list.size);
        prepare(coarse, list.size, 1, {}, Fewer::refused);
        coarse.visibility_key.reset();
        coarse.targets->enlarge(*low.targets);
        work->canvas = &coarse;
        work->most_boxes = kMostBoxesCoarse;
        while (!draw_part(list, kAll)) {
        }
    }

    /// Whether the targets have the scene of a list by itself, without what lies over it.
    bool has_scene(const DrawList& list, int samples) const {
        return painted.of == list.revision && painted.canvas->samples == samples &&
               painted.canvas->targets->samples() > 1;
    }

    bool has_disks(const DrawList& list, int samples) {
        work.reset();
        const Canvas& canvas = samples > 1 ? fine : coarse;
        return canvas.targets && canvas.targets->size() == list.size && canvas.samples == samples &&
               canvas.visibility_key == visibility_key_of(list, canvas.targets->samples());
    }

    /// The picture out of the scene in the targets, its highlights and its words.
    void finish(const Targets& targets, const DrawList& list) {
        glBindFramebuffer(GL_FRAMEBUFFER, targets.result().name());
        if (targets.samples() > 1) resolve.draw(targets.scene_color(), targets.samples(), statistics);
        lines.draw_highlights(list, statistics);
        overlay.draw_panels(list.size, statistics);
        lines.draw_overlay(list.size, statistics);
        overlay.draw_texts(list.size, statistics);
        context->check("drawing");
        note_drawn();
    }

    /// What `paint_on` makes of a ground, read back; where the background is seen through, of two: what is drawn covers
    /// each pixel as much as it hides their difference.
    template <class PaintOn>
    Image drawn(const DrawList& list, const PaintOn& paint_on) {
        const auto draw_on = [&](Rgba ground) {
            paint_on(ground, is_seen_through(list) ? For::reading_twice : For::reading);
            Image image(list.size.width, list.size.height);
            glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
            context->check("reading the picture");
            flip_rows(image.rgba, image.width, image.height, 4);
            painted = {};
            return image;
        };
        if (!is_seen_through(list)) return draw_on(ground_of(list));
        const Rgba ground = list.palette.background;
        const Rgba other = list.palette.dark ? Rgba(1) : Rgba(0, 0, 0, 1);
        const Image on_ground = draw_on(ground);
        return with_transparent_background({on_ground, ground}, {draw_on(other), other}, *list.background);
    }

    const Texture& picture() const { return painted.canvas->targets->picture(); }

    void check_samples(int samples) const {
        GLint most = 1;
        GLint most_read = 1;  // one by one
        GLint most_depth = 1;
        glGetIntegerv(GL_MAX_SAMPLES, &most);
        glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &most_read);
        glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &most_depth);
        most = std::min({most, most_read, most_depth});
        if (samples <= std::max(most, 1)) return;
        throw MachineError("this OpenGL (" + std::string(context->name()) + ") draws at most " + std::to_string(most) +
                           " samples a pixel, not " + std::to_string(samples));
    }

    std::unique_ptr<GlContext> context;
    std::string notice;
    DrawStatistics statistics;
    /// What stands where; of nothing after a picture was read back.
    struct Painted {
        Revision of;
        Canvas* canvas = nullptr;
    };
    Painted painted;
    std::optional<Work> work;
    DiskPass::VisibilityKey visibility_key;  ///< of what is being drawn
    BoxBuffer boxes;
    DiskPass disks;
    FacePass faces;
    LinePass lines;
    OverlayPass overlay;
    ResolvePass resolve;
    Canvas fine, coarse, low;  ///< multisampled; without that; that and smaller
};

Renderer::Renderer(Backend backend) : Renderer(GlContext::open(backend)) {}

Renderer::Renderer(std::unique_ptr<GlContext> context) : state_(std::make_unique<State>(std::move(context))) {}

Renderer::~Renderer() {
    if (state_->context->try_make_current()) return;
    // The names would be deleted in whichever context is current; the context takes its objects along instead.
    const std::unique_ptr<GlContext> context = std::move(state_->context);
    static_cast<void>(state_.release());
}

const DrawStatistics& Renderer::statistics() const { return state_->statistics; }

GlContext& Renderer::context() { return *state_->context; }

const GlContext& Renderer::context() const { return *state_->context; }

const std::string& Renderer::notice() const { return state_->notice; }

void Renderer::check_samples(int samples) {
    state_->context->make_current();
    state_->check_samples(samples);
}

const Texture& Renderer::paint(const DrawList& list, int samples) {
    state_->paint(list, samples, opaque_ground_of(list), State::For::showing);
    return state_->picture();
}

const Texture& Renderer::paint_coarse(const DrawList& list, int divisor) {
    state_->paint_coarse(list, divisor, opaque_ground_of(list), State::For::showing);
    return state_->picture();
}

void Renderer::begin_paint(const DrawList& list, int samples) {
    state_->begin_paint(list, samples, opaque_ground_of(list), State::For::showing);
}

bool Renderer::is_painting(const DrawList& list) const { return state_->work && state_->work->of == list.revision; }

const Texture* Renderer::paint_more(const DrawList& list, const PaintPace& pace) {
    return state_->go_on(list, pace) ? &state_->picture() : nullptr;
}

void Renderer::wait() const {
    if (state_->context->policy().finishes) glFinish();
}

bool Renderer::has_scene(const DrawList& list, int samples) const { return state_->has_scene(list, samples); }

bool Renderer::has_disks(const DrawList& list, int samples) { return state_->has_disks(list, samples); }

const Texture& Renderer::paint_highlights(const DrawList& list, int samples) {
    if (!state_->has_scene(list, samples)) return paint(list, samples);
    const State::Painted painted = state_->painted;
    state_->begin(list.size);
    state_->finish(*painted.canvas->targets, list);
    state_->painted = painted;
    return state_->picture();
}

Image Renderer::draw(const DrawList& list, int samples) {
    return state_->drawn(list,
                         [&](Rgba ground, State::For what_for) { state_->paint(list, samples, ground, what_for); });
}

Image Renderer::draw_coarse(const DrawList& list, int divisor) {
    return state_->drawn(
        list, [&](Rgba ground, State::For what_for) { state_->paint_coarse(list, divisor, ground, what_for); });
}

namespace {

void clear_ids() {
    const std::array<GLuint, 4> nothing{0, 0, 0, 0};
    const GLfloat farthest = 1;
    write_output(0);
    glClearBufferuiv(GL_COLOR, 0, nothing.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
}

}  // namespace

IdImage Renderer::draw_ids(const DrawList& list) {
    State& s = *state_;
    s.begin(list.size);
    const IdTarget target(list.size);
    clear_ids();
    write_output(1);  // ids of disks
    s.disks.draw(list, Detail::fine, s.statistics);
    write_output(2);  // ids of boxes
    s.boxes.keep(list, s.statistics);
    s.faces.draw_ids(list, s.statistics);

    IdImage image{list.size.width, list.size.height, {}};
    image.rg.resize(2 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    glReadPixels(0, 0, image.width, image.height, GL_RG_INTEGER, GL_UNSIGNED_INT, image.rg.data());
    s.context->check("drawing object ids");
    note_drawn();
    flip_rows(image.rg, image.width, image.height, 2);
    return image;
}

DepthImage Renderer::draw_depths(const DrawList& list) {
    State& s = *state_;
    s.begin(list.size);
    const IdTarget target(list.size);
    clear_ids();
    write_output(1);
    s.disks.draw(list, Detail::fine, s.statistics);

    DepthImage image{list.size.width, list.size.height, {}};
    image.depths.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    glReadPixels(0, 0, image.width, image.height, GL_DEPTH_COMPONENT, GL_FLOAT, image.depths.data());
    s.context->check("drawing depths");
    note_drawn();
    flip_rows(image.depths, image.width, image.height, 1);
    return image;
}

}  // namespace mobbscope
