#include "experiments/results/cell.h"

namespace nlohmann {
template <class T>
struct adl_serializer<std::optional<T>> {
    static void to_json(json& j, const std::optional<T>& value) {
        if (value)
            j = *value;
        else
            j = nullptr;
    }
    static void from_json(const json& j, std::optional<T>& value) {
        if (j.is_null())
            value.reset();
        else
            value = j.get<T>();
    }
};
}  // namespace nlohmann

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ResultRow, shot, scene, camera, frame, width, height, variant, point, seed, target,
                                   metric, formula, mask, value, is_corrected, uncorrected, low, high, floor, lit_noise,
                                   lit_half_width, pixels, non_finite, negative)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SeedPairs, variance, bias_squared)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SplitRow, shot, frame, variant, point, target, mask, seeds, mse, bias_squared,
                                   variance, variance_low, variance_high, pixels, bias_squared_low, bias_squared_high,
                                   seed_numbers, pairs, reference_noise, lit_noise, lit_half_width)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(HitRow, shot, frame, variant, point, stage, mask, quantity, seeds, rays, value, low,
                                   high)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReferenceNoise, shot, frame, variant, point, target, metric, mask, sums)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TimeRow, shot, variant, point, seed, stage, frame, milliseconds, clock, foreign_load,
                                   is_disturbed)

void to_json(nlohmann::json& json, const Cell& cell) {
    json = {{"rows", cell.rows},     {"splits", cell.splits}, {"reference_noise", cell.reference_noise},
            {"times", cell.times},   {"hits", cell.hits},     {"images", cell.images},
            {"timing", cell.timing}, {"notes", cell.notes},   {"provenance", cell.provenance}};
}

void from_json(const nlohmann::json& json, Cell& cell) {
    json.at("rows").get_to(cell.rows), json.at("splits").get_to(cell.splits), json.at("times").get_to(cell.times);
    json.at("reference_noise").get_to(cell.reference_noise);
    json.at("hits").get_to(cell.hits);
    cell.images = json.at("images"), cell.timing = json.at("timing");
    json.at("notes").get_to(cell.notes), cell.provenance = json.at("provenance");
}
