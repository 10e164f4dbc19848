#pragma once
#include <span>

/// What readers are told of a layer of an image file.
struct DescribedLayer {
    const char *name, *channels, *meaning;
};

/// The layers that write_reference() (groundtruth/reference/reference_file.h) writes. `estimates` have noise: the file
/// has also NAME.a and NAME.b, each from one half of the samples, and NAME.variance. `others` come alone. `rungs` and
/// `of_rungs` are the same, in references with a truth ladder.
struct ReferenceLayers {
    std::span<const DescribedLayer> estimates, others, rungs, of_rungs;
};
ReferenceLayers reference_layers();

/// Kinds of the images of a results folder, as manifest.json lists them; `channels`: the numbers that R, G and B hold.
std::span<const DescribedLayer> result_image_kinds();
