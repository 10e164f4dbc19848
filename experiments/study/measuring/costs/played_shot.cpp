#include "experiments/study/measuring/costs/played_shot.h"

#include "experiments/study/measuring/render_technique.h"

void play_shot(PassList& pass_list, Technique& technique, const Shot& shot, FrameStore& store,
               const std::function<const HostImage&(const FrameStep&)>& lit, const PointConfig& point,
               const std::function<void()>& watch, const std::function<void(double)>& report) {
    for (const FrameStep& step : shot.steps) {
        if (&step == &shot.steps.back()) watch();
        const FrameStore::Frame frame = store.frame(step, lit(step));
        render_technique(pass_list, technique, frame.camera, point.seeds.front(), frame.gbuffer);
        pass_list.times();  // waits: the frame's images are gone with the next one
        report(double(&step - shot.steps.data() + 1) / double(shot.steps.size()));
    }
}
