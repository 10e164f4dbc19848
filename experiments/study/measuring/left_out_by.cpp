#include "experiments/study/measuring/left_out_by.h"

#include "core/gbuffer/rasterizer.h"
#include "experiments/study/config/points/technique_of.h"
#include "groundtruth/paths/path_tracer.h"

std::vector<LeftOutBy> left_out_of(const Shot& shot, const std::vector<PointConfig>& techniques) {
    std::vector<LeftOutBy> all;
    if (shot.config.gbuffer.empty()) {
        const ShotFrame now = shot_frame(shot, shot.config.frames.back());
        const PathTracer tracer(shot.scene, now.scene, now.camera, shot.config.extent,
                                {.learns_lights = false});  // which would trace paths, and changes nothing here
        for (const LeftOut& part : tracer.left_out()) all.push_back({"path tracer", part});
        for (const LeftOut& part : left_out_of_rasterizer(shot.facts)) all.push_back({"rasteriser", part});
    }
    for (const PointConfig& v : techniques) {
        const std::string who = point_text({v.technique, v.point});
        for (const LeftOut& part : technique_of(v)->leave_out(shot.facts)) all.push_back({who, part});
    }
    return all;
}
