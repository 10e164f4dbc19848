#include "experiments/study/measuring/costs/costs.h"

#include "core/gpu/device.h"
#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/study/measuring/costs/played_shot.h"
#include "variants/registry.h"

std::vector<CostRow> count_costs(Device& device, const Shot& shot, FrameStore& store,
                                 const std::function<const HostImage&(const FrameStep&)>& lit,
                                 const VariantConfig& config, bool keep_all,
                                 const std::function<void(double)>& report) {
    const std::unique_ptr<Variant> variant = make_variant(config.variant, config.parameters, config.preset);
    if (variant->uses_scene_data()) return {};
    if (!keep_all) variant->leave_out(shot.facts);
    PassGraph graph(device, shot.config.extent);
    CostCounter counter;
    play_shot(
        graph, *variant, shot, store, lit, config, [&] { graph.watch(&counter); }, report);

    std::vector<PassCost> costs = counter.costs();
    PassCost total{.stage = "total"};
    for (const PassCost& cost : costs) total.add(cost);
    costs.push_back(total);
    std::vector<CostRow> rows;
    for (const PassCost& cost : costs)
        for (const CostQuantity& quantity : cost_quantities)
            rows.push_back({.shot = shot.name(),
                            .variant = config.variant,
                            .point = config.point,
                            .stage = cost.stage,
                            .quantity = quantity.name,
                            .value = cost.*quantity.member});
    return rows;
}
