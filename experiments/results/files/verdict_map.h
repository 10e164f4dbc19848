#pragma once

/// In images of the kind `hits`, a channel's value is the colour's code (0 to 1) to this power.
inline constexpr float verdict_map_gamma = 2.2f;
