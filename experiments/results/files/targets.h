#pragma once
#include <string>
#include <vector>

/// Targets of comparisons: `specular`, `image`, `incident`, and the rungs of the truth ladder (truth_ladder.h) that are
/// means over the lobe like `incident`: `camera_radiance`, `on_screen`. The second rung is `incident` itself.
const std::vector<std::string>& target_names();
bool is_ladder_rung(const std::string& target);
