#include "core/gbuffer/rasterizer.h"

#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "core/shared/drawn_light.h"

struct Rasterizer::Frame {
    ScenePose scene, previous_scene;
    CameraData camera;
};

namespace {

Format format_of(DepthFormat format) {
    return format == DepthFormat::d32f ? Format::d32f : format == DepthFormat::d24 ? Format::d24 : Format::d16;
}

/// What a fragment says of the surface that it shows.
PassList::Pass& write_surface(PassList::Pass& pass, const GBuffer& g) {
    for (const Image& image : {g.geometric_normal, g.normal, g.base_color, g.emission, g.motion, g.material_id})
        pass.write(image);
    return pass;
}

DepthTest nearest_in(const Image& depth_buffer, const CameraData& camera) {
    const bool is_reversed = camera.depth.w == 1;
    return {.compare = is_reversed ? DepthTest::Compare::greater : DepthTest::Compare::less,
            .is_written = true,
            .image = depth_buffer};
}

Buffer upload_lights(PassList& pass_list, const std::vector<PunctualLight>& lights) {
    std::vector<DrawnLight> drawn;
    for (const PunctualLight& light : lights)
        drawn.push_back({.intensity_type = {light.intensity, float(light.type)},
                         .position_range = {light.position, light.range},
                         .direction_outer = {light.direction, light.outer_cone_cos},
                         .inner_cone = {light.inner_cone_cos, 0, 0, 0}});
    const Buffer buffer = pass_list.buffer("Lights", std::max<size_t>(drawn.size(), 1) * sizeof(DrawnLight));
    if (!drawn.empty()) pass_list.upload(buffer, std::as_bytes(std::span(drawn)));
    return buffer;
}

}  // namespace

std::vector<LeftOut> left_out_of_rasterizer(const SceneFacts& facts) {
    if (!facts.has_geometry)
        return {{"drawing", "no geometry", "There is no triangle to draw."},
                {"prefiltered environment", "no geometry", "No surface reflects the environment."}};
    std::vector<LeftOut> parts;
    if (!facts.has_textures) parts.push_back({"texture reads", "no textures", "All materials are constant."});
    if (facts.has_textures && !facts.has_normal_maps)
        parts.push_back({"normal maps", "no normal maps", "All normals are the geometry's."});
    if (!facts.has_vertex_colors) parts.push_back({"vertex colours", "no vertex colours", "All are white."});
    if (!facts.has_alpha_masks) parts.push_back({"alpha tests", "no alpha masks", "No fragment is discarded."});
    if (facts.is_still()) parts.push_back({"motion vectors", "nothing moves", "All are 0."});
    if (!facts.has_reflective)
        parts.push_back({"fallback", "nothing reflective", "Its weight in the composite is 0."});
    else if (!facts.has_environment)
        parts.push_back({"fallback", "black environment", "It is black."});
    if (!facts.has_environment) parts.push_back({"prefiltered environment", "black environment", "It is black."});
    return parts;
}

Rasterizer::Rasterizer(Device& device, const Scene& scene, const RasterizerOptions& options)
    : scene_(scene),
      options_(options),
      facts_(material_facts(scene)),
      pass_list_(device, options.extent),
      drawn_(pass_list_, scene, facts_.has_dielectric_f0, options.keep_all),
      environment_(pass_list_, reflected_environment(),
                   options.keep_all || (facts_.has_geometry && !reflected_environment().is_black())) {
    facts_.has_environment = !reflected_environment().is_black();
    if (!device.supports(format_of(options.depth_format)))
        fail_machine("the device ", device.info().name, " has no depth format ",
                     name_of(format_of(options.depth_format)), "; choose d32f or d16");
}

const Environment& Rasterizer::reflected_environment() const {
    return options_.probe ? *options_.probe : scene_.environment;
}

bool Rasterizer::needs_fallback() const {
    return options_.keep_all || (facts_.has_geometry && facts_.has_reflective && facts_.has_environment);
}

Rasterizer::Frame Rasterizer::pose(const SceneCamera& camera, const FrameView& view) const {
    Frame frame{.scene = pose_scene(scene_, float(view.frame))};
    const CameraPose now = pose_camera(camera, frame.scene, float(view.frame));
    const std::optional<unsigned> predecessor = view.predecessor();
    const float earlier = float(predecessor.value_or(view.frame));
    frame.previous_scene = pose_scene(scene_, earlier);
    const CameraPose before = pose_camera(camera, frame.previous_scene, earlier);
    frame.camera = camera_data(now, predecessor ? &before : nullptr, view);
    return frame;
}

GBuffer Rasterizer::render(const SceneCamera& camera, const FrameView& view) {
    if (view.extent != options_.extent)
        fail("a frame of ", view.extent.x, " x ", view.extent.y, " does not fit a rasteriser of ", options_.extent.x,
             " x ", options_.extent.y);
    const std::optional<unsigned> predecessor = view.predecessor();
    const bool follows = last_camera_ == &camera && last_view_.frame == predecessor &&
                         last_view_.jitter == view.previous_jitter &&
                         last_view_.depth_direction == view.depth_direction;
    if (predecessor && !follows) {
        FrameView before = view;
        before.frame = *predecessor;
        before.jitter = view.previous_jitter;
        draw(pose(camera, before));
    }
    GBuffer gbuffer = draw(pose(camera, view));
    if (!predecessor) {
        gbuffer.previous_depth = gbuffer.depth.as("previous_depth");
        gbuffer.previous_normal = gbuffer.normal.as("previous_normal");
    }
    last_camera_ = &camera;
    last_view_ = view;
    pass_list_.times();  // waits for the device, so that other graphs may read the images
    return gbuffer;
}

GBuffer Rasterizer::draw(const Frame& frame) {
    camera_ = frame.camera;
    scene_pose_ = frame.scene;
    pass_list_.begin_frame(camera_, no_params_, {});
    if (!options_.keep_all)
        pass_list_.set_constants({{"scene_is_still", options_.is_still},
                                  {"scene_has_environment", facts_.has_environment},
                                  {"scene_has_normal_maps", facts_.has_normal_maps},
                                  {"scene_has_vertex_colors", facts_.has_vertex_colors}});
    drawn_.pose(frame.scene, frame.previous_scene);
    const PassList::History depth = pass_list_.history("depth", Format::r32f),
                            normal = pass_list_.history("normal", Format::rgba32f);
    GBuffer g{.depth = depth.current,
              .geometric_normal = pass_list_.image("geometric_normal", Format::rgba32f),
              .normal = normal.current,
              .base_color = pass_list_.image("base_color", Format::rgba32f),
              .emission = pass_list_.image("emission", Format::rgba32f),
              .motion = pass_list_.image("motion", Format::rg32f),
              .material_id = pass_list_.image("material_id", Format::r32ui),
              .previous_depth = depth.previous,
              .previous_normal = normal.previous,
              .lit = pass_list_.image("lit", Format::rgba32f),
              .fallback = pass_list_.image("fallback", Format::rgba32f),
              .dielectric_f0 = facts_.has_dielectric_f0 ? pass_list_.image("dielectric_f0", Format::rgba32f)
                                                        : one_dielectric_f0(pass_list_),
              .has_dielectric_f0 = facts_.has_dielectric_f0,
              .environment = &environment_};
    if (g.has_dielectric_f0) pass_list_.clear(g.dielectric_f0, glm::vec4(0));

    const Image depth_buffer = pass_list_.image("depth_buffer", format_of(options_.depth_format));
    pass_list_.clear(depth_buffer, glm::vec4(camera_.depth.z, 0, 0, 0));
    auto background = pass_list_.fragment("gbuffer/background.frag");
    write_surface(background, g).run();
    draw_kind(g, depth_buffer, DrawnScene::Kind::plain, "plain");
    draw_kind(g, depth_buffer, DrawnScene::Kind::textured, g.has_dielectric_f0 ? "dielectric" : "textured");
    draw_kind(g, depth_buffer, DrawnScene::Kind::masked, g.has_dielectric_f0 ? "dielectric_masked" : "masked");
    pass_list_.fragment("gbuffer/copy_depth.frag").read(depth_buffer).write(g.depth).run();

    if (options_.has_depth_layers) draw_depth_layers(g);

    if (needs_fallback()) {
        auto pass = pass_list_.compute("gbuffer/fallback.comp");
        environment_.bind(pass).read(g.depth).read(g.normal).write(g.fallback).run();
    } else {
        pass_list_.clear(g.fallback, glm::vec4(0));
    }
    pass_list_.clear(g.lit, glm::vec4(0));
    return g;
}

void Rasterizer::draw_kind(const GBuffer& g, const Image& depth_buffer, DrawnScene::Kind kind, const char* name) {
    if (drawn_.draws(kind).empty()) return;
    auto pass = pass_list_.draw("gbuffer/mesh.vert", std::string("gbuffer/") + name + ".frag", drawn_.draws(kind));
    if (g.has_dielectric_f0) pass.write(g.dielectric_f0);
    write_surface(pass, g)
        .depth(nearest_in(depth_buffer, camera_))
        .set("normal_bits", options_.normal_bits)
        .label(std::string("gbuffer/draw_") + name)
        .run();
}

void Rasterizer::draw_depth_layers(GBuffer& g) {
    g.second_depth = pass_list_.image("second_depth", Format::r32f);
    g.back_depth = pass_list_.image("back_depth", Format::r32f);
    pass_list_.fragment("gbuffer/no_layers.frag").read(g.depth).write(g.second_depth).write(g.back_depth).run();
    const Image depth_buffer = pass_list_.image("second_depth_buffer", Format::d32f);
    pass_list_.clear(depth_buffer, glm::vec4(camera_.depth.z, 0, 0, 0));
    // What the depth buffer rounds: half a step of its codes, and as much again for rounding on the way.
    const float depth_step = options_.depth_format == DepthFormat::d32f  ? 0.0f
                             : options_.depth_format == DepthFormat::d24 ? 0x1p-24f
                                                                         : 0x1p-16f;
    for (const DrawnScene::Kind kind :
         {DrawnScene::Kind::plain, DrawnScene::Kind::textured, DrawnScene::Kind::masked}) {
        if (drawn_.draws(kind).empty()) continue;
        const bool is_masked = kind == DrawnScene::Kind::masked;
        pass_list_
            .draw("gbuffer/mesh.vert", is_masked ? "gbuffer/peel_masked.frag" : "gbuffer/peel.frag", drawn_.draws(kind))
            .read(g.depth)
            .write(g.second_depth)
            .write(g.back_depth)
            .set("depth_step", depth_step)
            .depth(nearest_in(depth_buffer, camera_))
            .label("gbuffer/draw_layers")
            .run();
    }
}

void Rasterizer::light_directly(const GBuffer& g) {
    const Buffer lights = upload_lights(pass_list_, scene_pose_.lights);
    const Buffer count = pass_list_.buffer("LightCount", sizeof(uint32_t));
    pass_list_.clear(count, uint32_t(scene_pose_.lights.size()));
    auto pass = pass_list_.compute("gbuffer/lit_direct.comp");
    environment_.bind(pass).use(lights).use(count);
    for (const Image& image : {g.depth, g.geometric_normal, g.normal, g.base_color, g.emission, g.dielectric_f0})
        pass.read(image);
    pass.write(g.lit).run();
    pass_list_.times();
}

void Rasterizer::upload_lit(const GBuffer& g, const HostImage& rgb) {
    if (rgb.extent != options_.extent || rgb.channels < 3)
        fail("the lit colour is ", rgb.extent.x, " x ", rgb.extent.y, " with ", rgb.channels,
             " channels, but the G-buffer is ", options_.extent.x, " x ", options_.extent.y, " and needs 3");
    HostImage rgba(rgb.extent, 4);
    for (size_t i = 0; i < rgb.pixel_count(); ++i) rgba.set_rgb(i, rgb.rgb(i));
    pass_list_.upload(g.lit, rgba);
}
