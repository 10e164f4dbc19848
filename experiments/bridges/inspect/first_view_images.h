#pragma once
#include "core/gpu/device.h"
#include "experiments/study/config/shots/scene_warnings.h"

#include <nlohmann/json.hpp>

/// What the pixels of a first view show, in quantities that both renderers know without noise. All of one extent.
struct FirstViewImages {
    HostImage color;     ///< RGB: base colour plus emitted radiance; 0 where nothing is hit, as all below
    HostImage normal;    ///< XYZ: unit shading normal, world space
    HostImage depth;     ///< one channel: along the view's -z (m)
    HostImage material;  ///< one channel: index into Scene::materials + 1
};

/// By the rasteriser, as a G-buffer. Fails as Device and Rasterizer do.
FirstViewImages rasterised_first_view(Device& device, const Scene& scene, const FirstView& view);
/// By the path tracer's rays through pixel centres.
FirstViewImages traced_first_view(const Scene& scene, const FirstView& view);

/// In which pixels two renderings of one view differ by more than rounding.
struct FirstViewDifference {
    /// By pixel: 1 if another surface is shown (another material, more than 1 % nearer or farther, or none); else 2 if
    /// a colour differs by more than 0.01 and 1 %, 4 if a normal differs by more than a degree.
    std::vector<uint8_t> differs;
    size_t surfaces = 0, colors = 0, normals = 0;  ///< pixels
    size_t pixels() const;                         ///< that differ in any way
};
FirstViewDifference difference_of(const FirstViewImages& rasterised, const FirstViewImages& traced);

nlohmann::ordered_json to_json(const FirstViewDifference& difference);

/// Three rows: colours, normals, depths (near is bright). Three columns: the rasteriser, the path tracer, and in red
/// where they differ. `exposure_ev`: colours are shown times 2^EV. Linear, as write_png() takes it.
HostImage picture_of(const FirstViewImages& rasterised, const FirstViewImages& traced,
                     const FirstViewDifference& difference, float exposure_ev);
