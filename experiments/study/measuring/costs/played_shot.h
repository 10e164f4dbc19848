#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "variants/common/technique.h"

#include <functional>

/// Renders all frames of a shot with a point's first seed, so that histories are as in the shot. `watch` is called
/// before the last frame. `lit` gives the colour (RGB) that the technique reads; `report` gets the share done.
void play_shot(PassList& pass_list, Technique& technique, const Shot& shot, FrameStore& store,
               const std::function<const HostImage&(const FrameStep&)>& lit, const PointConfig& point,
               const std::function<void()>& watch, const std::function<void(double)>& report);
