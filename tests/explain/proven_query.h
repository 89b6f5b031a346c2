/// Scenes of one query with the proof of its answer: random ones and ones of real clips.
#pragma once

#include <explain/certificate.h>
#include <import/import.h>
#include <support/folders.h>

#include "mobb/random_motion.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
inline namespace testing {

struct ProvenQuery {
    FittedScene fitted;
    RecordedQuery recorded;
    Certificate proof;

    ProvenQuery(Scene scene, const mobb::FitOptions& fit)
        : fitted(std::move(scene), fit),
          recorded(record(fitted, fitted.queries()[0])),
          proof(certify(a(), b(), recorded)) {}

    mobb::PlacedTree a() const { return fitted.placed(fitted.queries()[0].a); }
    mobb::PlacedTree b() const { return fitted.placed(fitted.queries()[0].b); }
    /// Why a certificate does not prove the answer.
    std::string refused(const Certificate& certificate) const {
        return why_not_proven(a().placed_clip(), b().placed_clip(), certificate);
    }
    /// Whether the two collide when B stands elsewhere and starts at another time.
    bool collides_shifted(glm::dvec2 shift, double later) const {
        mobb::Placement place = b().placed_clip().placement();
        place.translate += shift;
        place.start += later;
        return collides(a().placed_clip(), mobb::PlacedClip(b().tree().clip(), place));
    }
    /// Whether the two collide when both have grown.
    bool collides_grown(double growth) const {
        const auto grown = [&](const mobb::Clip& clip) {
            std::vector<mobb::Disk> disks(clip.samples().begin(), clip.samples().end());
            for (mobb::Disk& disk : disks) disk.r += growth;
            return mobb::Clip(clip.dt(), std::move(disks), clip.motion());
        };
        const mobb::Clip one = grown(a().tree().clip()), two = grown(b().tree().clip());
        return collides(mobb::PlacedClip(one, a().placed_clip().placement()),
                        mobb::PlacedClip(two, b().placed_clip().placement()));
    }

  private:
    static bool collides(const mobb::PlacedClip& a, const mobb::PlacedClip& b) {
        return mobb::direct_search(a, b).has_value();
    }
};

inline Scene two_agents(mobb::ClipPtr a, mobb::ClipPtr b, const mobb::Placement& place_a,
                        const mobb::Placement& place_b) {
    Scene scene;
    scene.clips = {{"a", {}, {}, std::move(a)}, {"b", {}, {}, std::move(b)}};
    scene.agents = {{"A", 0, place_a, {}}, {"B", 1, place_b, {}}};
    return scene;
}

/// Held and linear, touching, far away, of one sample and of many.
inline ProvenQuery random_proven_query(mobb::test::Random& random) {
    mobb::ClipPtr a = mobb::test::random_motion(random, mobb::test::random_clip(random, 200));
    mobb::ClipPtr b = mobb::test::random_motion(random, mobb::test::random_partner(random, *a, 200));
    mobb::Placement place_a, place_b;
    mobb::test::random_placements(random, *a, *b, place_a, place_b);
    return {two_agents(std::move(a), std::move(b), place_a, place_b), mobb::test::random_any_fit(random)};
}

/// Clips of the shared data set as their files give them; none where it is not.
inline const std::vector<mobb::ClipPtr>& real_clips() {
    static const std::vector<mobb::ClipPtr> clips = [] {
        std::vector<mobb::ClipPtr> out;
        Importer importer;
        for (const char* folder : {"bvh/short", "bvh/long", "gltf", "trajectories"}) {
            const auto path = kSharedData / folder;
            if (!std::filesystem::exists(path)) continue;
            std::vector<std::filesystem::path> files;
            for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
            std::sort(files.begin(), files.end());
            for (const auto& file : files) {
                ImportOptions options;
                options.radius = 0.3;
                try {
                    const std::vector<ImportedClip> imported = importer.clips(file, options);
                    // A crowd's file has hundreds: a few stand for all.
                    const std::size_t step = imported.size() / 8 + 1;
                    for (std::size_t i = 0; i < imported.size(); i += step) out.push_back(imported[i].clip);
                } catch (const std::exception&) {
                    // Some files of the set hold no motion.
                }
            }
        }
        return out;
    }();
    return clips;
}

/// Two real clips as people pass each other: near, at any heading, while both are there. Held or linear, of any tree.
inline ProvenQuery random_real_query(mobb::test::Random& random) {
    const std::vector<mobb::ClipPtr>& clips = real_clips();
    const auto any = [&] {
        return clips[static_cast<std::size_t>(random.integer(0, static_cast<int>(clips.size()) - 1))];
    };
    const mobb::ClipPtr a = mobb::test::random_motion(random, any()), b = mobb::test::random_motion(random, any());
    const auto middle = [&](const mobb::Clip& clip) {
        const mobb::Disk& disk = clip.samples()[static_cast<std::size_t>(random.integer(0, clip.count() - 1))];
        return glm::dvec2(disk.x, disk.y);
    };
    mobb::Placement place_a, place_b;
    place_a.rotate_deg = mobb::test::random_angle(random);
    place_b.rotate_deg = mobb::test::random_angle(random);
    place_a.translate = -mobb::Rotation::from_degrees(place_a.rotate_deg)(middle(*a));
    place_b.translate = glm::dvec2(random.real(-3, 3), random.real(-3, 3)) -
                        mobb::Rotation::from_degrees(place_b.rotate_deg)(middle(*b));
    place_b.start = random.real(-b->duration(), a->duration());
    mobb::FitOptions fit = mobb::test::random_any_fit(random);
    return {two_agents(a, b, place_a, place_b), fit};
}

/// How many queries the suite proves; MOBBSCOPE_CERTIFICATES gives longer or shorter runs.
inline int certificate_budget() {
    const char* text = std::getenv("MOBBSCOPE_CERTIFICATES");
    return text ? std::atoi(text) : 300;
}

}  // namespace testing
}  // namespace mobbscope
