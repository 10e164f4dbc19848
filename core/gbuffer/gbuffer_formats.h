#pragma once
#include "core/gpu/passes/pass_list.h"

/// In which formats techniques find the G-buffer. `exact`: those of gbuffer.h. `packed`: as engines have it, in about
/// half of the bytes: normals with their roughness, emission, lit colour and fallback rgba16f, base colour with its
/// metalness rgba8, motion rg16f. Depth and material stay.
enum class GBufferFormats { exact, packed };

/// For the pass_list that makes the images.
PassChanges gbuffer_changes(GBufferFormats formats);
