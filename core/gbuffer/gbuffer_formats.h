#pragma once
#include "core/gpu/passes/pass_list.h"

/// The formats in which techniques get the G-buffer. `exact`: those of gbuffer.h. `packed`: about half the bytes, as in
/// engines: rgba16f for normals with roughness, emission, lit colour and fallback; rgba8 for base colour with
/// metalness; rg16f for motion. Depth and material do not change.
enum class GBufferFormats { exact, packed };

/// For the pass_list that makes the images.
PassChanges gbuffer_changes(GBufferFormats formats);
