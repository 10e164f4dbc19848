#include "metrics/ghost.h"

#include "core/error.h"
#include "metrics/pooling.h"
#include "metrics/tiles.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double limit = 0.05;
constexpr double least_energy_in_noise = 4;  // half-widths
constexpr const char* lost_in_noise = "the change is not distinguishable from the noise of the reference";

using Columns = std::vector<std::vector<double>>;  // tile sums
using Totals = std::span<const double>;

/// The change between the references at each pixel, means over channels.
struct Change {
    HostImage difference;  ///< R_before - R_after
    NoisyMap energy;       ///< its square; without halves neither free of noise nor moved by it
};

Change change_between(const MetricReference& before, const MetricReference& after) {
    const glm::uvec2 extent = after.image.extent;
    const bool has_halves = before.halves && after.halves;
    const double samples = has_halves ? std::min(before.halves->samples, after.halves->samples) : 0;
    Change change{before.image, noisy_map(extent, samples)};
    change.energy.error = Plane(extent);
    change.energy.is_difference = true;
    for (size_t p = 0; p < change.energy.error.values.size(); ++p) {
        SquaredErrorVariance variance;
        for (size_t i = 3 * p; i < 3 * p + 3; ++i) {
            const double d = double(before.image.values[i]) - after.image.values[i];
            change.difference.values[i] = float(d);
            const double a = has_halves ? double(before.halves->a.values[i]) - after.halves->a.values[i] : d;
            const double b = has_halves ? double(before.halves->b.values[i]) - after.halves->b.values[i] : d;
            change.energy.error.values[p] += a * b / 3;
            change.energy.swapped.values[p] += (a * a - b * b) / 2 / 3;
            if (has_halves)
                variance.add(1.0 / 3, d, double(before.halves->variance.values[i]) + after.halves->variance.values[i]);
        }
        change.energy.variance.values[p] = variance.value();
    }
    return change;
}

Plane projection(const HostImage& frame, const HostImage& difference) {
    Plane plane(frame.extent);
    for (size_t i = 0; i < frame.values.size(); ++i)
        plane.values[i / 3] += double(frame.values[i]) * difference.values[i] / 3;
    return plane;
}

Plane squared_error(const HostImage& frame, const MetricReference& reference) {
    const HostImage& a = reference.halves ? reference.halves->a : reference.image;
    const HostImage& b = reference.halves ? reference.halves->b : reference.image;
    return cross_error(frame, a, b, reference.image, [](double) { return 1.0; });
}

Mask finite_in_all(std::span<const HostImage> frames, const MetricReference& before, const MetricReference& after) {
    Mask finite = intersection(before.finite, after.finite);
    keep_finite(finite, before.image);
    keep_finite(finite, after.image);
    for (const HostImage& frame : frames) keep_finite(finite, frame);
    return finite;
}

/// The tile sums under one mask.
struct MaskSums {
    Mask inside;
    std::vector<double> counts, energy;
    Columns projections, errors;  ///< of each frame
    double mean_energy, energy_half_width;
};

/// The mean of the last quarter of the frames.
std::vector<double> plateau(const Columns& frames) {
    const size_t count = frames.size() / 4;
    std::vector<double> mean(frames[0].size());
    for (size_t t = frames.size() - count; t < frames.size(); ++t)
        for (size_t i = 0; i < mean.size(); ++i) mean[i] += frames[t][i] / double(count);
    return mean;
}

/// A number of each frame and its uncertainty.
struct Curve {
    std::vector<double> values;
    std::vector<std::optional<double>> half_widths;
};

/// `statistic` gets the totals of: counts, the frame, the plateau, `scale`.
Curve curve(const std::vector<double>& counts, const Columns& frames, const std::vector<double>& scale,
            double (*statistic)(Totals)) {
    Curve result;
    Columns columns = {counts, {}, plateau(frames), scale};
    for (const std::vector<double>& frame : frames) {
        columns[1] = frame;
        result.values.push_back(statistic(totals(columns)));
        result.half_widths.push_back(jackknife_half_width(columns, statistic));
    }
    return result;
}

double share_of_change(Totals t) { return (t[1] - t[2]) / t[3]; }
double share_of_first_step(Totals t) { return (t[1] - t[2]) / (t[3] - t[2]); }

/// The least age from which on the size of the curve, widened by `widening` half-widths, stays below the limit; none if
/// that is beyond half of the frames.
std::optional<double> settled_age(const Curve& curve, double widening) {
    const size_t count = curve.values.size();
    size_t age = count;
    const auto size = [&](size_t t) { return std::abs(curve.values[t]) + widening * curve.half_widths[t].value_or(0); };
    while (age > 0 && size(age - 1) < limit) --age;
    return age <= count / 2 ? std::optional(double(age)) : std::nullopt;
}

void set_length(TemporalScore& row, const Curve& curve) {
    const std::optional<double> age = settled_age(curve, 0);
    if (!age) {
        row.note = "not within the first half of " + std::to_string(curve.values.size()) + " frames";
        return;
    }
    row.value = *age;
    if (!curve.half_widths[0]) return;
    row.low = settled_age(curve, -1);
    row.high = settled_age(curve, 1);
}

void set_settling_length(TemporalScore& row, const MaskSums& s) {
    // The first frame's step, in units of the change: where it is too small to measure, there is nothing to settle.
    const Columns columns = {s.counts, s.errors[0], plateau(s.errors), s.energy};
    const double step = std::abs(share_of_change(totals(columns)));
    const double half_width = jackknife_half_width(columns, share_of_change).value_or(0);
    if (step > half_width)
        set_length(row, curve(s.counts, s.errors, s.errors[0], share_of_first_step));
    else if (step + half_width < limit)
        row.value = 0;
    else
        row.note = "the error of the first frame is not distinguishable from the plateau's";
}

Ghost ghost_of(const MaskSums& s, const Mask& mask, const Mask& finite, bool has_halves) {
    Ghost ghost{.ghost_length = empty_score("ghost_length", mask, finite),
                .settling_length = empty_score("settling_length", mask, finite)};
    ghost.ghost_length.corrected = ghost.settling_length.corrected = has_halves;
    const size_t pixels = ghost.ghost_length.pixels;
    if (pixels == 0) return ghost;
    for (const std::vector<double>& error : s.errors)
        ghost.error.push_back(totals(std::span(&error, 1)).front() / double(pixels));
    if (!(s.mean_energy > least_energy_in_noise * s.energy_half_width)) {
        ghost.ghost_length.note = ghost.settling_length.note = lost_in_noise;
        return ghost;
    }
    const Curve share = curve(s.counts, s.projections, s.energy, share_of_change);
    ghost.share = share.values;
    set_length(ghost.ghost_length, share);
    set_settling_length(ghost.settling_length, s);
    return ghost;
}

}  // namespace

std::vector<Ghost> ghost_scores(std::span<const HostImage> frames, const MetricReference& before,
                                const MetricReference& after, std::span<const Mask> masks) {
    if (frames.size() < least_ghost_frames)
        fail("the length of a ghost needs at least ", least_ghost_frames, " frames after the change, found ",
             frames.size());
    const Mask finite = finite_in_all(frames, before, after);
    const Change change = change_between(before, after);
    std::vector<MaskSums> sums;
    for (const Mask& mask : masks) {
        MaskSums& s = sums.emplace_back(MaskSums{.inside = intersection(mask, finite)});
        s.counts = tile_counts(s.inside);
        s.energy = tile_sums(change.energy.error, s.inside);
        s.mean_energy = masked_mean(change.energy.error, s.inside);
        s.energy_half_width = noise_half_width(change.energy, s.inside).value_or(INFINITY) / double(s.inside.count());
    }
    for (const HostImage& frame : frames) {
        const Plane projected = projection(frame, change.difference), error = squared_error(frame, after);
        for (MaskSums& s : sums) {
            s.projections.push_back(tile_sums(projected, s.inside));
            s.errors.push_back(tile_sums(error, s.inside));
        }
    }
    const bool has_halves = before.halves && after.halves;
    std::vector<Ghost> ghosts;
    for (size_t m = 0; m < masks.size(); ++m) ghosts.push_back(ghost_of(sums[m], masks[m], finite, has_halves));
    return ghosts;
}
