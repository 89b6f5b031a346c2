#include <render/gl/gl_objects.h>
#include <render/gl/overlay_pass.h>

namespace mobbscope {

struct OverlayPass::Instance {
    Rect rect;
    Rgba fill;
    Rgba border;
    glm::vec2 corner;
    glm::vec2 texel;
};

OverlayPass::OverlayPass(GlContext& context) : program_(context, "overlay") {}

void OverlayPass::keep(const DrawnOverlay& overlay, DrawStatistics& statistics) {
    std::vector<Instance> instances;
    const auto add = [&](const std::vector<OverlayPanel>& panels) {
        for (const OverlayPanel& panel : panels) {
            instances.push_back(
                {panel.rect, panel.fill, panel.border, glm::vec2(panel.radius, panel.border_width), glm::vec2(-1)});
        }
    };
    add(overlay.panels);
    panels_ = instances.size();
    add(overlay.marks);
    if (!overlay.texts.empty()) {
        const GlyphAtlas atlas = make_atlas(overlay.texts, glyphs_);
        statistics.overlay_bytes += atlas.coverage.size();
        glActiveTexture(GL_TEXTURE0);
        fill_texture(atlas_, GL_R8, atlas.size, GL_RED, GL_UNSIGNED_BYTE, atlas.coverage.data());
        for (const PlacedGlyph& glyph : atlas.glyphs) {
            instances.push_back({glyph.rect, glyph.color, Rgba(0), glm::vec2(0), glyph.texel});
        }
    }
    all_ = instances.size();
    if (all_ > 0) statistics.overlay_bytes += upload(instances_, instances);
}

void OverlayPass::draw_panels(PictureSize size, DrawStatistics& statistics) { draw(0, panels_, size, statistics); }

void OverlayPass::draw_texts(PictureSize size, DrawStatistics& statistics) { draw(panels_, all_, size, statistics); }

void OverlayPass::draw(std::size_t first, std::size_t end, PictureSize size, DrawStatistics& statistics) {
    if (first == end) return;
    glBindVertexArray(array_.name());
    const VertexLayout<Instance> item(instances_, 1, {first});
    item.floats(0, 4, offsetof(Instance, rect));
    item.floats(1, 4, offsetof(Instance, fill));
    item.floats(2, 4, offsetof(Instance, border));
    item.floats(3, 2, offsetof(Instance, corner));
    item.floats(4, 2, offsetof(Instance, texel));
    glDisable(GL_DEPTH_TEST);
    blend_over();
    program_.use();
    program_.set("viewport", size);
    program_.set("atlas", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, atlas_.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(end - first));
    statistics.triangles += 2 * (end - first);
    ++statistics.draw_calls;
}

}  // namespace mobbscope
