#include "tests/experiments/bridges/gate_study/defects.h"

#include "core/number_text.h"

#include <algorithm>
#include <cmath>

namespace {

using Frames = std::vector<HostImage>;

template <class Change>
Frames each(const PlayedFrames& played, const Change& change) {
    Frames frames = played.shown;
    for (size_t t = 0; t < frames.size(); ++t) change(frames[t], t);
    return frames;
}

float value_at(const HostImage& image, int x, int y, unsigned c) {
    x = std::clamp(x, 0, int(image.extent.x) - 1), y = std::clamp(y, 0, int(image.extent.y) - 1);
    return image.values[(size_t(y) * image.extent.x + size_t(x)) * 3 + c];
}

template <class Value>
HostImage made_of(const HostImage& image, const Value& value) {
    HostImage made = image;
    for (int y = 0; y < int(image.extent.y); ++y)
        for (int x = 0; x < int(image.extent.x); ++x)
            for (unsigned c = 0; c < 3; ++c)
                made.values[(size_t(y) * image.extent.x + size_t(x)) * 3 + c] = value(x, y, c);
    return made;
}

HostImage gaussian(const HostImage& image, float sigma) {
    const int radius = int(std::ceil(3 * sigma));
    std::vector<float> weights;
    float sum = 0;
    for (int i = -radius; i <= radius; ++i)
        weights.push_back(std::exp(-float(i * i) / (2 * sigma * sigma))), sum += weights.back();
    const auto along = [&](const HostImage& from, int dx, int dy) {
        return made_of(from, [&](int x, int y, unsigned c) {
            float value = 0;
            for (int i = -radius; i <= radius; ++i)
                value += weights[size_t(i + radius)] / sum * value_at(from, x + i * dx, y + i * dy, c);
            return value;
        });
    };
    return along(along(image, 1, 0), 0, 1);
}

/// The mean of the 2^level x 2^level pixels that share a texel of this mip.
HostImage mip(const HostImage& image, int level) {
    const int size = 1 << level;
    return made_of(image, [&](int x, int y, unsigned c) {
        float value = 0;
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) value += value_at(image, x / size * size + i, y / size * size + j, c);
        return value / float(size * size);
    });
}

HostImage blend(const HostImage& a, const HostImage& b, float share_of_b) {
    HostImage mixed = a;
    for (size_t i = 0; i < mixed.values.size(); ++i) mixed.values[i] += share_of_b * (b.values[i] - a.values[i]);
    return mixed;
}

/// Replaces pixels that `is_lost` chooses by what shows without screen-space reflections.
template <class IsLost>
Frames with_lost(const PlayedFrames& played, std::mt19937& random, float share, const IsLost& may_be_lost) {
    std::uniform_real_distribution<float> uniform;
    return each(played, [&](HostImage& frame, size_t t) {
        for (size_t p = 0; p < frame.pixel_count(); ++p)
            if (may_be_lost(t, p) && uniform(random) < share) frame.set_rgb(p, played.missed[t].rgb(p));
    });
}

}  // namespace

std::vector<Defect> all_defects() {
    std::vector<Defect> all;
    for (const float a : {0.05f, 0.1f, 0.2f, 0.4f})
        all.push_back({"ghost trails", percent_text(a) + " of the light of two frames ago",
                       [a](const PlayedFrames& played, std::mt19937&) {
                           return each(played, [&](HostImage& frame, size_t t) {
                               const HostImage& old = played.shown[t < 2 ? 0 : t - 2];
                               for (size_t i = 0; i < frame.values.size(); ++i)
                                   frame.values[i] += a * std::max(0.0f, old.values[i] - frame.values[i]);
                           });
                       }});
    for (const float a : {0.05f, 0.1f, 0.2f, 0.4f})
        all.push_back({"lagging history", "weight " + percent_text(a) + " of the last frame",
                       [a](const PlayedFrames& played, std::mt19937&) {
                           Frames frames = played.shown;
                           for (size_t t = 1; t < frames.size(); ++t) frames[t] = blend(frames[t], frames[t - 1], a);
                           return frames;
                       }});
    for (const float a : {0.01f, 0.02f, 0.05f, 0.1f})
        all.push_back({"flicker", "brightness +-" + percent_text(a), [a](const PlayedFrames& played, std::mt19937&) {
                           return each(played, [&](HostImage& frame, size_t t) {
                               for (float& v : frame.values) v *= t % 2 ? 1 + a : 1 - a;
                           });
                       }});
    for (const float a : {0.1f, 0.25f, 0.5f, 1.0f})
        all.push_back(
            {"shifted reflection", percent_text(a) + " of a pixel", [a](const PlayedFrames& played, std::mt19937&) {
                 return each(played, [&](HostImage& frame, size_t) {
                     const HostImage from = frame;
                     frame = made_of(from, [&](int x, int y, unsigned c) {
                         return (1 - a) * value_at(from, x, y, c) + a * value_at(from, x - 1, y, c);
                     });
                 });
             }});
    for (const float a : {0.25f, 0.5f, 1.0f, 2.0f})
        all.push_back(
            {"too blurred a mip", percent_text(a) + " of a level", [a](const PlayedFrames& played, std::mt19937&) {
                 return each(played, [&](HostImage& frame, size_t) {
                     frame = a > 1 ? mip(frame, 2) : blend(frame, mip(frame, 1), a);
                 });
             }});
    for (const float a : {0.005f, 0.02f, 0.05f, 0.2f})
        all.push_back(
            {"missing rays", percent_text(a) + " of the pixels", [a](const PlayedFrames& played, std::mt19937& random) {
                 return with_lost(played, random, a, [&](size_t t, size_t p) { return played.reflects[t][p]; });
             }});
    for (const float a : {0.01f, 0.02f, 0.05f, 0.1f})
        all.push_back({"too bright", percent_text(a), [a](const PlayedFrames& played, std::mt19937&) {
                           return each(played, [&](HostImage& frame, size_t) {
                               for (float& v : frame.values) v *= 1 + a;
                           });
                       }});
    for (const float sigma : {0.5f, 1.0f})
        all.push_back({"wrong roughness", "blurred by " + percent_text(sigma) + " of a pixel",
                       [sigma](const PlayedFrames& played, std::mt19937&) {
                           return each(played, [&](HostImage& frame, size_t) { frame = gaussian(frame, sigma); });
                       }});
    for (const float a : {0.5f, 1.0f})
        all.push_back(
            {"wrong roughness", "sharpened by " + percent_text(a), [a](const PlayedFrames& played, std::mt19937&) {
                 return each(played, [&](HostImage& frame, size_t) { frame = blend(frame, gaussian(frame, 1), -a); });
             }});
    for (const float a : {0.1f, 0.25f, 0.5f, 1.0f})
        all.push_back({"holes where surfaces appear", percent_text(a) + " of these pixels",
                       [a](const PlayedFrames& played, std::mt19937& random) {
                           return with_lost(played, random, a, [&](size_t t, size_t p) { return played.is_new[t][p]; });
                       }});
    return all;
}
