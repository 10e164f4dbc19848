#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "variants/variant.h"

#include <functional>

/// Renders the frames of a shot with a variant point's first seed, so that histories are as in the shot; `watch` is
/// called before the last. `lit` gives the colour (RGB) that the variant reads; `report` gets the share done.
void play_shot(PassGraph& graph, Variant& variant, const Shot& shot, FrameStore& store,
               const std::function<const HostImage&(const FrameStep&)>& lit, const VariantConfig& point,
               const std::function<void()>& watch, const std::function<void(double)>& report);
