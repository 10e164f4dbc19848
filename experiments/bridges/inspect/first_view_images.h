#pragma once
#include "core/gpu/device.h"
#include "experiments/study/config/shots/scene_warnings.h"

#include <nlohmann/json.hpp>

/// What the pixels of a first view show, in quantities that both renderers know without noise. All images have one
/// extent.
struct FirstViewImages {
    HostImage color;     ///< RGB: base colour + emitted radiance. All images are 0 where nothing is hit
    HostImage normal;    ///< XYZ: unit shading normal, world space
    HostImage depth;     ///< one channel: along the view's -z (m)
    HostImage material;  ///< one channel: index into Scene::materials + 1
};

/// Renders the view with the rasteriser, as a G-buffer. Fails as Device and Rasterizer do.
FirstViewImages rasterised_first_view(Device& device, const Scene& scene, const FirstView& view);
/// Traces the view with the path tracer's rays through pixel centres.
FirstViewImages traced_first_view(const Scene& scene, const FirstView& view);

/// The pixels in which two renderings of one view differ by more than rounding.
struct FirstViewDifference {
    /// One code for each pixel. 1: another surface is shown (another material, a depth that differs by more than 1 %,
    /// or none). Else a sum of 2 (a colour differs by more than 0.01 and 1 %) and 4 (a normal differs by more than a
    /// degree).
    std::vector<uint8_t> differs;
    size_t surfaces = 0, colors = 0, normals = 0;  ///< pixels
    size_t pixels() const;                         ///< number that differ in any way
};
FirstViewDifference difference_of(const FirstViewImages& rasterised, const FirstViewImages& traced);

nlohmann::ordered_json to_json(const FirstViewDifference& difference);

/// Three rows: colours (times 2^`exposure_ev`), normals, depths (near is bright). Three columns: rasteriser, path
/// tracer, and differences in red. Linear, as write_png() takes it.
HostImage picture_of(const FirstViewImages& rasterised, const FirstViewImages& traced,
                     const FirstViewDifference& difference, float exposure_ev);
