#include "experiments/gpu_costs/chips/model_range.h"

#include <cstdio>

std::string model_range_text() {
    char text[160];
    std::snprintf(text, sizeof text,
                  "measured times of stages were %.3g to %.3g times such estimates (NVIDIA H200, gpu_measured)",
                  model_range.low, model_range.high);
    return text;
}
