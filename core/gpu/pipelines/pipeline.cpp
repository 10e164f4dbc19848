#include "core/gpu/pipelines/pipeline.h"

#include "core/error.h"
#include "core/gpu/pipelines/shader_files.h"

namespace {

vk::DescriptorType descriptor_type(ShaderInterface::Kind kind) {
    using enum vk::DescriptorType;
    constexpr vk::DescriptorType types[] = {eCombinedImageSampler, eStorageImage, eUniformBuffer, eStorageBuffer};
    return types[size_t(kind)];  // in the order of Kind
}

vk::CompareOp compare_op(DepthTest::Compare compare) {
    using enum vk::CompareOp;
    constexpr vk::CompareOp operations[] = {eLess, eGreater, eLessOrEqual, eGreaterOrEqual, eEqual, eAlways};
    return operations[size_t(compare)];  // in the order of Compare
}

struct Stages {
    std::vector<vk::raii::ShaderModule> modules;
    std::vector<vk::PipelineShaderStageCreateInfo> infos;
};

Stages make_stages(const vk::raii::Device& device, const PipelineRecipe& recipe,
                   const vk::SpecializationInfo& constants) {
    Stages stages;
    for (const auto& spirv : recipe.spirv) {
        stages.modules.emplace_back(device,
                                    vk::ShaderModuleCreateInfo{.codeSize = spirv.size() * 4, .pCode = spirv.data()});
        const bool is_vertex = !recipe.is_compute && stages.modules.size() == 1;
        const auto stage = recipe.is_compute ? vk::ShaderStageFlagBits::eCompute
                           : is_vertex       ? vk::ShaderStageFlagBits::eVertex
                                             : vk::ShaderStageFlagBits::eFragment;
        stages.infos.push_back(
            {.stage = stage, .module = *stages.modules.back(), .pName = "main", .pSpecializationInfo = &constants});
    }
    return stages;
}

vk::raii::Pipeline make_graphics_pipeline(const vk::raii::Device& device, const Stages& stages,
                                          const vk::raii::PipelineLayout& layout, const PipelineState& state,
                                          vk::PipelineCreateFlags flags) {
    const vk::PipelineVertexInputStateCreateInfo no_vertices{};
    const vk::PipelineInputAssemblyStateCreateInfo triangles{.topology = vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo raster{.frontFace = vk::FrontFace::eCounterClockwise,
                                                          .lineWidth = 1};
    const vk::PipelineMultisampleStateCreateInfo one_sample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
    const bool writes_stencil = state.stencil == Stencil::Mode::write;
    const vk::StencilOpState op{.passOp = writes_stencil ? vk::StencilOp::eReplace : vk::StencilOp::eKeep,
                                .compareOp = writes_stencil ? vk::CompareOp::eAlways : vk::CompareOp::eEqual,
                                .compareMask = 255,
                                .writeMask = 255,
                                .reference = state.stencil_value};
    const vk::PipelineDepthStencilStateCreateInfo depth_stencil{
        .depthTestEnable = state.depth.has_value(),
        .depthWriteEnable = state.depth && state.depth->is_written,
        .depthCompareOp = compare_op(state.depth ? state.depth->compare : DepthTest::Compare::less),
        .stencilTestEnable = state.stencil != Stencil::Mode::off,
        .front = op,
        .back = op};
    const std::vector<vk::PipelineColorBlendAttachmentState> no_blending(
        state.attachments.size(), {.colorWriteMask = vk::ColorComponentFlags(15)});
    const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = uint32_t(no_blending.size()),
                                                      .pAttachments = no_blending.data()};
    const vk::DynamicState dynamic_states[] = {vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                                               vk::DynamicState::eCullMode};
    const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = 3, .pDynamicStates = dynamic_states};
    std::vector<vk::Format> formats;
    for (const Format format : state.attachments) formats.push_back(vulkan_format(format));
    const vk::Format stencil_format =
        state.stencil == Stencil::Mode::off ? vk::Format::eUndefined : vk::Format::eD32SfloatS8Uint;
    const vk::Format depth_format = state.depth ? vulkan_format(state.depth->format) : stencil_format;
    const vk::PipelineRenderingCreateInfo rendering{.colorAttachmentCount = uint32_t(formats.size()),
                                                    .pColorAttachmentFormats = formats.data(),
                                                    .depthAttachmentFormat = depth_format,
                                                    .stencilAttachmentFormat = stencil_format};
    return {device, nullptr,
            vk::GraphicsPipelineCreateInfo{.pNext = &rendering,
                                           .flags = flags,
                                           .stageCount = uint32_t(stages.infos.size()),
                                           .pStages = stages.infos.data(),
                                           .pVertexInputState = &no_vertices,
                                           .pInputAssemblyState = &triangles,
                                           .pViewportState = &viewport,
                                           .pRasterizationState = &raster,
                                           .pMultisampleState = &one_sample,
                                           .pDepthStencilState = &depth_stencil,
                                           .pColorBlendState = &blend,
                                           .pDynamicState = &dynamic,
                                           .layout = *layout}};
}

std::string key_of(const ShaderIncludes& includes) {
    std::string key;
    for (const auto& [name, text] : includes) key += name + '\n' + text + '\n';
    return key;
}

std::string key_of(const ShaderChanges& changes) {
    std::string key;
    for (const GlslChange& change : changes.glsl) key += change.name + '\n';
    if (changes.is_for_gpu) key += "for a GPU\n";
    for (const auto& [image, format] : changes.image_formats) key += image + ' ' + name_of(format) + '\n';
    return key;
}

/// Values of the specialization constants that the shader uses, by their ids.
std::map<uint32_t, uint32_t> constants_of(const Shader& shader, const ParameterSet& params,
                                          const Constants& constants) {
    std::map<uint32_t, uint32_t> values;
    const auto specialize = [&](uint32_t id, const std::string& name, uint32_t initial) {
        if (!shader.interface.constants.contains(id)) return;
        const auto set = constants.find(name);
        values[id] = set != constants.end() ? set->second : initial;
    };
    uint32_t id = 0;
    for (const Parameter& p : params)
        if (p.use == Use::constant) specialize(id++, p.glsl_name(), p.bits());
    for (const SceneConstant& constant : scene_constants()) specialize(constant.id, constant.name, constant.initial);
    return values;
}

std::string name_of_version(const std::string& file) { return file + '#' + std::to_string(shader_version(file)); }

}  // namespace

PipelineCache& PipelineCache::of(Device::Impl& gpu) {
    if (!gpu.pipelines) gpu.pipelines = std::make_shared<PipelineCache>(gpu);
    return *gpu.pipelines;
}

const Shader& PipelineCache::shader(const std::string& file, const std::string& vertex_file, const ParameterSet& params,
                                    const ShaderIncludes& includes, const ShaderChanges& asked) {
    ShaderChanges changes = asked;
    changes.is_for_cpu = gpu_.info.is_cpu() && changes.glsl.empty() && !changes.is_for_gpu;
    const std::string prelude = changes.is_for_cpu ? shader_prelude_for_cpu(params) : shader_prelude(params);
    const auto [entry, is_new] = shaders_.try_emplace(name_of_version(file) + '\n' + vertex_file + '\n' +
                                                      key_of(changes) + key_of(includes) + prelude);
    if (is_new) try {
            entry->second = compile(file, vertex_file, prelude, includes, ShaderLanguage::vulkan, changes);
        } catch (...) {
            shaders_.erase(entry);
            throw;
        }
    return entry->second;
}

/// Once per shader: values of constants do not decide what is valid.
void PipelineCache::require_webgl2(const Shader& shader, const std::string& file, const ParameterSet& params,
                                   const ShaderIncludes& includes) {
    if (webgl2_shaders_.contains(&shader)) return;
    compile(file, "", shader_prelude(params, ShaderLanguage::webgl2), includes, ShaderLanguage::webgl2);
    webgl2_shaders_.insert(&shader);
}

PipelineRecipe PipelineCache::recipe(const Shader& shader, const std::string& file, const ParameterSet& params,
                                     const Constants& constants, const PipelineState& state) {
    return {.spirv = shader.spirv,
            .is_compute = file.ends_with(".comp"),
            .resources = shader.interface.resources,
            .push_size = shader.interface.push_size,
            .local_size = shader.interface.local_size,
            .constants = constants_of(shader, params, constants),
            .state = state};
}

Pipeline& PipelineCache::pipeline(const std::string& file, const std::string& vertex_file, const ParameterSet& params,
                                  const ShaderIncludes& includes, const Constants& constants,
                                  const PipelineState& state, const ShaderChanges& changes) {
    const Shader& shader = this->shader(file, vertex_file, params, includes, changes);
    // Only the constants that this shader uses take part in the key: a new value of another one costs it no new
    // pipeline.
    std::string key = name_of_version(file) + '\n' + vertex_file + '\n' + key_of(changes) + key_of(includes) +
                      params.glsl() + '\n' + std::to_string(int(state.stencil)) + ' ' +
                      std::to_string(state.stencil_value);
    for (const auto& [id, value] : constants_of(shader, params, constants)) key += ' ' + std::to_string(value);
    key += '\n';
    for (const Format format : state.attachments) key += ' ' + std::to_string(int(format));
    if (state.depth)
        key += " depth " + std::to_string(int(state.depth->compare)) + ' ' + std::to_string(state.depth->is_written) +
               ' ' + std::to_string(int(state.depth->format));
    const auto [entry, is_new] = pipelines_.try_emplace(key);
    if (is_new) {
        entry->second = make_pipeline(gpu_.device, recipe(shader, file, params, constants, state));
        entry->second.interface = shader.interface;
    }
    return entry->second;
}

Pipeline make_pipeline(const vk::raii::Device& device, const PipelineRecipe& recipe, vk::PipelineCreateFlags flags) {
    Pipeline p{.is_compute = recipe.is_compute};
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    const vk::ShaderStageFlags all_stages = p.is_compute
                                                ? vk::ShaderStageFlagBits::eCompute
                                                : vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
    for (const auto& r : recipe.resources) {
        const vk::ShaderStageFlags stage = p.is_compute  ? vk::ShaderStageFlagBits::eCompute
                                           : r.is_vertex ? vk::ShaderStageFlagBits::eVertex
                                                         : vk::ShaderStageFlagBits::eFragment;
        bindings.push_back({.binding = r.binding,
                            .descriptorType = descriptor_type(r.kind),
                            .descriptorCount = 1,
                            .stageFlags = stage});
    }
    p.set = {device,
             vk::DescriptorSetLayoutCreateInfo{.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR,
                                               .bindingCount = uint32_t(bindings.size()),
                                               .pBindings = bindings.data()}};
    const vk::PushConstantRange push{.stageFlags = all_stages, .size = recipe.push_size};
    const vk::DescriptorSetLayout set = *p.set;
    p.layout = {device, vk::PipelineLayoutCreateInfo{.setLayoutCount = 1,
                                                     .pSetLayouts = &set,
                                                     .pushConstantRangeCount = recipe.push_size ? 1u : 0u,
                                                     .pPushConstantRanges = &push}};

    std::vector<uint32_t> values;
    std::vector<vk::SpecializationMapEntry> entries;
    for (const auto& [id, value] : recipe.constants) {
        entries.push_back({.constantID = id, .offset = uint32_t(values.size() * 4), .size = 4});
        values.push_back(value);
    }
    const vk::SpecializationInfo specialization{.mapEntryCount = uint32_t(entries.size()),
                                                .pMapEntries = entries.data(),
                                                .dataSize = values.size() * 4,
                                                .pData = values.data()};
    const Stages stages = make_stages(device, recipe, specialization);
    p.pipeline = p.is_compute ? vk::raii::Pipeline(device, nullptr,
                                                   vk::ComputePipelineCreateInfo{
                                                       .flags = flags, .stage = stages.infos[0], .layout = *p.layout})
                              : make_graphics_pipeline(device, stages, p.layout, recipe.state, flags);
    return p;
}
