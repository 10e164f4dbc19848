#pragma once
#include "core/gbuffer/composite.h"
#include "tests/variants/amd_scenes.h"
#include "tests/variants/technique_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

/// Frames of a camera that moves at a constant speed, and what DiligentFX's technique makes of the last of them.
struct DiligentSequence : TechniqueTest {
    using SceneOfFrame = std::function<SyntheticScene(unsigned frame)>;

    FrameView view{.extent = {96, 72}};
    glm::vec3 speed{0.1f, 0.02f, -0.05f};  ///< of the camera (m per frame)
    float wall_speed = 0;                  ///< of whatever is no metal, to the right (m per frame)
    std::vector<PassTime> times;           ///< of the last frame rendered

    /// Rolled a little, so that rows of pixels do not meet rows of what they reflect.
    CameraPose pose(unsigned frame) const;

    /// With motion, and the depths of the frame before.
    std::vector<HostGBuffer> frames(unsigned count, const SceneOfFrame& scene) const;

    /// Colour, and in alpha the confidence.
    HostImage render(Technique& technique, const std::vector<HostGBuffer>& frames);
    HostImage render(const std::vector<HostGBuffer>& frames, const nlohmann::json& parameters,
                     const std::string& preset) {
        return render(*make_technique("diligent_ssr", parameters, preset), frames);
    }

    /// The same composited before `fallback` everywhere; the specular light over that of a white furnace, RGB; 1 where
    /// nothing reflects.
    HostImage composited_incident(Technique& technique, std::vector<HostGBuffer> frames, float fallback);
};
