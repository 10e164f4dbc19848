#pragma once
#include "core/host_image.h"

#include <string>
#include <vector>

/// Proof that another program's image shows the same scene through the same camera in the same units. It is judged
/// where no technique may change anything: background and emitting surfaces are equally bright with and without
/// reflections.

/// The values that these pixels must hold.
struct ProofPixels {
    HostImage radiance;    ///< RGB
    HostImage tolerance;   ///< one channel: allowed difference of each channel; negative: the pixel proves nothing
    size_t count() const;  ///< number of pixels that prove something
};

/// `direct`: the truth's light without reflections (RGB). `direct_noise`: its standard error, one channel.
/// `reflection`: light that reflections add (RGB), empty for an image without reflections. `emission`: of the surfaces
/// (RGB). `is_background`: one channel, 1 where nothing was hit.
ProofPixels proof_pixels(const HostImage& direct, const HostImage& direct_noise, const HostImage& reflection,
                         const HostImage& emission, const HostImage& is_background);

/// Fewer proof pixels prove nothing about a camera.
inline constexpr size_t least_proof_pixels = 64;

/// Number of pixels that may differ, as rasterisers disagree at edges about which surface a pixel's centre shows. In
/// images of four engines 6 of 48,154 pixels did.
size_t most_differing(size_t proof_pixels);

struct Differences {
    std::vector<uint8_t> differs;  ///< by pixel
    size_t count = 0;
};
Differences differences(const HostImage& image, const ProofPixels& proof);

/// Why an image is refused: it differs in too many pixels. The sentence says what to change, found by trying
/// corrections. "" if the image agrees.
std::string why_refused(const HostImage& image, const ProofPixels& proof);

/// why_refused() for an image with reflections, whose camera is proved by the image without. A technique may add light
/// to the background or to emitters (a blur that leaks over a mirror's edge): that is its error and no reason to refuse
/// the image. This holds if no correction undoes it and at most half of the proof pixels differ, or `may_change_all`.
/// No shift is tried: it would undo each leak one pixel wide.
std::string why_refused_with_reflections(const HostImage& image, const ProofPixels& proof, bool may_change_all);

/// Picture of the differences: red where the image differs, green where it was compared and agrees, on its luminance in
/// grey.
HostImage difference_picture(const HostImage& image, const ProofPixels& proof);
