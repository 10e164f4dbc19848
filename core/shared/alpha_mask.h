#ifndef SHARED_ALPHA_MASK_H
#define SHARED_ALPHA_MASK_H
#include "core/shared/language.h"

/// Alpha equal to the cutoff is opaque (glTF 2.0, section 3.9.4). Alpha is a product of a factor, a vertex colour and a
/// bilinear mean of texels. It has at most 13 roundings of 2^-24 if these are constant; the test allows for 16.
const float opaque_share_of_cutoff = 0.99999904632568359375;  ///< 1 - 2^-20

/// Whether an alpha mask leaves nothing of a surface.
SHARED bool is_below_cutoff(float alpha, float cutoff) { return alpha < cutoff * opaque_share_of_cutoff; }
#endif
