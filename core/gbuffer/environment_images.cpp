#include "core/gbuffer/environment_images.h"

namespace {

/// rgba32f of an RGB image; a black texel stands for an image that is not needed.
Image upload_rgb(PassList& pass_list, const std::string& name, const HostImage& rgb) {
    HostImage rgba(glm::max(rgb.extent, glm::uvec2(1)), 4);
    for (size_t i = 0; i < rgb.pixel_count(); ++i) rgba.set_rgb(i, rgb.rgb(i));
    const Image image = pass_list.image_of(name, Format::rgba32f, rgba.extent);
    pass_list.upload(image, rgba);
    return image;
}

}  // namespace

EnvironmentImages::EnvironmentImages(PassList& pass_list, const Environment& environment, bool prefilter)
    : environment_(environment),
      prefiltered_(prefilter ? prefilter_environment(environment) : PrefilteredEnvironment{}) {
    sharp_ = upload_rgb(pass_list, "environment",
                        environment.type == Environment::Type::image ? environment.latlong : HostImage());
    atlas_ = upload_rgb(pass_list, "prefiltered_environment", prefiltered_.atlas);
}

PassList::Pass& EnvironmentImages::bind(PassList::Pass& pass) const { return bind_sharp(pass).read(atlas_); }

PassList::Pass& EnvironmentImages::bind_rays(PassList::Pass& pass) const {
    compile_in(pass, unsigned(environment_.type));
    return bind_sharp(pass);
}

PassList::Pass& EnvironmentImages::bind_sharp(PassList::Pass& pass) const {
    return pass.read(sharp_)
        .set("environment_type", unsigned(environment_.type))
        .set("environment_rotation", environment_.rotation)
        .set("environment_color", glm::vec4(environment_.color, 0))
        .set("environment_slope", glm::vec4(environment_.slope, 0))
        .set("environment_axis", glm::vec4(environment_.axis, 0));
}

void EnvironmentImages::compile_in(PassList::Pass& pass, unsigned kind) {
    pass.include("core/shaders/gbuffer/environment_kind.glsl",
                 "const uint any_environment = 4u, environment_kind = " + std::to_string(kind) + "u;\n");
}

PassList::Pass& bind_environment(PassList::Pass& pass, const GBuffer& gbuffer) {
    if (gbuffer.environment) return gbuffer.environment->bind_rays(pass);
    const unsigned type_of_file = 3;
    const glm::vec4 unused(0);
    EnvironmentImages::compile_in(pass, type_of_file);
    return pass.read(gbuffer.fallback.as("environment"))
        .set("environment_type", type_of_file)
        .set("environment_rotation", 0.0f)
        .set("environment_color", unused)
        .set("environment_slope", unused)
        .set("environment_axis", unused);
}
