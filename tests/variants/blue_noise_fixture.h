#pragma once
#include "tests/variants/variant_fixture.h"
#include "variants/common/blue_noise.h"

/// Runs the pass of blue noise for any frame and seed.
struct BlueNoiseTest : VariantTest {
    PassGraph graph{device(), {8, 8}};
    BlueNoise noise;
    ParameterSet no_parameters;

    void begin(unsigned frame, unsigned seed) {
        CameraData camera{};
        camera.frame = {frame, seed, 0, frame > 0};
        graph.begin_frame(camera, no_parameters, {});
    }
    HostImage numbers(unsigned frame, unsigned seed, NoiseShift shift,
                      NoisePrecision precision = NoisePrecision::bits_8) {
        begin(frame, seed);
        return graph.download(noise.render(graph, shift, precision));
    }
};
