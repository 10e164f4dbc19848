#include "core/gpu/pass_record.h"

#include "core/gpu/pass_graph_impl.h"
#include "core/gpu/pipelines/spirv_module.h"
#include "core/gpu/waves/shader_flow.h"

void PassGraph::record(GraphRecorder recorder) {
    impl_->recorder = std::make_unique<GraphRecorder>(std::move(recorder));
}
void PassGraph::stop_recording() { impl_->recorder.reset(); }

/// Compute passes and draws of meshes are no part of a recording: Limits::webgl2 refuses them before they run.
void PassGraph::Impl::record_pass(const Pass& pass, const Shader& shader, const PipelineRecipe& recipe,
                                  const std::vector<Image>& targets) {
    if (pass.is_compute_ || !pass.vertex_shader_.empty())
        fail("pass ", pass.label_, " cannot be recorded: it is no fragment shader over a whole image");
    if (!constants.empty())
        fail("pass ", pass.label_, " cannot be recorded: its graph sets constants, which sources do not hold");
    RecordedPass record{.stage = pass.label_,
                        .shader = pass.shader_,
                        .params = *params,
                        .includes = pass.includes_,
                        .recipe = recipe,
                        .textures = {},
                        .targets = targets,
                        .depth = pass.depth_,
                        .stencil = pass.stencil_,
                        .push = push_block(pass, shader.interface)};
    for (const ShaderInterface::Resource& r : shader.interface.resources) {
        if (r.kind != ShaderInterface::Kind::sampler) continue;
        RecordedPass::Texture texture{.name = r.name, .image = {}, .sampling = {}};
        const Image* image = find_image(pass, nullptr, r.name, texture.sampling);
        if (!image) fail_missing(pass, r.name);
        texture.image = *image;
        record.textures.push_back(std::move(texture));
    }
    recorder->pass(record);
}

WholeImage whole_of(const Image& image) {
    const vk::ImageCreateInfo& info = image.storage->info;
    return {{info.extent.width, info.extent.height}, info.mipLevels};
}

ShaderReads reads_of(const PipelineRecipe& recipe) {
    const std::vector<unsigned> spirv = simplified(recipe).spirv.back();
    const std::vector<SpirvInstruction> instructions = spirv_instructions(spirv);
    const SpirvModule module(instructions);
    std::map<unsigned, unsigned> numbers;  // values of constants, by their ids
    ShaderReads reads;
    for (const SpirvInstruction& i : instructions) {
        if (i.op == spv::OpConstant) numbers[i[2]] = i[3];
        if (i.op == spv::OpLoad && module.definition(i[3]).op == spv::OpVariable &&
            module.storage_of(i[3]) == spv::StorageClassUniformConstant)
            reads.samplers.insert(module.name(i[3]));
        const bool is_chain = i.op == spv::OpAccessChain || i.op == spv::OpInBoundsAccessChain;
        if (!is_chain || module.definition(i[3]).op != spv::OpVariable) continue;
        const unsigned block = module.type_of(i[3])[3];
        if (module.storage_of(i[3]) == spv::StorageClassUniform && module.name(block) == "Params")
            reads.params.insert(numbers.at(i[4]));
    }
    return reads;
}
