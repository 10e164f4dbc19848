#include "experiments/results/files/image_layers.h"

namespace {

constexpr DescribedLayer estimated_layers[] = {
    {"diffuse", "RGB",
     "radiance that the first hit emits and reflects diffusely; the environment's where nothing is hit"},
    {"image", "RGB", "all radiance: `diffuse`, `specular` and `highlights` together"},
    {"specular", "RGB", "radiance that the first hit reflects specularly, without punctual lights"},
    {"incident", "RGB", "radiance that arrives along the specular lobe, averaged, before the surface's reflectance"},
};

constexpr DescribedLayer other_layers[] = {
    {"guide.specular", "RGB", "`specular` from a few separate samples, which weigh relative errors"},
    {"guide.incident", "RGB", "the same of `incident`"},
    {"guide.diffuse", "RGB", "the same of `diffuse`"},
    {"highlights", "RGB", "radiance of punctual lights that the first hit reflects specularly, without noise"},
    {"cut_share", "Y", "share of the radiance that is missing because paths end after `--max-depth` reflections"},
    {"sample_count", "Y", "number of samples"},
    {"lobe_samples", "XY", "specular directions of each half that are above the horizon"},
    {"directions", "XY", "with `--adaptive-share`: directions of the diffuse and of the specular lobe in each sample"},
    {"depth", "Z", "distance along the view axis in metres; 0 where nothing is hit"},
    {"geometric_normal", "XYZ", "unit normal of the triangle in world space, towards the camera"},
    {"normal", "XYZ", "unit shading normal in world space"},
    {"material_id", "Y", "number of the material, from 1; 0 where nothing is hit"},
};

constexpr DescribedLayer rung_layers[] = {
    {"camera_radiance", "RGB", "`incident` of the radiance that the points that rays meet send towards the camera"},
    {"on_screen", "RGB", "`camera_radiance`, but `fallback` where the image does not show the point"},
};

constexpr DescribedLayer layers_of_rungs[] = {
    {"on_screen_share", "Y", "share of the lobe that meets points that the image shows"},
    {"reflectance", "RGB", "albedo of the specular lobe"},
    {"fallback", "RGB", "radiance of the environment, averaged over the specular lobe"},
    {"camera_radiance.error_variance.incident", "RGB", "variance of `camera_radiance` minus `incident`"},
    {"camera_radiance.error_variance.specular", "RGB",
     "variance of `camera_radiance` times `reflectance`, minus `specular`"},
    {"on_screen.error_variance.incident", "RGB", "variance of `on_screen` minus `incident`"},
    {"on_screen.error_variance.specular", "RGB", "variance of `on_screen` times `reflectance`, minus `specular`"},
};

constexpr DescribedLayer kinds_of_images[] = {
    {"result", "radiance of the target", "image of a technique: `image`, `specular` or `incident`"},
    {"reference", "radiance of the target", "the truth for the same targets"},
    {"error", "relative errors", "(test - reference) / (|reference| + `epsilon`); the entry has `epsilon`"},
    {"raw", "radiance", "what the technique found along rays, before fallback and reflectance"},
    {"confidence", "three times the same number", "confidence of the technique, from 0 to 1"},
    {"hits", "colours of a picture", "how rays ended, with `hits` in the config"},
    {"surface", "three times the same number", "roughness of the surfaces"},
    {"played", "radiance of the target", "frames of a sequence that the report plays"},
};

}  // namespace

ReferenceLayers reference_layers() { return {estimated_layers, other_layers, rung_layers, layers_of_rungs}; }

std::span<const DescribedLayer> result_image_kinds() { return kinds_of_images; }
