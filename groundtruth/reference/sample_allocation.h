#pragma once
#include "groundtruth/reference/reference_file.h"

#include <vector>

/// The samples of other pixels, the informers, decide how many samples a pixel gets; its own samples never do. A pixel
/// that stops when its own error looks small has often missed its rare bright paths, and its mean is too small (by up
/// to a third if one path in 10^4 carries a third of the light).
///
/// Information flows one way: only pixels of lower rank inform a pixel. Over any number of passes, no chain of
/// decisions leads from a pixel's samples back to its own count. Given the count, a pixel's samples are thus as
/// independent as with a fixed count: the means of both halves have no bias, nor has their product. (If neighbours
/// informed each other, a pixel that met a rare path would give them more samples, and they the pixel.) The rank is the
/// lattice of the pixel, coarse lattices first, then the order of rows. Three of four pixels so have informers that
/// touch them on all sides.
///
/// A pixel whose informers see other light (the reflection of an edge, or a small mirror) would always get too few
/// samples. So the guide informs the pixel, too: it has separate samples of the pixel itself, which are not kept. The
/// guide never lowers the informers' number, since it has few samples.
///
/// Some pixels still miss the target, since estimates scatter. While time is left, a lattice gets more samples if too
/// many pixels of coarser lattices missed the target. A pixel's own error never gives the pixel more.
///
/// Three quantities belong to the whole image, where each pixel has a small share: the radiance floor of relative
/// errors and, with a time limit, the cost of all pixels and the factor of additional samples.

/// Replaces `found` by the informers of pixel (x, y), as indices of pixels. They have lower rank and the same material,
/// within a window of the pixel's lattice. If these are fewer than 4, wider windows are searched, then surfaces of any
/// material. There are none if the widest window holds no pixel of lower rank.
void find_informers(const HostImage& material_id, unsigned x, unsigned y, std::vector<size_t>& found);

/// Samples that each pixel needs for the target of the state's settings, estimated from its informers and its guide;
/// one channel, 0 where noise is unknown. state.earlier has the rate at which errors fall.
HostImage needed_samples(const ReferenceState& state);

/// The largest factor by which a pixel may exceed needed_samples() while time is left; one channel. 4 if coarser
/// lattices than the pixel's have fewer than 200 pixels; unlimited if more than 0.5 % of those pixels miss the target
/// by their stated error; else 1.
HostImage largest_factors(const ReferenceState& state);
