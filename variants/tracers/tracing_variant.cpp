#include "variants/tracers/tracing_variant.h"

std::vector<LeftOut> TracingVariant::leave_out(const SceneFacts& facts) {
    const Needless needless = find_needless(facts);
    std::vector<LeftOut> left_out;
    constants_ = {};
    has_no_rays_ = needless.rays;
    if (needless.rays) {
        const std::string fact = facts.has_reflective ? "no reflective surface " + needless.such_a_surface
                                                      : std::string("nothing reflective");
        for (const std::string& stage : needless.stages)
            left_out.push_back({stage, fact, "no pixel would start a ray"});
    } else {
        left_out = needless.parts;
        constants_ = needless.constants;
        for (const std::string& stage : needless.motion_readers)
            if (facts.is_still()) left_out.push_back({"motion vectors", "nothing moves", "all are 0", stage});
        for (const std::string& stage : needless.environment_readers)
            if (!facts.has_environment)
                left_out.push_back({"environment", "black environment", "rays that meet nothing see black", stage});
        for (const std::string& stage : needless.specular_readers)
            if (!facts.has_matte)
                left_out.push_back(
                    {"specular factors", "no matte surface", "every surface has a specular term", stage});
        constants_["scene_has_matte"] = facts.has_matte;
        constants_["scene_is_still"] = facts.is_still();
        constants_["scene_has_environment"] = facts.has_environment;
    }
    is_sound_ = !facts.has_faulty_inputs;
    if (repair_inputs_ && is_sound_)
        left_out.push_back({RepairedInputs::stage, "no faulty inputs", "every pixel would keep its bits"});
    return left_out;
}
