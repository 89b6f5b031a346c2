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
        glBindTexture(GL_TEXTURE_2D, atlas_.name());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width, atlas.height, 0, GL_RED, GL_UNSIGNED_BYTE,
                     atlas.coverage.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
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
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    const VertexLayout item(sizeof(Instance), 1);
    const std::size_t begin = first * sizeof(Instance);
    item.floats(0, 4, begin + offsetof(Instance, rect));
    item.floats(1, 4, begin + offsetof(Instance, fill));
    item.floats(2, 4, begin + offsetof(Instance, border));
    item.floats(3, 2, begin + offsetof(Instance, corner));
    item.floats(4, 2, begin + offsetof(Instance, texel));
    glDisable(GL_DEPTH_TEST);
    blend_over();
    program_.use();
    glUniform2f(program_.uniform("viewport"), static_cast<float>(size.width), static_cast<float>(size.height));
    glUniform1i(program_.uniform("atlas"), 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, atlas_.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(end - first));
    statistics.triangles += 2 * (end - first);
    ++statistics.draw_calls;
}

}  // namespace mobbscope
