#include "metrics/temporal.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>

const std::vector<TemporalMetric>& temporal_metrics() {
    using enum Better;
    static const std::vector<TemporalMetric> table = {
        {"flicker", "temporal_deviation", "radiance", lower,
         "Square root of the variance over the frames of a converged shot without motion; mean over pixels and "
         "channels"},
        {"flicker_relative", "temporal_variance_a", "1", lower,
         "Mean of that variance / (r^2 + 0.01), weighted as relmse", "temporal_variance_a_guided"},
        {"flicker_correlation", "temporal_lag_1", "1", near_zero,
         "1 - mean (x_t - x_(t-1))^2 / (2 mean variance over the frames). 0 for independent frames, towards 1 if each "
         "frame repeats the last. With a value near 1, flicker may be low only because the image lags behind",
         "", 1},
        {"frame_difference", "frame_difference_mse", "radiance^2", lower,
         "Mean of ((x_t - x_(t-1)) - (r_t - r_(t-1)))^2: changes between frames that the truth does not have", "",
         INFINITY, true},
        {"frame_difference_relative", "frame_difference_a", "1", lower,
         "Mean of frame_difference / (r_t^2 + 0.01), weighted as relmse", "frame_difference_a_guided", INFINITY, true},
        {"ghost_share", "ghost_projection_history", "1", near_zero,
         "Share of the truth's earlier images in the frames: (x_t - r_t) projected onto (h_t - r_t), where h_t is the "
         "exponential mean of earlier truths with weight 0.1. 1: frames are a history of the truth",
         "", INFINITY, true},
        {"ghost_length", "ghost_projection_0.05", "frames", lower,
         "Frames after a change that still contain 5 % of the old image or more: (x_t - plateau) projected onto the "
         "truth's change"},
        {"settling_length", "squared_error_step_0.05", "frames", lower,
         "Frames after a change until the squared error is within 5 % of its first step above its final level"},
        {"cvvdp_0_5_6_video", "colorvideovdp_0.5.6_video", "JOD", higher,
         "As cvvdp_0_5_6, of the frames as a video at the scene's frame rate: it also sees flicker, ghosts and lag. "
         "The target is the image, in which all light but the reflections is the truth's",
         "", 10, true},
    };
    return table;
}

const TemporalMetric& temporal_metric_named(const std::string& name) {
    return find_named(temporal_metrics(), name, "no temporal metric named");
}

const TemporalMetric* find_temporal_metric(const std::string& name) {
    const auto found = std::ranges::find(temporal_metrics(), name, &TemporalMetric::name);
    return found == temporal_metrics().end() ? nullptr : &*found;
}

TemporalScore empty_score(const std::string& metric, const Mask& mask, const Mask& finite) {
    const TemporalMetric& named = temporal_metric_named(metric);
    TemporalScore row{.metric = &named, .formula = named.formula, .mask = mask.name};
    row.pixels = intersection(mask, finite).count();
    row.left_out = mask.count() - row.pixels;
    if (row.pixels == 0) row.note = no_pixel;
    return row;
}

void keep_finite(Mask& mask, const HostImage& rgb) {
    if (rgb.extent != mask.extent || rgb.channels != 3)
        fail("an image of a sequence has ", rgb.extent.x, "x", rgb.extent.y, " pixels and ", rgb.channels,
             " channels, but the first one ", mask.extent.x, "x", mask.extent.y, " and 3: all must be alike");
    for (size_t i = 0; i < rgb.values.size(); ++i)
        if (!std::isfinite(rgb.values[i])) mask.inside[i / 3] = 0;
}

double relative_weight(double reference) {
    static const auto weight = metric_named("relmse").squared_error_weight;
    return weight(reference);
}

std::string formula_of(const TemporalMetric& metric, bool has_guide) {
    return has_guide && !metric.guided_formula.empty() ? metric.guided_formula : metric.formula;
}
