#pragma once
#include "groundtruth/reference/reference.h"

/// The reference from `folder`, rendered if it is missing. Files are named by reference_key(), so a changed scene,
/// camera, setting or path tracer renders anew. Continues an unfinished render, adds to a finished one if
/// can_be_extended() allows it, and replaces a broken file, with a notice. If several processes want the same
/// reference, one renders and the others wait. `run.state_file` is not used. Fails with MachineError if `folder` cannot
/// be written: before rendering, not after.
Reference cached_reference(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                           const ReferenceSettings& settings, const std::filesystem::path& folder,
                           const ReferenceRun& run = {});
