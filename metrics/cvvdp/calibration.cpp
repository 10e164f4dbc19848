#include "metrics/cvvdp/calibration.h"

const CvvdpCalibration& cvvdp_0_5_6_calibration() {
    // pycvvdp/vvdp_data/cvvdp_parameters.json at commit 7ca201accf78; epsilon and channel_gain are in the program.
    static const CvvdpCalibration calibration{
        .version = "0.5.6",
        .epsilon = 1e-5,
        .temporal_sigma = {5.79336, 14.1255, 6.63661, 0.12314},
        .temporal_beta = {1.3314, 1.1196, 0.947901, 0.1898},
        .transient_hertz = 5,
        .sensitivity_decibels = -0.2797423303127289,
        .channel_gain = {1, 1.45, 1, 1},
        .mask_exponent = 2.264355182647705,
        .masking_exponents = {1.302622675895691, 2.8885908126831055, 3.6807713508605957, 3.588787317276001},
        .log10_mask_gain = -0.7954971194267273,
        .mask_blur_sigma = 3,
        .log2_cross_channels = {{{-0.18950104713439941, -5.962151050567627, -4.31834602355957, -1.9321587085723877},
                                 {2.5655593872070312, 0.34406712651252747, -2.719646453857422, -0.4970424771308899},
                                 {3.8118371963500977, -1.0051705837249756, -0.5193376541137695, -0.5653647780418396},
                                 {-7.054771423339844, -5.527150630950928, -3.5106418132781982, -2.08804988861084}}},
        .log10_greatest_difference = 2.5642454624176025,
        .channel_weights = {1, 1, 1, 0.8081134557723999},
        .base_band_weights = {0.0036334486212581396, 1.6627724170684814, 4.11874532699585, 25.25969886779785},
        .still_weight = 0.577918291091919,
        .pixel_norm = 2,
        .band_norm = 4,
        .channel_norm = 4,
        .frame_norm = 2,
        .jod_factor = 0.0439569391310215,
        .jod_exponent = 0.9302042722702026,
    };
    return calibration;
}
