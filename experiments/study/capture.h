#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "groundtruth/reference.h"

/// What results call a capture: the name of its folder.
std::string capture_name(const std::filesystem::path& gbuffer);

/// The reference of a capture. Fails if it has another size, or was evidently made from another place: its first hits
/// must lie at the G-buffer's depths but for a few pixels at edges; or if it lacks the truth ladder that is needed.
Reference read_capture_reference(const std::filesystem::path& file, const HostGBuffer& gbuffer, bool needs_ladder);
