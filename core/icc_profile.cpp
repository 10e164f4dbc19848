#include "core/icc_profile.h"

#include "core/png.h"

#include <lcms2.h>
#include <algorithm>
#include <cmath>
#include <memory>

namespace {

using Profile = std::shared_ptr<void>;

Profile owned(cmsHPROFILE profile) {
    return {profile, [](void* p) {
                if (p) cmsCloseProfile(p);
            }};
}

Profile linear_rec709() {
    const cmsCIExyY white{0.3127, 0.3290, 1};
    const cmsCIExyYTRIPLE primaries{{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};
    const std::unique_ptr<cmsToneCurve, void (*)(cmsToneCurve*)> line(cmsBuildGamma(nullptr, 1.0), cmsFreeToneCurve);
    cmsToneCurve* const curves[] = {line.get(), line.get(), line.get()};
    return owned(cmsCreateRGBProfile(&white, &primaries, curves));
}

/// Whether codes on a grid become what sRGB's do.
bool is_srgb(const std::function<void(std::span<glm::vec3>)>& to_linear, bool is_grey) {
    constexpr int steps = 8;
    constexpr float half_a_code = 0.5f / 255;
    for (int r = 0; r <= steps; ++r)
        for (int g = 0; g <= (is_grey ? 0 : steps); ++g)
            for (int b = 0; b <= (is_grey ? 0 : steps); ++b) {
                const glm::vec3 code = glm::vec3(r, is_grey ? r : g, is_grey ? r : b) / float(steps);
                glm::vec3 light = code;
                to_linear({&light, 1});
                for (int c = 0; c < 3; ++c)
                    if (!(std::abs(srgb_from_linear(light[c]) - code[c]) <= half_a_code)) return false;
            }
    return true;
}

}  // namespace

std::optional<IccProfile> read_icc_profile(std::span<const uint8_t> bytes) {
    cmsSetLogErrorHandler([](cmsContext, cmsUInt32Number, const char*) {});
    const Profile profile = owned(cmsOpenProfileFromMem(bytes.data(), cmsUInt32Number(bytes.size())));
    if (!profile) return {};
    const cmsColorSpaceSignature space = cmsGetColorSpace(profile.get());
    const bool is_grey = space == cmsSigGrayData;
    if (!is_grey && space != cmsSigRgbData) return {};
    const Profile target = linear_rec709();
    // Unoptimised, since only so are floats kept beyond [0, 1] and small codes exact.
    const std::shared_ptr<void> transform(
        target ? cmsCreateTransform(profile.get(), is_grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT, target.get(), TYPE_RGB_FLT,
                                    INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE | cmsFLAGS_NOCACHE)
               : nullptr,
        [](void* t) {
            if (t) cmsDeleteTransform(t);
        });
    if (!transform) return {};
    IccProfile result;
    char name[256] = {};
    cmsGetProfileInfoASCII(profile.get(), cmsInfoDescription, "en", "US", name, sizeof name);
    result.name = name;
    result.to_linear = [transform, is_grey](std::span<glm::vec3> row) {
        if (!is_grey) return cmsDoTransform(transform.get(), row.data(), row.data(), cmsUInt32Number(row.size()));
        for (glm::vec3& color : row) {
            const float code = color.x;
            cmsDoTransform(transform.get(), &code, &color, 1);
        }
    };
    result.is_srgb = is_srgb(result.to_linear, is_grey);
    return result;
}
