#include <render/gl/renderer.h>

#include <base/error.h>
#include <render/gl/box_buffer.h>
#include <render/gl/disk_pass.h>
#include <render/gl/driver_watch.h>
#include <render/gl/face_pass.h>
#include <render/gl/gl_objects.h>
#include <render/gl/line_pass.h>
#include <render/gl/overlay_pass.h>
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

/// By the names of Mesa's, Google's and Microsoft's software renderers.
bool draws_in_software(std::string_view device) {
    for (const char* software :
         {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader", "SWR", "GDI"}) {
        if (device.find(software) != std::string_view::npos) return true;
    }
    return false;
}

Rgba ground_of(const DrawList& list) { return list.background.value_or(list.palette.background); }

bool is_seen_through(const DrawList& list) { return ground_of(list).a < 1; }

Rgba opaque_ground_of(const DrawList& list) {
    return is_seen_through(list) ? list.palette.background : ground_of(list);
}

/// What `draw_on` gives of a ground; where the background is seen through, of two: what is drawn covers each pixel as
/// much as it hides their difference.
template <class DrawOn>
Image on_its_background(const DrawList& list, const DrawOn& draw_on) {
    if (!is_seen_through(list)) return draw_on(ground_of(list));
    const Rgba ground = list.palette.background;
    const Rgba other = list.palette.dark ? Rgba(1) : Rgba(0, 0, 0, 1);
    const Image on_ground = draw_on(ground);
    return with_transparent_background({on_ground, ground}, {draw_on(other), other}, *list.background);
}

// Of a picture that is painted in parts.
constexpr std::size_t kDisksAtFirst = 32;
constexpr double kPartSeconds = 0.01;

// Whose edges are drawn; of a coarse picture they would take longer than all else.
constexpr std::size_t kAllBoxes = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kMostBoxesCoarse = 1000;

std::unique_ptr<GlContext> made_current(std::unique_ptr<GlContext> context) {
    context->make_current();
    return context;
}

}  // namespace

/// The context is the first member, so that it outlives everything made in it.
struct Renderer::State {
    explicit State(std::unique_ptr<GlContext> drawn_in)
        : context(made_current(std::move(drawn_in))),
          device(gl_string(GL_RENDERER)),
          version(gl_string(GL_VERSION)),
          software(draws_in_software(device)),
          disks(*context),
          faces(*context, boxes),
          lines(*context, boxes),
          overlay(*context) {
        context->check("compiling shaders");
    }

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
        std::optional<DiskPass::Surfaces> surfaces;  ///< that the targets have

        void prepare(PictureSize size, int samples) {
            if (targets && targets->size() == size && targets->samples() == samples) return;
            targets.reset();
            targets.emplace(size, samples);
            surfaces.reset();
        }
    };

    /// What is left of a picture that is painted in parts.
    enum class Part { disks, colors, faces, lines, words };
    struct Work {
        const DrawList* list = nullptr;
        Canvas* canvas = nullptr;
        Rgba ground{0};
        Part next = Part::disks;
        std::size_t disks_at_once = kDisksAtFirst;
    };

    DiskPass::Surfaces surfaces_of(const DrawList& list, int samples) {
        return disks.surfaces(list, samples > 1 ? Detail::fine : Detail::coarse);
    }

    /// Which disks are seen where is the dearest part of a picture. Where the one before had the same, of whatever
    /// colours, it is taken from that: a query's steps and a time cursor move through them.
    void begin_disks(Work& on, const DrawList& list) {
        Canvas& canvas = *on.canvas;
        surfaces = surfaces_of(list, canvas.targets->samples());
        disks.begin(surfaces, statistics);
        if (canvas.surfaces == surfaces) {
            on.next = Part::colors;
            return;
        }
        canvas.surfaces.reset();
        glBindFramebuffer(GL_FRAMEBUFFER, canvas.targets->surfaces().name());
        glClearColor(0, 0, 0, 0);
        glClearDepth(1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }

    /// At most so many.
    void draw_disks(Work& on, const DrawList& list, std::size_t most) {
        glBindFramebuffer(GL_FRAMEBUFFER, on.canvas->targets->surfaces().name());
        if (!disks.draw_more(list, most, statistics)) return;
        on.canvas->surfaces = surfaces;
        on.next = Part::colors;
    }

    void draw_colors(const Canvas& canvas, const DrawList& list, Rgba ground) {
        glBindFramebuffer(GL_FRAMEBUFFER, canvas.targets->scene().name());
        glClearColor(ground.r, ground.g, ground.b, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        if (!canvas.surfaces->batches.empty()) disks.tint(list, canvas.targets->surface(), statistics);
    }

    void draw_faces(const Targets& targets, const DrawList& list) {
        if (!FacePass::needed(list)) return;
        targets.share_depth();
        glBindFramebuffer(GL_FRAMEBUFFER, targets.faces().name());
        faces.accumulate(list, statistics);
        glBindFramebuffer(GL_FRAMEBUFFER, targets.scene().name());
        faces.composite(targets.sums(), targets.weights(), list.size, statistics);
    }

    /// Into the result's framebuffer, on a ground that is taken for opaque.
    void begin_paint(const DrawList& list, int samples, Rgba ground) {
        begin(list.size);
        check_samples(samples);
        Canvas& canvas = samples > 1 ? fine : coarse;
        canvas.prepare(list.size, samples);
        boxes.keep(list, statistics);
        work = Work{&list, &canvas, ground};
        begin_disks(*work, list);
    }

    /// Draws the next part; true once the picture stands.
    bool draw_part(const DrawList& list, std::size_t most_disks) {
        const Targets& targets = *work->canvas->targets;
        glBindFramebuffer(GL_FRAMEBUFFER, targets.scene().name());
        switch (work->next) {
            case Part::disks:
                draw_disks(*work, list, most_disks);
                return false;
            case Part::colors:
                draw_colors(*work->canvas, list, work->ground);
                work->next = Part::faces;
                return false;
            case Part::faces:
                draw_faces(targets, list);
                work->next = Part::lines;
                return false;
            case Part::lines:
                lines.draw_scene(list, kAllBoxes, statistics);
                work->next = Part::words;
                return false;
            case Part::words:
                keep_words(list);
                finish(targets, list);
                painted = {&list, work->canvas};
                work.reset();
                return true;
        }
        return true;
    }

    void paint(const DrawList& list, int samples, Rgba ground) {
        begin_paint(list, samples, ground);
        while (!draw_part(list, std::numeric_limits<std::size_t>::max())) {
        }
    }

    /// For about so long; whether the picture stands.
    bool go_on(const DrawList& list, const PaintPace& pace) {
        resume(list.size);
        const double end = pace.clock() + pace.seconds;
        for (;;) {
            const double begun = pace.clock();
            const bool disks_drawn = work->next == Part::disks;
            if (draw_part(list, work->disks_at_once)) return true;
            // What was drawn is done when it is asked for, and its time is known then.
            glFinish();
            const double now = pace.clock();
            if (disks_drawn && now - begun < kPartSeconds / 2) work->disks_at_once *= 2;
            if (disks_drawn && now - begun > kPartSeconds)
                work->disks_at_once = std::max<std::size_t>(1, work->disks_at_once / 2);
            if (now >= end) return false;
        }
    }

    /// Disks and faces on fewer pixels; lines and words, which are narrow, on all.
    void paint_coarse(const DrawList& list, int divisor, Rgba ground) {
        const auto part = [&](int side) { return (side + divisor - 1) / divisor; };
        DrawList small;
        static_cast<PictureFrame&>(small) = static_cast<const PictureFrame&>(list);
        static_cast<DrawnWorld&>(small) = static_cast<const DrawnWorld&>(list);
        small.palette = list.palette;
        small.size = small.projection.size = {part(list.size.width), part(list.size.height)};
        begin(small.size);
        low.prepare(small.size, 1);
        boxes.keep(small, statistics);
        Work on{&small, &low, ground};
        begin_disks(on, small);
        if (on.next == Part::disks) draw_disks(on, small, std::numeric_limits<std::size_t>::max());
        draw_colors(low, small, ground);
        glBindFramebuffer(GL_FRAMEBUFFER, low.targets->scene().name());
        draw_faces(*low.targets, small);

        resume(list.size);
        coarse.prepare(list.size, 1);
        coarse.surfaces.reset();
        coarse.targets->enlarge(*low.targets);
        glBindFramebuffer(GL_FRAMEBUFFER, coarse.targets->scene().name());
        lines.draw_scene(list, kMostBoxesCoarse, statistics);
        keep_words(list);
        finish(*coarse.targets, list);
        painted = {&list, &coarse};
    }

    /// Whether the targets have the scene of a list by itself, without what lies over it.
    bool has_scene(const DrawList& list, int samples) const {
        return painted.list == &list && samples > 1 && painted.canvas->targets->samples() == samples;
    }

    bool has_disks(const DrawList& list, int samples) {
        work.reset();
        const Canvas& canvas = samples > 1 ? fine : coarse;
        return canvas.targets && canvas.targets->size() == list.size && canvas.targets->samples() == samples &&
               canvas.surfaces == surfaces_of(list, samples);
    }

    void keep_words(const DrawList& list) {
        overlay.keep(list, statistics);
        lines.keep_overlay(list, statistics);
    }

    /// The picture out of the scene in the targets, its highlights and its words.
    void finish(const Targets& targets, const DrawList& list) {
        targets.resolve();
        glBindFramebuffer(GL_FRAMEBUFFER, targets.result().name());
        lines.draw_highlights(list, statistics);
        overlay.draw_panels(list.size, statistics);
        lines.draw_overlay(list.size, statistics);
        overlay.draw_texts(list.size, statistics);
        context->check("drawing");
        note_drawn();
    }

    /// What was painted last.
    Image read_back(const DrawList& list) {
        Image image(list.size.width, list.size.height);
        glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
        context->check("reading the picture");
        flip_rows(image.rgba, image.width, image.height, 4);
        painted = {};
        return image;
    }

    void check_samples(int samples) const {
        GLint most = 1;
        GLint most_read = 1;  // one by one
        glGetIntegerv(GL_MAX_SAMPLES, &most);
        glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &most_read);
        most = std::min(most, most_read);
        if (samples <= std::max(most, 1)) return;
        throw MachineError("this OpenGL (" + std::string(context->name()) + ") draws at most " + std::to_string(most) +
                           " samples a pixel, not " + std::to_string(samples));
    }

    std::unique_ptr<GlContext> context;
    std::string device;
    std::string version;
    bool software;
    DrawStatistics statistics;
    /// What stands where: the list by its address alone; null after a picture was read back.
    struct Painted {
        const DrawList* list = nullptr;
        Canvas* canvas = nullptr;
    };
    Painted painted;
    std::optional<Work> work;
    DiskPass::Surfaces surfaces;  ///< of what is being drawn
    BoxBuffer boxes;
    DiskPass disks;
    FacePass faces;
    LinePass lines;
    OverlayPass overlay;
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

std::string_view Renderer::backend() const { return state_->context->name(); }

const std::string& Renderer::device() const { return state_->device; }

const std::string& Renderer::version() const { return state_->version; }

const DrawStatistics& Renderer::statistics() const { return state_->statistics; }

GlContext& Renderer::context() { return *state_->context; }

bool Renderer::is_software() const { return state_->software; }

const std::vector<std::string>& Renderer::warnings() const { return state_->context->warnings(); }

void Renderer::check_samples(int samples) {
    state_->context->make_current();
    state_->check_samples(samples);
}

const Texture& Renderer::paint(const DrawList& list, int samples) {
    state_->paint(list, samples, opaque_ground_of(list));
    return state_->painted.canvas->targets->picture();
}

const Texture& Renderer::paint_coarse(const DrawList& list, int divisor) {
    if (divisor == 1) return paint(list, 1);
    state_->paint_coarse(list, divisor, opaque_ground_of(list));
    return state_->painted.canvas->targets->picture();
}

void Renderer::begin_paint(const DrawList& list, int samples) {
    state_->begin_paint(list, samples, opaque_ground_of(list));
}

bool Renderer::is_painting(const DrawList& list) const { return state_->work && state_->work->list == &list; }

const Texture* Renderer::paint_more(const DrawList& list, const PaintPace& pace) {
    return state_->go_on(list, pace) ? &state_->painted.canvas->targets->picture() : nullptr;
}

void Renderer::wait() const { glFinish(); }

bool Renderer::has_scene(const DrawList& list, int samples) const { return state_->has_scene(list, samples); }

bool Renderer::has_disks(const DrawList& list, int samples) { return state_->has_disks(list, samples); }

const Texture& Renderer::paint_highlights(const DrawList& list, int samples) {
    if (!state_->has_scene(list, samples)) return paint(list, samples);
    const State::Painted painted = state_->painted;
    state_->begin(list.size);
    state_->finish(*painted.canvas->targets, list);
    state_->painted = painted;
    return painted.canvas->targets->picture();
}

Image Renderer::draw(const DrawList& list, int samples) {
    return on_its_background(list, [&](Rgba ground) {
        state_->paint(list, samples, ground);
        return state_->read_back(list);
    });
}

Image Renderer::draw_coarse(const DrawList& list, int divisor) {
    if (divisor == 1) return draw(list, 1);
    return on_its_background(list, [&](Rgba ground) {
        state_->paint_coarse(list, divisor, ground);
        return state_->read_back(list);
    });
}

IdImage Renderer::draw_ids(const DrawList& list) {
    State& s = *state_;
    s.begin(list.size);
    const IdTarget target(list.size);
    const std::array<GLuint, 4> nothing{0, 0, 0, 0};
    const auto write_output = [](GLsizei output) {
        std::array<GLenum, 3> outputs{GL_NONE, GL_NONE, GL_NONE};
        outputs[static_cast<std::size_t>(output)] = GL_COLOR_ATTACHMENT0;
        glDrawBuffers(output + 1, outputs.data());
    };
    write_output(0);
    glClearBufferuiv(GL_COLOR, 0, nothing.data());
    const GLfloat farthest = 1;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    write_output(1);
    s.disks.draw(list, Detail::fine, s.statistics);
    write_output(2);
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

}  // namespace mobbscope
