#pragma once
#include "groundtruth/reference/reference.h"

/// The reference from `folder`, rendered if it is not there. Files are named by reference_key(), so a changed scene,
/// camera, setting or path tracer finds nothing and renders anew. An unfinished render is continued, a finished one of
/// less time or fewer samples is added to where can_be_extended() allows it, and a broken file is replaced, with a
/// notice. Of several processes that want
/// the same reference one renders and the others wait for it. `run.state_file` is not used. Fails with MachineError if
/// `folder` cannot be written: before rendering, not after.
Reference cached_reference(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                           const ReferenceSettings& settings, const std::filesystem::path& folder,
                           const ReferenceRun& run = {});
