#include "core/scene/animation.h"

#include "core/scene/transform.h"

#include <algorithm>
#include <cmath>

namespace {
using Property = AnimationChannel::Property;

/// glTF 2.0, appendix C.5: tangents are in units per second, hence scaled by the distance of the keys.
glm::vec4 cubic_spline(const AnimationChannel& channel, size_t key, float t, float seconds) {
    const glm::vec4 value = channel.values[key * 3 + 1], out_tangent = seconds * channel.values[key * 3 + 2];
    const glm::vec4 in_tangent = seconds * channel.values[key * 3 + 3], next = channel.values[key * 3 + 4];
    const float t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * value + (t3 - 2 * t2 + t) * out_tangent + (-2 * t3 + 3 * t2) * next +
           (t3 - t2) * in_tangent;
}

glm::vec4 key_value(const AnimationChannel& channel, size_t key) {
    return channel.values[channel.interpolation == Interpolation::cubic_spline ? key * 3 + 1 : key];
}

glm::vec4 interpolate(const AnimationChannel& channel, float time) {
    const auto after = std::ranges::upper_bound(channel.times, time);
    if (after == channel.times.begin()) return key_value(channel, 0);
    const auto key = size_t(after - channel.times.begin()) - 1;
    if (after == channel.times.end() || channel.interpolation == Interpolation::step) return key_value(channel, key);
    const float seconds = channel.times[key + 1] - channel.times[key];
    const float t = (time - channel.times[key]) / seconds;
    if (channel.interpolation == Interpolation::cubic_spline) return cubic_spline(channel, key, t, seconds);
    const glm::vec4 from = channel.values[key], to = channel.values[key + 1];
    return channel.property == Property::rotation ? slerp(glm::normalize(from), glm::normalize(to), t)
                                                  : glm::mix(from, to, t);
}
}  // namespace

glm::vec4 sample_channel(const AnimationChannel& channel, float time) {
    const glm::vec4 value = interpolate(channel, time);
    return channel.property == Property::rotation ? glm::normalize(value) : value;
}

unsigned animation_frames(const Scene& scene) {
    float last = 0.0f;
    for (const AnimationChannel& channel : scene.animation) last = std::max(last, channel.times.back());
    const float frames =
        std::floor(last * scene.frame_rate + 1e-3f);  // a last key at 2.9999 s is meant to be a whole frame
    return 1 + unsigned(std::clamp(frames, 0.0f, 1e6f));
}
