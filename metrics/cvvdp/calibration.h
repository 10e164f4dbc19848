#pragma once
#include <array>
#include <string>

/// Opponent channels in the order of all arrays: sustained achromatic, red-green, yellow-violet, and for videos the
/// transient achromatic one.
inline constexpr unsigned cvvdp_channels = 4;

template <class T>
using PerCvvdpChannel = std::array<T, cvvdp_channels>;

/// All constants that a calibration of ColorVideoVDP fits to observers. Names in brackets are those of its parameter
/// file. The other constants of the model are where they are used.
struct CvvdpCalibration {
    std::string version;

    double epsilon;  ///< of every power, which is (x + epsilon)^e - epsilon^e

    PerCvvdpChannel<double> temporal_sigma;  ///< [sigma_tf]
    PerCvvdpChannel<double> temporal_beta;   ///< [beta_tf]
    double transient_hertz;                  ///< frequency that the transient channel sees best

    double sensitivity_decibels;  ///< [sensitivity_correction]
    PerCvvdpChannel<double> channel_gain;

    double mask_exponent;                                          ///< [mask_p] of the difference
    PerCvvdpChannel<double> masking_exponents;                     ///< [mask_q] of the channel that masks
    double log10_mask_gain;                                        ///< [mask_c]
    double mask_blur_sigma;                                        ///< [pu_dilate], pixels
    PerCvvdpChannel<PerCvvdpChannel<double>> log2_cross_channels;  ///< [xcm_weights], [masks][is masked]
    double log10_greatest_difference;                              ///< [d_max]

    PerCvvdpChannel<double> channel_weights;    ///< [ch_chrom_w, ch_trans_w]
    PerCvvdpChannel<double> base_band_weights;  ///< [baseband_weight]
    double still_weight;                        ///< [image_int] what a still counts relative to a frame of a video
    double pixel_norm, band_norm, channel_norm, frame_norm;  ///< [beta, beta_sch, beta_tch, beta_t]
    double jod_factor, jod_exponent;                         ///< [jod_a, jod_exp]
};

/// Version 0.5.6 of ColorVideoVDP (Mantiuk, Hanji, Ashraf, Asano, Chapiro 2024, "ColorVideoVDP: A visual difference
/// predictor for image, video and display distortions", ACM TOG 43(4)): the calibration of January 2024.
const CvvdpCalibration& cvvdp_0_5_6_calibration();
