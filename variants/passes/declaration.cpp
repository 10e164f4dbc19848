#include "variants/passes/declaration.h"

#include "core/error.h"

#include <bit>
#include <cmath>

unsigned DeclaredImage::mips_of(glm::uvec2 extent) const {
    if (mips_until == Mips::count) return mips;
    const unsigned side = mips_until == Mips::all ? std::max(extent.x, extent.y) : std::min(extent.x, extent.y);
    return unsigned(std::bit_width(side));
}

const DeclaredForm& DeclaredPass::form(const KnownValues& known) const {
    const DeclaredForm* found = first_that_holds(forms, known);
    return found ? *found : forms.back();
}

float alpha_of_8_bits(float alpha) { return std::floor(alpha * 255.0f + 0.5f) / 255.0f; }
float roughness_of_8_bits(float perceptual) { return std::floor(perceptual * 255.0f + 0.5f) * (1.0f / 255.0f); }

bool RoughnessLimit::excludes_all_from(float roughness, const KnownValues& known) const {
    const float limit = known.by_name().at(parameter).get<float>();
    float smoothest = is_alpha ? roughness * roughness : roughness;
    if (is_of_8_bits) smoothest = is_alpha ? alpha_of_8_bits(smoothest) : roughness_of_8_bits(smoothest);
    return is_excluded ? smoothest >= limit : smoothest > limit;
}

std::string RoughnessLimit::surfaces_within() const {
    return (is_alpha ? "below " : is_excluded ? "smoother than " : "as smooth as ") + parameter;
}

bool names_device(const nlohmann::json& written) {
    return written.dump().find("\"device.is_gpu\"") != std::string::npos;
}

KnownValues Declaration::known_values(const ParameterSet& params, const std::optional<SceneFacts>& facts) const {
    KnownValues known(params, facts);
    known.derive(conditions);
    return known;
}

std::vector<const DeclaredPass*> Declaration::passes_in_use(const KnownValues& known) const {
    const auto is_left_out = [&](const DeclaredPass& pass) {
        return known.knows_shot() && std::ranges::any_of(pass.left_out, [&](const DeclaredLeftOut& one) {
                   return one.part.empty() && one.when.holds(known);
               });
    };
    std::vector<const DeclaredPass*> found;
    for (const DeclaredPass& pass : passes)
        if (pass.when.holds(known) && !is_left_out(pass)) found.push_back(&pass);
    return found;
}

std::vector<std::string> Declaration::readers_of(const std::string& scene_constant, const KnownValues& known) const {
    std::vector<std::string> stages;
    for (const DeclaredPass* pass : passes_in_use(known))
        if (const auto found = pass->scene_constants.find(scene_constant);
            found != pass->scene_constants.end() && found->second.holds(known))
            stages.push_back(pass->stage);
    return stages;
}
