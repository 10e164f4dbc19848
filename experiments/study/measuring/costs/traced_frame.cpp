#include "experiments/study/measuring/costs/traced_frame.h"

#include "core/gpu/device.h"
#include "experiments/gpu_costs/waves/pass_tracer.h"
#include "experiments/study/measuring/costs/played_shot.h"
#include "variants/registry.h"

#include <tbb/parallel_for.h>

namespace {

constexpr std::array wave_widths = {32u, 64u};

TracedFrame::Pass traced_pass(const PassTrace& trace) {
    TracedFrame::Pass pass{.stage = trace.stage,
                           .original = trace.original,
                           .recipe = trace.recipe,
                           .flow = flow_of(trace.recipe),
                           .groups = trace.layout.groups,
                           .traced = {}};
    for (const unsigned width : wave_widths) {
        std::vector<WaveCounts>& groups = pass.traced[width];
        groups.resize(trace.layout.chosen);
        tbb::parallel_for(0u, trace.layout.chosen, [&](unsigned place) {
            groups[place] = replay(pass.flow, lanes_of(trace.layout, trace.content, place), width);
        });
    }
    return pass;
}

}  // namespace

TracedFrame trace_last_frame(Device& device, const Shot& shot, FrameStore& store,
                             const std::function<const HostImage&(const FrameStep&)>& lit, const PointConfig& point,
                             bool keep_all, const std::function<void(double)>& report) {
    TracedFrame result;
    const auto keep = [&](const PassTrace& trace) {
        result.pipelines.add(trace.stage, trace.original);
        result.passes.push_back(traced_pass(trace));
    };
    for (const bool is_traced : {false, true}) {
        const std::unique_ptr<Technique> technique = make_technique(point.technique, point.parameters, point.preset);
        if (technique->uses_scene_data()) return {};
        if (!keep_all) technique->leave_out(shot.facts);
        PassList pass_list(device, shot.config.extent);
        pass_list.use_gpu_forms(true);
        CostCounter counter;
        if (is_traced) result.pipelines.collect_from(pass_list);
        PassTracer tracer(keep);
        const auto watch = [&] { pass_list.watch(is_traced ? static_cast<PassWatcher*>(&tracer) : &counter); };
        play_shot(pass_list, *technique, shot, store, lit, point, watch,
                  [&](double share) { report((double(is_traced) + share) / 2); });
        if (is_traced) continue;
        result.costs = counter.costs();
        result.is_of_gpu_forms = technique->has_gpu_forms();
    }
    return result;
}
