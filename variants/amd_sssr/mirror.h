#ifndef AMD_SSSR_MIRROR_H
#define AMD_SSSR_MIRROR_H
#include "core/shared/language.h"

/// Below this alpha a surface is a mirror: it needs no random numbers, traces in every pixel and is not filtered in
/// space (SSSR 1.5, ffx_sssr_common.h).
const float amd_mirror_alpha = 1e-4f;
#endif
