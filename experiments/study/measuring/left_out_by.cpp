#include "experiments/study/measuring/left_out_by.h"

#include "core/gbuffer/rasterizer.h"
#include "experiments/study/config/points/technique_of.h"
#include "groundtruth/paths/path_tracer.h"
#include "variants/common/condition.h"

LeftOutFinder::LeftOutFinder(const std::vector<PointConfig>& techniques) {
    for (const PointConfig& v : techniques)
        techniques_.emplace_back(point_text({v.technique, v.point}), technique_of(v));
}

const std::vector<LeftOut>& LeftOutFinder::of_path_tracer(const Shot& shot) {
    const unsigned frame = shot.config.frames.back();
    const auto [entry, is_new] = of_path_tracer_.try_emplace({shot.scene.content_hash, frame});
    if (is_new) {
        const ShotFrame now = shot_frame(shot, frame);
        const PathTracer tracer(shot.scene, now.scene, now.camera, shot.config.extent,
                                {.learns_lights = false});  // which would trace paths, and changes nothing here
        entry->second = tracer.left_out();
    }
    return entry->second;
}

const std::vector<LeftOutBy>& LeftOutFinder::of_techniques(const SceneFacts& facts) {
    const auto [entry, is_new] = of_techniques_.try_emplace(facts_by_name(facts).dump());
    if (is_new)
        for (const auto& [who, technique] : techniques_)
            for (const LeftOut& part : technique->leave_out(facts)) entry->second.push_back({who, part});
    return entry->second;
}

std::vector<LeftOutBy> LeftOutFinder::of(const Shot& shot) {
    std::vector<LeftOutBy> all;
    if (shot.config.gbuffer.empty()) {
        for (const LeftOut& part : of_path_tracer(shot)) all.push_back({"path tracer", part});
        for (const LeftOut& part : left_out_of_rasterizer(shot.facts)) all.push_back({"rasteriser", part});
    }
    const std::vector<LeftOutBy>& rest = of_techniques(shot.facts);
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

std::vector<LeftOutBy> left_out_of(const Shot& shot, const std::vector<PointConfig>& techniques) {
    return LeftOutFinder(techniques).of(shot);
}
