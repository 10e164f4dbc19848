#include "experiments/study/measuring/costs/costs.h"

#include "core/gpu/device.h"
#include "experiments/study/measuring/costs/played_shot.h"
#include "variants/registry.h"

std::vector<CostRow> cost_rows(std::vector<PassCost> costs, const std::string& shot, const PointConfig& point) {
    if (costs.empty()) return {};
    PassCost total{.stage = "total"};
    for (const PassCost& cost : costs) total.add(cost);
    costs.push_back(total);
    std::vector<CostRow> rows;
    for (const PassCost& cost : costs)
        for (const CostQuantity& quantity : cost_quantities)
            rows.push_back({.shot = shot,
                            .technique = point.technique,
                            .point = point.point,
                            .stage = cost.stage,
                            .quantity = quantity.name,
                            .value = cost.*quantity.member});
    return rows;
}

std::vector<CostRow> count_costs(Device& device, const Shot& shot, FrameStore& store,
                                 const std::function<const HostImage&(const FrameStep&)>& lit,
                                 const PointConfig& config, bool keep_all, const std::function<void(double)>& report) {
    const std::unique_ptr<Technique> technique = make_technique(config.technique, config.parameters, config.preset);
    if (technique->uses_scene_data()) return {};
    if (!keep_all) technique->leave_out(shot.facts);
    PassList pass_list(device, shot.config.extent);
    CostCounter counter;
    play_shot(
        pass_list, *technique, shot, store, lit, config, [&] { pass_list.watch(&counter); }, report);

    return cost_rows(counter.costs(), shot.name(), config);
}
