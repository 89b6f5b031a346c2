#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <base/work_queue.h>
#include <cli/command_line.h>
#include <cli/program.h>
#include <cli/render/render_job.h>
#include <picture_tests/picture_maker.h>
#include <picture_tests/test_case.h>
#include <picture_tests/window_picture.h>
#include <render/drawlist/draw_list_json.h>
#include <render/gl/renderer.h>
#include <render/image/picture_names.h>
#include <render/image/png.h>
#include <render/layout/follow.h>
#include <render/pictures/build_draw_list.h>
#include <render/vector/vector_picture.h>
#include <scene/step_link.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace mobbscope::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kOften{200};

/// For who waits: a script hears of films and of a single large picture only, as its pictures show how far it is.
class Patience {
  public:
    Patience(std::size_t all, bool films, bool often) : all_(all), often_(often) {
        const bool watched = ::isatty(STDERR_FILENO) == 1;
        pause_ = often ? kOften : watched ? std::chrono::seconds(4) : std::chrono::seconds(8);
        silent_ = !often && !watched && !films;
    }

    /// Of many disks a single picture takes long; said once.
    void begins(const DrawList& list) {
        constexpr std::size_t kMany = 50'000;
        if (often_ || said_many_ || list.disks.size() <= kMany) return;
        said_many_ = true;
        say("drawing " + std::to_string(list.disks.size()) + " disks: this may take a while");
    }

    void one_more() {
        ++done_;
        if (done_ == all_ || silent_ || Clock::now() - said_ < pause_) return;
        said_ = Clock::now();
        say("drew " + std::to_string(done_) + " of " + std::to_string(all_) + " pictures");
    }

    /// All its pictures are drawn.
    void finishes(const std::filesystem::path& film) const {
        if (often_ || (!silent_ && Clock::now() - begun_ > pause_)) say("finishing " + film.string());
    }

  private:
    std::size_t all_;
    bool often_;
    std::size_t done_ = 0;
    bool said_many_ = false;
    std::chrono::milliseconds pause_;
    bool silent_;
    Clock::time_point begun_ = Clock::now();
    Clock::time_point said_ = begun_;
};

bool needs_renderer(const RenderJob& job) {
    return !job.arguments.ui && !(job.arguments.outputs.image.empty() && job.arguments.outputs.ids.empty());
}

/// Highlights in a picture's list what --select says. Throws as add_selection does.
void highlight_selected(const RenderJob& job, const ViewState& view, DrawList& list) {
    const PictureOptions& options = job.arguments.picture;
    const float scale = metrics_of(options.size, options.scale).scale;
    add_selection(list, *job.paths->shown_in(view).fitted(), view, *job.arguments.select, scale);
}

/// Throws InputError unless one of the pictures shows what --select says.
void check_selection(const RenderJob& job) {
    if (!job.arguments.select) return;
    std::string why_not;
    for (const RenderPicture& picture : job.pictures) {
        const PictureOptions& options = job.arguments.picture;
        DrawList list;
        static_cast<PictureFrame&>(list) = picture_frame(*job.paths, picture.view, options);
        try {
            return highlight_selected(job, picture.view, list);
        } catch (const std::invalid_argument& error) {
            if (why_not.empty()) why_not = error.what();
        }
    }
    throw InputError(job.arguments.file, "--select: " + why_not);
}

/// What is made of one view, once it is drawn.
struct Drawn {
    RenderOutputs outputs;
    std::optional<Image> png{};  ///< the picture, not yet packed
    std::string image{}, ids{}, draw_list{};

    void write() {
        if (png) image = png_bytes(*png);
        std::vector<FileBytes> files;
        if (!outputs.image.empty()) files.push_back({outputs.image, image});
        if (!outputs.ids.empty()) files.push_back({outputs.ids, ids});
        if (!outputs.draw_list.empty()) files.push_back({outputs.draw_list, draw_list});
        write_files(files);
    }
};

/// `renderer`: null where nothing of it needs OpenGL; `film`: that the picture is of, null: none.
Drawn draw_scene(const RenderJob& job, RenderPicture& picture, Renderer* renderer, Film* film, Patience& patience) {
    const RenderOutputs& outputs = picture.outputs;
    if (!picture.list) picture.list = build_draw_list(*job.paths, picture.view, job.arguments.picture);
    DrawList list = *std::exchange(picture.list, {});
    patience.begins(list);
    if (job.arguments.select) {
        try {
            highlight_selected(job, picture.view, list);
        } catch (const std::invalid_argument&) {
            // Another picture of the sequence shows it.
        }
    }
    if (job.arguments.measure) {
        const PictureOptions& options = job.arguments.picture;
        add_measure(list, *job.arguments.measure, metrics_of(options.size, options.scale), picture.view.labels);
    }
    if (film) {
        const bool last = &picture == &job.pictures.back();
        film->add(renderer->draw(list, job.arguments.picture.samples), last ? 1 + job.pace.held : 1);
    }
    Drawn out{.outputs = outputs};
    if (is_vector_name(outputs.image)) {
        out.image = picture_bytes(outputs.image, list, job.arguments.picture.samples,
                                  [renderer]() -> Renderer& { return *renderer; });
    } else if (!outputs.image.empty()) {
        out.png = renderer->draw(list, job.arguments.picture.samples);
    }
    std::optional<IdImage> drawn_ids;
    if (!outputs.ids.empty()) {
        drawn_ids = renderer->draw_ids(list);
        out.ids = png_bytes(id_picture(list, *drawn_ids));
    }
    if (!outputs.draw_list.empty()) {
        std::ostringstream text;
        write_draw_list(text, list, drawn_ids ? &*drawn_ids : nullptr);
        out.draw_list = text.str();
    }
    return out;
}

/// What came of a film: "walk.mp4: 1.2 MB, 26.3 s: 789 pictures of 1280x720 at 30 a second".
std::string film_report(const RenderJob& job, std::size_t bytes) {
    return job.arguments.outputs.image.string() + ": " + bytes_text(bytes) + ", " +
           film_text(job.pictures.size(), job.pace, job.arguments.picture.size);
}

/// Says once if a choice that pictures show does not come out as the run says.
void warn_of_edited_run(const RenderJob& job) {
    std::vector<ViewState> views;
    for (const RenderPicture& picture : job.pictures) views.push_back(picture.view);
    const std::string text = edited_run_warning(*job.paths->fitted(), views);
    if (!text.empty()) warn(shown_name(job.arguments.file) + ": " + text);
}

void refuse_other_options(const Command& command) {
    for (const GivenOption& given : command.given()) {
        if (given.name == "FILE" || given.name == "--output" || given.name == "--backend") continue;
        throw InputError(given.name + ": a case says by itself how it is drawn; leave it out");
    }
}

}  // namespace

SceneStore::Loaded& SceneStore::loaded(const RenderArguments& arguments) {
    for (const auto& known : scenes_) {
        if (known->name == arguments.file && known->options == arguments.import_options) return *known;
    }
    const LinkedFile linked = linked_file(arguments.file);
    Scene scene = load(linked.file, arguments.import_options);
    if (linked.link) show_step(scene, *linked.link);
    scenes_.push_back(std::make_unique<Loaded>(Loaded{arguments.file, arguments.import_options, std::move(scene), {}}));
    return *scenes_.back();
}

std::shared_ptr<KeptPaths> SceneStore::paths(const RenderArguments& arguments) {
    Loaded& found = loaded(arguments);
    const mobb::FitOptions options = arguments.fit.over(found.scene.fit);
    for (const auto& known : found.paths) {
        if (known->fitted()->options() == options) return known;
    }
    found.paths.push_back(std::make_shared<KeptPaths>(std::make_shared<const FittedScene>(found.scene, options)));
    return found.paths.back();
}

void RenderPlan::add(RenderArguments arguments) {
    check_names(arguments.outputs);
    check_together(arguments);
    if (arguments.is_film()) arguments.picture.size = film_size(arguments.picture);
    if (is_case(arguments.file)) throw InputError(arguments.file, "a case is drawn alone, not in a batch");
    RenderJob job{std::move(arguments), nullptr, {}};
    job.paths = scenes_.paths(job.arguments);
    const FittedScene& fitted = *job.paths->fitted();
    const ViewState view = view_over(fitted, job.arguments.view);
    try {
        job.pictures = pictures_of(*job.paths, view, job.arguments);
        const SequenceArguments& sequence = job.arguments.sequence;
        job.pace = film_pace(played_of(view, sequence.turntable.has_value()), sequence.rate.value_or(0));
        check_and_frame(job);
        check_selection(job);
        warn_of_edited_run(job);
    } catch (const ViewMismatch& mismatch) {
        refuse_view(job.arguments, mismatch);
    } catch (const std::invalid_argument& error) {
        throw InputError(job.arguments.file, error.what());
    }
    jobs_.push_back(std::move(job));
}

void RenderPlan::check_and_frame(RenderJob& job) {
    const bool near = is_near_followed(job.pictures.front().view, job.arguments);
    std::optional<Camera> camera;  // of all pictures, so that none jumps
    const Progress progress =
        tell("planned", "pictures", progress_ ? std::optional<std::chrono::milliseconds>(kOften) : std::nullopt);
    std::size_t planned = 0;
    for (RenderPicture& picture : job.pictures) {
        progress(planned++, job.pictures.size());
        DrawList list = build_draw_list(*job.paths, picture.view, job.arguments.picture);
        note_glyphs(list);
        if (near) {
            const Camera seen = framing_followed(*job.paths->fitted(), picture.view, list);
            if (!camera) camera = seen;
            camera->distance = std::max(camera->distance, seen.distance);
        } else if (!job.arguments.ui) {
            keep(picture, std::move(list));
        }
    }
    if (!camera) return;
    for (RenderPicture& picture : job.pictures) {
        const double yaw = job.arguments.sequence.turntable ? picture.view.camera.yaw_deg : camera->yaw_deg;
        picture.view.camera = *camera;
        picture.view.camera.yaw_deg = yaw;
    }
}

/// Unless there are many already: a long batch would fill the memory.
void RenderPlan::keep(RenderPicture& picture, DrawList list) {
    constexpr std::size_t kMostKept = 1'000'000;
    if (kept_ > kMostKept) return;
    kept_ += list.disks.size() + list.boxes.size() + list.lines.size();
    picture.list = std::move(list);
}

/// Names may hold characters that the fonts of pictures lack.
void RenderPlan::note_glyphs(const DrawList& list) {
    for (const TextRun& run : list.texts) {
        for (const char32_t code : code_points(run.text)) {
            if (!Font::of(run.face).has(code)) missing_glyphs_.insert(code);
        }
    }
}

void RenderPlan::check_outputs(std::size_t job_index, OutputCheck& outputs) {
    RenderJob& job = jobs_.at(job_index);
    for (const RenderPicture& picture : job.pictures) outputs.writes(picture.outputs);
    if (!job.arguments.is_film()) return;
    const std::filesystem::path& film = job.arguments.outputs.image;
    RenderOutputs only_film;
    only_film.image = film;
    outputs.writes(only_film);
    const auto known = film_makers_.find(lower_extension(film));
    job.film_maker = known != film_makers_.end() ? known->second : find_film_maker(film);
    film_makers_.insert({lower_extension(film), *job.film_maker});
}

void RenderPlan::draw(Backend backend) {
    if (!missing_glyphs_.empty()) {
        warn("the fonts of pictures lack " + counted(missing_glyphs_.size(), "character", "characters") +
             " of this scene's names; boxes stand for them");
    }
    if (jobs_.size() == 1 && jobs_[0].pictures.size() == 1 && !jobs_[0].arguments.ui) compile_quickly();
    std::optional<Renderer> renderer;
    std::size_t all = 0;
    bool films = false;
    for (const RenderJob& job : jobs_) {
        all += job.pictures.size();
        films = films || job.film_maker;
        if (!needs_renderer(job)) continue;
        if (!renderer) renderer.emplace(backend);
        renderer->check_samples(job.arguments.picture.samples);
    }
    Patience patience(all, films, progress_);
    constexpr std::size_t kMostUnwritten = 2;
    WorkQueue writing(kMostUnwritten);  // to pack a PNG takes about as long as to draw it
    for (RenderJob& job : jobs_) {
        // A renderer forks to be watched, and a child has no other threads: it is there before there are any.
        std::optional<Film> film;
        if (job.film_maker)
            film.emplace(*job.film_maker, job.arguments.outputs.image, job.arguments.picture.size, job.pace.rate);
        for (RenderPicture& picture : job.pictures) {
            if (job.arguments.ui) {
                // The window's picture changes the working folder, to which names are relative.
                writing.finish();
                write_png(picture.outputs.image,
                          picture_tests::window_picture(*job.paths->fitted(), picture.view, job.arguments.file, backend,
                                                        job.arguments.picture.size, job.arguments.ui_scale.value_or(1))
                              .picture);
            } else {
                const auto drawn = std::make_shared<Drawn>(
                    draw_scene(job, picture, renderer ? &*renderer : nullptr, film ? &*film : nullptr, patience));
                const auto write = [drawn] { drawn->write(); };
                if (picture.outputs.any()) renderer ? writing.add(write) : write();
            }
            patience.one_more();
        }
        if (!film) continue;
        patience.finishes(job.arguments.outputs.image);
        say(film_report(job, film->finish()));
    }
    writing.finish();
}

bool is_case(const std::filesystem::path& file) { return file.filename().string().ends_with(".case.json"); }

void render_case(const Command& command, const RenderArguments& arguments) {
    check_names(arguments.outputs);
    refuse_other_options(command);
    if (arguments.outputs.image.empty()) throw UsageError("--output is required");
    const picture_tests::Case drawn = picture_tests::read_case(arguments.file);
    if (drawn.terms.skip) throw InputError(arguments.file, "the case is skipped: " + *drawn.terms.skip);
    check_output(arguments.outputs.image);
    const std::filesystem::path golden = picture_tests::CaseFile{{}, arguments.file}.golden();
    std::error_code ignored;
    if (std::filesystem::exists(golden, ignored) && is_same_file(arguments.outputs.image, golden)) {
        throw InputError(arguments.outputs.image,
                         "is the golden of this case; mobbscope test --update takes it, or give another output");
    }
    if (lower_extension(arguments.outputs.image) != ".png")
        throw InputError(arguments.outputs.image, "the picture of a case is written as .png; rename the output");
    picture_tests::PictureMaker maker(arguments.backend.value_or(Backend::automatic));
    write_png(arguments.outputs.image, maker.make(drawn.shot).picture);
}

}  // namespace mobbscope::cli
