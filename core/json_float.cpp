#include "core/json_float.h"

#include "core/error.h"
#include "core/json.h"

#include <cmath>
#include <limits>

float float_of(const nlohmann::json& number, const std::string& what) {
    constexpr float largest = std::numeric_limits<float>::max();
    const auto value = float(number.get<double>());
    if (!std::isfinite(value))
        fail(what, " has the number ", shown(number), " outside of [", -largest, ", ", largest,
             "], all that float32 can hold");
    return value;
}
