#pragma once
#include "tests/variants/technique_fixture.h"
#include "variants/common/blue_noise.h"

/// Runs the pass of blue noise for any frame and seed.
struct BlueNoiseTest : TechniqueTest {
    PassList pass_list{device(), {8, 8}};
    BlueNoise noise;
    ParameterSet no_parameters;

    void begin(unsigned frame, unsigned seed) {
        CameraData camera{};
        camera.frame = {frame, seed, 0, frame > 0};
        pass_list.begin_frame(camera, no_parameters, {});
    }
    HostImage numbers(unsigned frame, unsigned seed, NoiseShift shift,
                      NoisePrecision precision = NoisePrecision::bits_8) {
        begin(frame, seed);
        return pass_list.download(noise.render(pass_list, shift, precision));
    }
};
