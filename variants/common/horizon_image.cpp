#include "variants/common/horizon_image.h"

#include "variants/common/ggx_lobe.h"
#include "variants/common/lobe_horizon.h"

#include <map>
#include <mutex>

namespace {

HostImage integrated(unsigned lobe, float bias) {
    const unsigned size = 64;
    HostImage table({size, size}, 1);
    for (unsigned y = 0; y < size; ++y)
        for (unsigned x = 0; x < size; ++x) {
            const float mu_o = (float(x) + 0.5f) / size, roughness = (float(y) + 0.5f) / size;
            *table.pixel(x, y) = float(share_below_horizon(lobe, mu_o, ggx_alpha(roughness), bias));
        }
    return table;
}

}  // namespace

const HostImage& horizon_table(unsigned lobe, float bias) {
    static std::mutex mutex;
    static std::map<std::pair<unsigned, float>, HostImage> tables;
    const std::scoped_lock lock(mutex);
    const auto [entry, is_new] = tables.try_emplace({lobe, bias});
    if (is_new) entry->second = integrated(lobe, bias);
    return entry->second;
}

Image HorizonImage::on(PassList& pass_list, const ParameterSet& params) {
    const nlohmann::json values = params.values();
    const Image image = pass_list.image_of("below_horizon", Format::r32f, {64, 64});
    const unsigned lobe = values.at("lobe") == "normals" ? lobe_of_normals : lobe_of_visible_normals;
    const auto bias = values.at("importance_bias").get<float>();
    if (uploaded_.lock() == image.storage && lobe == lobe_ && bias == bias_) return image;
    pass_list.upload(image, horizon_table(lobe, bias));
    uploaded_ = image.storage;
    lobe_ = lobe;
    bias_ = bias;
    return image;
}
