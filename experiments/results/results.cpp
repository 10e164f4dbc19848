#include "experiments/results/results.h"

#include "core/error.h"
#include "core/files.h"
#include "experiments/results/csv.h"

#include <algorithm>
#include <cmath>

void write_tables(const std::filesystem::path& folder, const std::vector<Cell>& cells) {
    std::string rows =
        "shot,scene,camera,frame,width,height,variant,point,seed,target,metric,formula,mask,value,corrected,"
        "uncorrected,low,high,floor,lit_noise,lit_half_width,pixels,non_finite,negative\n";
    std::string splits =
        "shot,frame,variant,point,target,mask,seeds,mse,bias_squared,variance,variance_low,variance_high,pixels,bias_"
        "squared_low,bias_squared_high\n";
    std::string times = "shot,variant,point,seed,stage,frame,milliseconds,clock,foreign_load,disturbed\n";
    std::string hits = "shot,frame,variant,point,stage,mask,quantity,seeds,rays,value,low,high\n";
    const size_t no_hits = hits.size();
    for (const Cell& cell : cells) {
        for (const ResultRow& r : cell.rows)
            rows += csv_line(r.shot, r.scene, r.camera, r.frame, r.width, r.height, r.variant, r.point, r.seed,
                             r.target, r.metric, r.formula, r.mask, r.value, r.is_corrected, r.uncorrected, r.low,
                             r.high, r.floor, r.lit_noise, r.lit_half_width, r.pixels, r.non_finite, r.negative);
        for (const SplitRow& s : cell.splits)
            splits += csv_line(s.shot, s.frame, s.variant, s.point, s.target, s.mask, s.seeds, s.mse, s.bias_squared,
                               s.variance, s.variance_low, s.variance_high, s.pixels, s.bias_squared_low,
                               s.bias_squared_high);
        for (const TimeRow& t : cell.times)
            times += csv_line(t.shot, t.variant, t.point, t.seed, t.stage, t.frame, t.milliseconds, t.clock,
                              t.foreign_load, t.is_disturbed);
        for (const HitRow& h : cell.hits)
            hits += csv_line(h.shot, h.frame, h.variant, h.point, h.stage, h.mask, h.quantity, h.seeds, h.rays, h.value,
                             h.low, h.high);
    }
    write_text(folder / "results.csv", rows);
    if (hits.size() > no_hits)
        write_text(folder / "hits.csv", hits);
    else
        std::filesystem::remove(folder / "hits.csv");  // of an earlier version of the study
    write_text(folder / "splits.csv", splits);
    write_text(folder / "times.csv", times);
}

MedianInterval median_interval(std::vector<double> values) {
    if (values.empty()) fail("no values to take a median of");
    std::ranges::sort(values);
    const size_t n = values.size();
    const double median = n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
    // The largest r for which P(Binomial(n, 1/2) < r) <= 2.5 %: then [x_r, x_(n+1-r)] covers the median with at least
    // 95 %.
    double probability = std::pow(0.5, double(n)), cumulative = 0.0;
    size_t r = 0;
    while (cumulative + probability <= 0.025) {
        cumulative += probability;
        probability *= double(n - r) / double(r + 1);
        ++r;
    }
    r = std::max<size_t>(r, 1);
    return {median, values[r - 1], values[n - r]};
}
