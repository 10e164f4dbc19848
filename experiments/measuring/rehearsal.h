#pragma once
#include "experiments/config/config.h"

class Device;

/// Renders one frame of a few pixels with each point of a study, so that a mistake in a shader or in a pass is an Error
/// before a reference is rendered, not after.
void rehearse(Device& device, const std::vector<VariantConfig>& variants);
