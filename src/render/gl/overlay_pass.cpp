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

OverlayPass::OverlayPass(GlContext& context) : program_(context, "overlay") {
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    const VertexLayout item(sizeof(Instance), 1);
    item.floats(0, 4, offsetof(Instance, rect));
    item.floats(1, 4, offsetof(Instance, fill));
    item.floats(2, 4, offsetof(Instance, border));
    item.floats(3, 2, offsetof(Instance, corner));
    item.floats(4, 2, offsetof(Instance, texel));
}

void OverlayPass::draw(const std::vector<Instance>& instances, PictureSize size, DrawStatistics& statistics) {
    if (instances.empty()) return;
    glBindVertexArray(array_.name());
    statistics.overlay_bytes += upload(instances_, instances);
    glDisable(GL_DEPTH_TEST);
    blend_over();
    program_.use();
    glUniform2f(program_.uniform("viewport"), static_cast<float>(size.width), static_cast<float>(size.height));
    glUniform1i(program_.uniform("atlas"), 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, atlas_.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances.size()));
    statistics.triangles += 2 * instances.size();
    ++statistics.draw_calls;
}

void OverlayPass::draw(const std::vector<OverlayPanel>& panels, PictureSize size, DrawStatistics& statistics) {
    std::vector<Instance> instances;
    instances.reserve(panels.size());
    for (const OverlayPanel& panel : panels) {
        instances.push_back(
            {panel.rect, panel.fill, panel.border, glm::vec2(panel.radius, panel.border_width), glm::vec2(-1)});
    }
    draw(instances, size, statistics);
}

void OverlayPass::draw_panels(const DrawList& list, DrawStatistics& statistics) {
    draw(list.panels, list.size, statistics);
}

void OverlayPass::draw_texts(const DrawList& list, DrawStatistics& statistics) {
    draw(list.marks, list.size, statistics);
    if (list.texts.empty()) return;
    const GlyphAtlas atlas = make_atlas(list.texts, glyphs_);
    statistics.overlay_bytes += atlas.coverage.size();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, atlas_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width, atlas.height, 0, GL_RED, GL_UNSIGNED_BYTE,
                 atlas.coverage.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    std::vector<Instance> instances;
    for (const PlacedGlyph& glyph : atlas.glyphs) {
        instances.push_back({glyph.rect, glyph.color, Rgba(0), glm::vec2(0), glyph.texel});
    }
    draw(instances, list.size, statistics);
}

}  // namespace mobbscope
