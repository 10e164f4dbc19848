#include "experiments/study/measuring/costs/played_shot.h"

#include "experiments/study/measuring/render_variant.h"

void play_shot(PassGraph& graph, Variant& variant, const Shot& shot, FrameStore& store,
               const std::function<const HostImage&(const FrameStep&)>& lit, const VariantConfig& point,
               const std::function<void()>& watch, const std::function<void(double)>& report) {
    for (const FrameStep& step : shot.steps) {
        if (&step == &shot.steps.back()) watch();
        const FrameStore::Frame frame = store.frame(step, lit(step));
        render_variant(graph, variant, frame.camera, point.seeds.front(), frame.gbuffer);
        graph.times();  // waits: the frame's images are gone with the next one
        report(double(&step - shot.steps.data() + 1) / double(shot.steps.size()));
    }
}
