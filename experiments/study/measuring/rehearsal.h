#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "experiments/study/config/config.h"

class Device;

/// A G-buffer with all layers in which nothing is drawn.
HostGBuffer empty_gbuffer(glm::uvec2 extent);

/// Renders one frame of a few pixels with each point of a study. A mistake in a shader or pass is thus an Error before
/// a reference is rendered.
void rehearse(Device& device, const std::vector<PointConfig>& techniques);
