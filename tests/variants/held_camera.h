#pragma once
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

/// Frames of a technique before a camera that is held.
struct HeldCamera : TechniqueTest {
    struct Frame {
        HostImage radiance, confidence;
    };

    /// Rolled a little, so that rows of pixels do not meet rows of what they reflect.
    CameraPose pose{.world_from_view = glm::rotate(glm::mat4(1), 0.07f, glm::vec3(0.3f, 0, 1)),
                    .vertical_fov = 1.2f,
                    .near = 0.1f,
                    .far = 100.0f};
    FrameView view{.extent = {160, 120}};
    std::vector<PassTime> times;  ///< of the last frame
    Reflections reflections;      ///< the last, whose pass_list is gone

    /// The last of `count` frames. `environment`: where rays meet nothing.
    Frame render(Technique& technique, const SyntheticScene& scene, unsigned count = 1, float environment = 0) {
        PassList pass_list(device(), view.extent);
        for (view.frame = 0; view.frame < count; ++view.frame) {
            const CameraData camera = camera_data(pose, view.frame > 0 ? &pose : nullptr, view);
            const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
            pass_list.upload(gbuffer.fallback, HostImage(view.extent, 4, environment));
            pass_list.begin_frame(camera, technique.params, gbuffer.images());
            reflections = technique.render(pass_list, gbuffer);
            times = pass_list.times();
        }
        return {pass_list.download(reflections.radiance), download_confidence(pass_list, reflections)};
    }
};
