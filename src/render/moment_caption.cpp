#include <import/skeleton.h>
#include <render/annotations.h>
#include <render/moment_caption.h>
#include <render/query_sentence.h>

#include <cmath>
#include <cstdio>

namespace mobbscope {

namespace {

std::string at_time(double time) {
    char text[48];
    std::snprintf(text, sizeof text, " at %.2f s", time);
    return text;
}

std::string how_many_are_there(std::size_t bodies, std::size_t subjects) {
    if (bodies == subjects) return "";
    return std::to_string(bodies) + " of " + std::to_string(subjects) + " are on the floor then";
}

std::string reach(const Subject& subject, const Body& body) {
    const std::string radius = "radius " + with_unit(body.disk.r, "m");
    if (!sets_radius(body)) return radius;
    return radius + ": as far as " + subject.skeleton->joints[static_cast<std::size_t>(body.farthest->joint)].name +
           " reaches";
}

}  // namespace

Caption moment_caption(const Palette& palette, std::span<const Subject> subjects, const Moment& moment) {
    Caption out;
    const std::string then = at_time(moment.time);
    const auto subject = [&](int body) -> const Subject& {
        return subjects[static_cast<std::size_t>(moment.bodies[static_cast<std::size_t>(body)].subject)];
    };
    const auto both = [&](const BodyPair& pair) { return subject(pair.a).label + " and " + subject(pair.b).label; };
    const std::size_t count = moment.bodies.size();
    out.detail = how_many_are_there(count, subjects.size());
    const auto add_detail = [&](const std::string& text) { out.detail += (out.detail.empty() ? "" : ". ") + text; };
    if (count == 0) {
        out.headlines = {"Nobody is on the floor" + then};
        out.detail.clear();
    } else if (count == 1) {
        out.headlines = {subject(0).label + then};
        add_detail(reach(subject(0), moment.bodies.front()));
    } else if (moment.overlaps.size() > 1) {
        const std::string pairs = std::to_string(moment.overlaps.size()) + " pairs of " + std::to_string(count);
        out.headlines = {pairs + " agents overlap" + then, pairs + " overlap" + then};
        out.mark = palette.hit;
    } else if (!moment.overlaps.empty()) {
        const BodyPair& pair = moment.overlaps.front();
        out.headlines = {both(pair) + " overlap" + then + " by " + with_unit(-pair.clearance, "m"),
                         both(pair) + " overlap" + then};
        out.mark = palette.hit;
    } else {
        const std::string clearance = with_unit(moment.nearest->clearance, "m") + " of clearance";
        if (count == 2) {
            out.headlines = {both(*moment.nearest) + then + "; " + clearance, clearance + then};
        } else {
            const std::string all = std::to_string(count) + " agents" + then;
            out.headlines = {all + "; nobody overlaps", all};
            add_detail("Nearest: " + both(*moment.nearest) + ", " + clearance);
        }
        out.mark = palette.separated;
    }
    return out;
}

std::vector<LegendEntry> moment_legend(const Palette& palette, std::span<const Subject> subjects, const Moment& moment,
                                       bool paths, bool radius) {
    std::vector<LegendEntry> out;
    // A crowd's colours only keep neighbours apart.
    if (names_fit(subjects.size())) out = agent_entries(subjects);
    const auto line = [&](Rgba color, float width, const char* text) {
        LegendEntry entry;
        entry.color = color;
        entry.width = width;
        entry.text = text;
        out.push_back(entry);
    };
    if (!moment.overlaps.empty()) line(palette.hit, 3, "overlap at this moment");
    if (radius) line(palette.text, 1.4f, "radius, to the farthest joint");
    if (paths) {
        line(palette.quiet_text, 2.6f, "way so far");
        line(with_alpha(palette.quiet_text, 0.6f), 1.2f, "way ahead");
    }
    return out;
}

}  // namespace mobbscope
