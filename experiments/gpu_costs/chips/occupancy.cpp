#include "experiments/gpu_costs/chips/occupancy.h"

#include <algorithm>

namespace {

constexpr SimdLimits gcn_1_2{.vgprs = 256, .vgpr_step = 4, .sgprs = 512, .sgpr_step = 8, .waves = 10, .is_rdna = false},
    gcn_3{.vgprs = 256, .vgpr_step = 4, .sgprs = 800, .sgpr_step = 16, .waves = 10, .is_rdna = false},
    tonga{.vgprs = 256, .vgpr_step = 4, .sgprs = 800, .sgpr_step = 96, .waves = 10, .is_rdna = false},
    polaris{.vgprs = 256, .vgpr_step = 4, .sgprs = 800, .sgpr_step = 16, .waves = 8, .is_rdna = false},
    rdna_1{.vgprs = 512, .vgpr_step = 4, .sgprs = 0, .sgpr_step = 0, .waves = 20, .is_rdna = true},
    rdna_2{.vgprs = 512, .vgpr_step = 8, .sgprs = 0, .sgpr_step = 0, .waves = 16, .is_rdna = true},
    rdna_3{.vgprs = 768, .vgpr_step = 12, .sgprs = 0, .sgpr_step = 0, .waves = 16, .is_rdna = true},
    rdna_4{
        .vgprs = 768, .vgpr_step = 12, .sgprs = 0, .sgpr_step = 0, .waves = 16, .is_rdna = true, .stated_vgprs = 512};

struct Generation {
    std::vector<std::string> chips;
    SimdLimits limits;
};
const std::vector<Generation> generations = {
    {{"tahiti", "pitcairn", "verde", "oland", "hainan", "bonaire", "kabini", "kaveri", "hawaii"}, gcn_1_2},
    {{"tonga", "iceland"}, tonga},  // whose waves have 96 scalar registers each, for a defect of the chip
    {{"carrizo", "fiji", "stoney", "vega10", "vega12", "vega20", "raven", "raven2", "renoir"}, gcn_3},
    {{"polaris10", "polaris11", "polaris12", "vegam"}, polaris},
    {{"navi10", "navi12", "navi14"}, rdna_1},
    // Smaller chips of the third generation have the register files of the second.
    {{"navi21", "navi22", "navi23", "navi24", "vangogh", "rembrandt", "gfx1036", "gfx1102", "navi33", "gfx1103_r1",
      "gfx1103_r2", "phoenix", "phoenix2", "raphael_mendocino", "gfx1150", "gfx1152", "gfx1153"},
     rdna_2},
    {{"gfx1100", "gfx1101", "navi31", "navi32"}, rdna_3},
    {{"gfx1151", "gfx1200", "gfx1201"}, rdna_4}};

uint64_t rounded_up(uint64_t count, uint64_t step) { return (std::max<uint64_t>(count, 1) + step - 1) / step * step; }

}  // namespace

std::optional<SimdLimits> simd_limits(const std::string& chip) {
    for (const Generation& generation : generations)
        if (std::ranges::count(generation.chips, chip)) return generation.limits;
    return {};
}

Occupancy occupancy_of(const std::string& chip, const CompiledShader& shader) {
    const std::optional<SimdLimits> simd = simd_limits(chip);
    if (!simd || !shader.waves || !shader.vgprs || !shader.sgprs || (shader.lanes != 32 && shader.lanes != 64))
        return {};
    const auto vgprs = uint64_t(*shader.vgprs), sgprs = uint64_t(*shader.sgprs), stated = uint64_t(*shader.waves);
    const unsigned halves = 64 / shader.lanes;  // waves of 32 lanes: twice as many registers
    const uint64_t by_vgprs = uint64_t(simd->vgprs) * halves / rounded_up(vgprs, simd->vgpr_step * halves),
                   by_sgprs = simd->sgprs ? simd->sgprs / rounded_up(sgprs, simd->sgpr_step) : simd->waves;
    const uint64_t stated_for_each = simd->is_rdna ? shader.lanes / 32 : 1;
    uint64_t waves = stated / stated_for_each;
    if (const unsigned step = simd->stated_vgprs / 64 * halves;  // RDNA's from the second on
        step && waves == simd->stated_vgprs * halves / rounded_up(vgprs, step))
        waves = by_vgprs;
    Occupancy occupancy{.waves = unsigned(std::min<uint64_t>(waves, simd->waves)), .most = simd->waves, .limit = ""};
    if (*occupancy.waves >= simd->waves)
        occupancy.limit = "nothing";
    else if (*occupancy.waves == by_vgprs)
        occupancy.limit = "registers";
    else if (*occupancy.waves == by_sgprs)
        occupancy.limit = "scalar registers";
    else if (*occupancy.waves < std::min(by_vgprs, by_sgprs) && shader.lds_bytes.value_or(0) > 0)
        occupancy.limit = "shared memory";
    return occupancy;
}
