#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "experiments/study/config/config.h"

class Device;

/// Nothing is drawn on it, and nothing behind it; with all layers.
HostGBuffer empty_gbuffer(glm::uvec2 extent);

/// Renders one frame of a few pixels with each point of a study, so that a mistake in a shader or in a pass is an Error
/// before a reference is rendered, not after.
void rehearse(Device& device, const std::vector<PointConfig>& techniques);
