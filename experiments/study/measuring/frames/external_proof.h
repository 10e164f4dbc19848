#pragma once
#include "core/host_image.h"

#include <string>
#include <vector>

/// Whether an image of another program shows the same scene through the same camera in the same units. It is judged
/// where no technique may change anything: by the background and by surfaces that emit, which are as bright in every
/// image, with and without reflections.

/// What such a pixel must hold.
struct ProofPixels {
    HostImage radiance;    ///< RGB
    HostImage tolerance;   ///< one channel: by how much a channel may differ; negative: the pixel proves nothing
    size_t count() const;  ///< that prove something
};

/// `direct`: the truth's light without reflections (RGB); `direct_noise`: its standard error, one channel;
/// `reflection`: what reflections add (RGB), empty for an image without them; `emission`: of the surfaces (RGB);
/// `is_background`: one channel, 1 where nothing was hit.
ProofPixels proof_pixels(const HostImage& direct, const HostImage& direct_noise, const HostImage& reflection,
                         const HostImage& emission, const HostImage& is_background);

/// Fewer prove nothing about a camera.
inline constexpr size_t least_proof_pixels = 64;

/// Pixels that may differ at edges, where two rasterisers disagree on which surface a pixel's centre shows: of four
/// engines 6 of 48,154 did.
size_t most_differing(size_t proof_pixels);

struct Differences {
    std::vector<uint8_t> differs;  ///< by pixel
    size_t count = 0;
};
Differences differences(const HostImage& image, const ProofPixels& proof);

/// What is wrong with an image that differs in too many pixels, as a sentence that says what to change: what undoes it
/// was found by trying. "" if it agrees.
std::string why_refused(const HostImage& image, const ProofPixels& proof);

/// The same of an image with reflections, whose camera the one without has proved. Where a technique adds light to the
/// background or to what emits (a blur that leaks over a mirror's edge), that is its error and no reason to refuse it,
/// if at most half of the proof pixels differ, or `may_change_all`, and nothing undoes it. No shift is looked for: it
/// undoes each leak that is a pixel wide.
std::string why_refused_with_reflections(const HostImage& image, const ProofPixels& proof, bool may_change_all);

/// Where an image differs: red on the image's luminance in grey, green where it was compared and agrees.
HostImage difference_picture(const HostImage& image, const ProofPixels& proof);
