#include "experiments/results/files/targets.h"

const std::vector<std::string>& target_names() {
    static const std::vector<std::string> names = {"specular", "image", "incident", "camera_radiance", "on_screen"};
    return names;
}

bool is_ladder_rung(const std::string& target) { return target == "camera_radiance" || target == "on_screen"; }
