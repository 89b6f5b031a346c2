#include <app/window/texture_painter.h>

#include <algorithm>
#include <utility>

namespace mobbscope::app {

Painter::Shown TexturePainter::picture(std::size_t place, Changed changed, Interaction interaction, double now) {
    while (pictures_.size() <= place) pictures_.emplace_back();
    Picture& asked = pictures_[place];
    asked.changed = std::max(asked.changed, changed);
    asked.interaction = interaction;
    if (changed != Changed::nothing) asked.changed_at = now;
    return {texture_id(asked.copy.texture()), asked.is_fine ? 0 : now - asked.changed_at};
}

ImTextureID TexturePainter::image(std::size_t slot, const std::shared_ptr<const Image>& image, bool smooth) {
    Held& held = images_[slot];
    held.is_asked_for = true;
    if (!held.texture) held.texture = std::make_unique<ImageTexture>();
    return held.texture->take(image, smooth) ? texture_id(held.texture->texture()) : ImTextureID{};
}

void TexturePainter::drop_images() {
    std::erase_if(images_, [](const auto& held) { return !held.second.is_asked_for; });
    for (auto& [slot, held] : images_) held.is_asked_for = false;
}

void TexturePainter::paint_changes(std::size_t place, const DrawList& list) {
    if (place >= pictures_.size()) return;
    Picture& asked = pictures_[place];
    const Changed changed = std::exchange(asked.changed, Changed::nothing);
    if (changed == Changed::nothing) return;
    const bool all = changed == Changed::all;
    const bool whole = asked.interaction == Interaction::unattended || !renderer_.context().policy().coarse_first;
    if (whole && all) {
        take(asked, renderer_.paint(list, kPictureSamples), list);
    } else if (whole || (!all && asked.is_fine && renderer_.has_scene(list, kPictureSamples))) {
        take(asked, renderer_.paint_highlights(list, kPictureSamples), list);
    } else {
        asked.needs =
            renderer_.has_disks(list, kPictureSamples) ? AdaptiveQuality::Needs::rest : AdaptiveQuality::Needs::all;
        if (!asked.quality.coarse_first(asked.needs)) {
            if (paint_fine(asked, list, 1.5 * AdaptiveQuality::kAtOnce)) return;
            asked.quality.gave_up_fine(asked.needs, asked.seconds);
        }
        paint_coarse(asked, list);
    }
}

double TexturePainter::fine_due_in(std::size_t place, double now) const {
    if (place >= pictures_.size()) return kNever;
    const Picture& asked = pictures_[place];
    // What has changed is painted when the frame is drawn, and may be coarse then.
    const bool stands = asked.is_fine && asked.changed != Changed::all;
    if (stands || asked.interaction != Interaction::idle) return kNever;
    return std::max(asked.changed_at + AdaptiveQuality::kRest - now, 0.0);
}

void TexturePainter::paint_on(std::size_t place, const DrawList& list) {
    paint_fine(pictures_[place], list, AdaptiveQuality::kSlice);
}

void TexturePainter::take(Picture& asked, const Texture& fine, const DrawList& list) {
    asked.copy.take(fine, list.size);
    asked.is_fine = true;
    ++painted_.fine;
}

/// Begins the fine picture or goes on with it, for so long; whether it stands.
bool TexturePainter::paint_fine(Picture& asked, const DrawList& list, double seconds) {
    const double begun = clock_();
    if (!renderer_.is_painting(list)) {
        renderer_.begin_paint(list, kPictureSamples);
        asked.seconds = 0;
    }
    const Texture* fine = renderer_.paint_more(list, {clock_, seconds});
    asked.seconds += clock_() - begun;
    if (!fine) return false;
    take(asked, *fine, list);
    asked.quality.painted_fine(asked.needs, asked.seconds);
    return true;
}

void TexturePainter::paint_coarse(Picture& asked, const DrawList& list) {
    const double begun = clock_();
    asked.copy.take(renderer_.paint_coarse(list, asked.quality.divisor()), list.size);
    renderer_.wait();
    asked.quality.painted_coarse(clock_() - begun);
    asked.is_fine = false;
    ++painted_.coarse;
}

}  // namespace mobbscope::app
