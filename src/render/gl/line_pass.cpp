#include <render/gl/gl_objects.h>
#include <render/gl/line_pass.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mobbscope {

struct LinePass::Instance {
    glm::vec3 from;
    glm::vec3 to;
    LineLook look;
};

namespace {

constexpr GLuint kColor = 4;

/// So many boxes beside the picture are drawn along rather than begin a draw call anew.
constexpr std::size_t kDrawnAlong = 16;

/// Pixels by which lines may reach beyond what they are drawn along.
constexpr float kReach = 8;

/// Whether any of a box may be in the picture.
bool may_be_seen(const BoxBuffer::Shape& box, const ViewProjection& projection) {
    const glm::mat4& clip = projection.clip_from_world;
    const glm::vec4 center = clip * glm::vec4(box.center, 1);
    glm::vec3 half(0);  // of its extent in x, y and w
    glm::vec4 extents[3];
    for (int i = 0; i < 3; ++i) {
        extents[i] = clip * glm::vec4(box.extents[i], 0);
        half += glm::abs(glm::vec3(extents[i].x, extents[i].y, extents[i].w));
    }
    if (center.w + half.z <= 0) return false;
    const glm::vec2 edge(1 + 2 * kReach / static_cast<float>(projection.size.width),
                         1 + 2 * kReach / static_cast<float>(projection.size.height));
    for (int axis = 0; axis < 2; ++axis) {
        for (const float side : {-1.f, 1.f}) {
            // w * edge + side * x >= 0 holds in the picture.
            float farthest = edge[axis] * center.w + side * center[axis];
            for (const glm::vec4& extent : extents) {
                farthest += std::abs(edge[axis] * extent.w + side * extent[axis]);
            }
            if (farthest < 0) return false;
        }
    }
    return true;
}

/// Of lines and of the edges of boxes.
template <class Element>
void describe_look(const VertexLayout<Element>& layout, std::size_t look) {
    layout.floats(kColor, 4, look + offsetof(LineLook, color));
    layout.floats(kColor + 1, 4, look + offsetof(LineLook, dash));
    layout.floats(kColor + 2, 3, look + offsetof(LineLook, shape));
}

}  // namespace

/// A share of their distance from the eye. Where something is drawn just before the eye, as a plane that it stands in,
/// depths farther off differ so little that lines would come through all that stands on the floor.
float most_line_bias(const ViewProjection& projection) {
    if (!projection.perspective) return std::numeric_limits<float>::max();
    constexpr float kMostShare = 4e-3f;
    const float n = projection.near_depth;
    const float f = projection.far_depth;
    return kMostShare * 2 * f * n / (f - n);
}

LinePass::LinePass(GlContext& context, const BoxBuffer& boxes) : boxes_(boxes), program_(context, "line") {}

void LinePass::begin(const glm::mat4& clip_from_world, PictureSize size) {
    program_.use();
    program_.set("clip_from_world", clip_from_world);
    program_.set("viewport", size);
    program_.set("hidden", 0);
    program_.set("depth_bias", 0.0f);
    blend_over();
    glDepthMask(GL_FALSE);
}

void LinePass::draw(const Batch& batch, const Buffer& lines, DrawStatistics& statistics) {
    program_.set("edges", batch.of_boxes);
    const std::size_t drawn = (batch.count + batch.range.step - 1) / batch.range.step;
    const GLsizei count = static_cast<GLsizei>(drawn);
    if (batch.of_boxes) {
        glBindVertexArray(box_array_.name());
        boxes_.describe_shapes(batch.range).integers(7, 2, offsetof(BoxBuffer::Shape, id));
        describe_look(boxes_.looks_from(batch.range), offsetof(BoxBuffer::Look, line));
        glDrawArraysInstanced(GL_TRIANGLES, 0, 72, count);
    } else {
        glBindVertexArray(line_array_.name());
        const VertexLayout<Instance> line(lines, 1, batch.range);
        line.floats(0, 3, offsetof(Instance, from));
        line.floats(1, 3, offsetof(Instance, to));
        describe_look(line, offsetof(Instance, look));
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
    }
    statistics.triangles += (batch.of_boxes ? 24 : 2) * drawn;
    ++statistics.draw_calls;
}

/// Lines and the edges of boxes, in drawing order.
std::vector<LinePass::Batch> LinePass::batches(const DrawList& list, const std::vector<const LineInstance*>& lines,
                                               std::size_t most_boxes) const {
    std::vector<Batch> out;
    const auto add = [&](bool of_boxes, std::size_t index) {
        const bool goes_on = !out.empty() && out.back().of_boxes == of_boxes &&
                             index <= out.back().range.first + out.back().count + kDrawnAlong;
        if (!goes_on) out.push_back({of_boxes, 0, {index}});
        out.back().count = index + 1 - out.back().range.first;
    };
    std::size_t line = 0;
    std::size_t seen = 0;
    for (std::size_t box = 0; box < boxes_.size(); ++box) {
        if (boxes_.looks()[box].line.color.a <= 0 || !may_be_seen(boxes_.shapes()[box], list.projection)) continue;
        ++seen;
        while (line < lines.size() && !(boxes_.orders()[box] < lines[line]->order)) add(false, line++);
        add(true, box);
    }
    while (line < lines.size()) add(false, line++);
    if (seen > most_boxes) {
        for (Batch& batch : out) {
            if (batch.of_boxes) batch.range.step = (seen + most_boxes - 1) / most_boxes;
        }
    }
    return out;
}

void LinePass::draw_scene(const DrawList& list, std::size_t most_boxes, DrawStatistics& statistics) {
    const std::vector<const LineInstance*> lines = in_order(list.lines);
    const std::vector<Batch> all = batches(list, lines, most_boxes);
    if (all.empty()) return;
    std::vector<Instance> instances;
    instances.reserve(lines.size());
    bool some_show_through = std::any_of(all.begin(), all.end(), [](const Batch& batch) { return batch.of_boxes; });
    for (const LineInstance* line : lines) {
        instances.push_back({line->from, line->to, {line->color, line->dash, {line->width, line->cap, line->hidden}}});
        some_show_through = some_show_through || line->hidden > 0;
    }
    statistics.overlay_bytes += upload(scene_lines_, instances);
    begin(list.projection.clip_from_world, list.size);
    program_.set("depth_bias", kLineDepthBias);
    program_.set("most_bias", most_line_bias(list.projection));
    program_.set("slab", slab_of(list));
    program_.set("cut", list.slab && list.slab->cuts_boxes);
    glEnable(GL_DEPTH_TEST);
    const auto draw_all = [&] {
        for (const Batch& batch : all) draw(batch, scene_lines_, statistics);
    };
    if (some_show_through) {
        glDepthFunc(GL_GREATER);
        program_.set("hidden", 1);
        draw_all();
        program_.set("hidden", 0);
    }
    glDepthFunc(GL_LEQUAL);
    draw_all();
}

void LinePass::draw_highlights(const DrawList& list, DrawStatistics& statistics) {
    if (list.highlights.empty()) return;
    std::vector<Instance> instances;
    instances.reserve(list.highlights.size());
    for (const HighlightLine& line : list.highlights) {
        instances.push_back({line.from, line.to, {line.color, line.dash, {line.width, 0, 0}}});
    }
    statistics.overlay_bytes += upload(highlights_, instances);
    // The depths of the picture are the world's, and what is pointed out may lie before or beyond it: only what the eye
    // is too near to is cut.
    glm::mat4 flat = list.projection.clip_from_world;
    for (int column = 0; column < 4; ++column) flat[column][2] = 0;
    if (list.projection.perspective) flat[3][2] = -list.projection.near_depth;
    begin(flat, list.size);
    glDisable(GL_DEPTH_TEST);
    draw({false, instances.size()}, highlights_, statistics);
}

void LinePass::keep_overlay(const DrawnOverlay& overlay, DrawStatistics& statistics) {
    std::vector<Instance> instances;
    for (const OverlayLine& line : overlay.overlay_lines) {
        instances.push_back(
            {glm::vec3(line.from, 0), glm::vec3(line.to, 0), {line.color, line.dash, {line.width, 0, 0}}});
    }
    overlay_count_ = instances.size();
    if (overlay_count_ > 0) statistics.overlay_bytes += upload(overlay_lines_, instances);
}

void LinePass::draw_overlay(PictureSize size, DrawStatistics& statistics) {
    if (overlay_count_ == 0) return;
    glm::mat4 pixels(1);
    pixels[0][0] = 2 / static_cast<float>(size.width);
    pixels[1][1] = -2 / static_cast<float>(size.height);
    pixels[3] = {-1, 1, 0, 1};
    begin(pixels, size);
    glDisable(GL_DEPTH_TEST);
    draw({false, overlay_count_}, overlay_lines_, statistics);
}

}  // namespace mobbscope
