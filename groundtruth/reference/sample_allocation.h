#pragma once
#include "groundtruth/reference/reference_file.h"

#include <vector>

/// How many samples a pixel gets is decided by the samples of other pixels, its informers, and never by its own: a
/// pixel that stops when its own error looks small is more often one that has not yet met its rare bright paths, and
/// its mean comes out too small (by up to a third where one path in 10^4 carries a third of the light).
///
/// Informing runs one way: pixels are ranked, each is informed by pixels of lower rank only, and so no chain of
/// decisions leads from a pixel's samples back to its own count, over any number of passes. Given the count, a pixel's
/// samples are thus as independent as if it had been fixed beforehand: the means of both halves are without bias, and
/// so is their product. (If neighbours informed each other, a pixel that met a rare path would give them more
/// samples, and they it.) The rank is the lattice on which a pixel lies, coarse ones first, then the order of rows: so
/// three pixels out of four have informers that touch them on all sides.
///
/// A pixel whose informers see another light than it does (the reflection of an edge, or a small mirror) would keep too
/// few samples for ever. So its guide informs it too: samples of the pixel itself, but of a set of their own, of which
/// nothing is kept. It never lowers what informers ask for, since it has few samples.
///
/// Some pixels miss the target even so, since what is estimated scatters. While time is left, more samples go to all
/// pixels of those lattices before which, in the order of rank, too many have missed it: a pixel's own error never
/// gives it more.
///
/// Three quantities are of the whole image, to which a pixel contributes one part in the number of pixels: the radiance
/// floor of relative errors, and, with a time limit, what all pixels cost, and by which factor those get more.

/// The informers of pixel (x, y): those of lower rank and of its material within a window of its lattice; where these
/// are fewer than 4, within wider windows; then those of any material that is hit, and none where even the widest
/// window holds none of lower rank. `found` is replaced: indices of pixels.
void find_informers(const HostImage& material_id, unsigned x, unsigned y, std::vector<size_t>& found);

/// Samples that each pixel needs for the target of the state's settings, estimated from its informers and its guide;
/// one channel, 0 where noise is unknown. state.earlier has the rate at which errors fall.
HostImage needed_samples(const ReferenceState& state);

/// By which factor a pixel may get more than needed_samples() says while time is left; one channel. Any factor where
/// more than 0.5 % of the pixels on coarser lattices than its own miss the target by their stated error; up to 4 where
/// those are fewer than 200; else 1.
HostImage largest_factors(const ReferenceState& state);
