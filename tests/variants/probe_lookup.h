#pragma once
#include "variants/common/screen_probe/screen_probe.h"

#include <cstring>

/// World space; from a point, which lies so far from the camera, in a unit direction.
struct ProbeRay {
    glm::vec3 from_camera, direction;
};

/// What shaders read of a probe along rays: radiance times a share of surfaces, that share.
inline std::vector<glm::vec4> look_up(PassList& pass_list, const ScreenProbe& probe,
                                      const std::vector<ProbeRay>& rays) {
    std::vector<glm::vec4> given, found(rays.size());
    for (const ProbeRay& ray : rays) {
        given.emplace_back(ray.from_camera, 0);
        given.emplace_back(ray.direction, 0);
    }
    const Buffer in = pass_list.buffer("Rays", given.size() * sizeof given[0]),
                 out = pass_list.buffer("Surfaces", found.size() * sizeof found[0]);
    pass_list.upload(in, std::as_bytes(std::span(given)));
    pass_list.compute("probe_rays.comp")
        .read_linear(probe.surfaces)
        .read(probe.nearness)
        .use(in)
        .use(out)
        .dispatch_groups({(rays.size() + 63) / 64, 1, 1});
    const std::vector<std::byte> bytes = pass_list.download(out);
    std::memcpy(found.data(), bytes.data(), bytes.size());
    return found;
}
