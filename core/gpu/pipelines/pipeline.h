#pragma once
#include "core/gpu/device_impl.h"
#include "core/gpu/pipelines/pipeline_recipe.h"

#include <map>

struct Pipeline {
    ShaderInterface interface;
    vk::raii::DescriptorSetLayout set{nullptr};
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
    bool is_compute = false;
};

/// The pipeline that a driver makes of `recipe`; Pipeline::interface stays empty.
Pipeline make_pipeline(const vk::raii::Device& device, const PipelineRecipe& recipe,
                       vk::PipelineCreateFlags flags = {});

/// Shaders and pipelines, each made at its first use.
class PipelineCache {
public:
    explicit PipelineCache(Device::Impl& gpu) : gpu_(gpu) {}

    /// The cache of the device, shared by all pass_lists: compiling takes 0.1 s or more per shader.
    static PipelineCache& of(Device::Impl& gpu);

    /// `params`: the technique's. Their declarations are part of the shader, values of constants part of the pipeline,
    /// and `includes` part of both. `constants` replace values of parameters.
    const Shader& shader(const std::string& file, const std::string& vertex_file, const ParameterSet& params,
                         const ShaderIncludes& includes, const ShaderChanges& changes = {});
    /// Fails with Error unless the fragment shader is valid as GLSL ES 3.00. `shader`: the result of shader() for
    /// `file`.
    void require_webgl2(const Shader& shader, const std::string& file, const ParameterSet& params,
                        const ShaderIncludes& includes);
    /// The recipe of pipeline(). `shader`: the result of shader() for `file`.
    static PipelineRecipe recipe(const Shader& shader, const std::string& file, const ParameterSet& params,
                                 const Constants& constants, const PipelineState& state);
    Pipeline& pipeline(const std::string& file, const std::string& vertex_file, const ParameterSet& params,
                       const ShaderIncludes& includes, const Constants& constants, const PipelineState& state,
                       const ShaderChanges& changes = {});

private:
    Device::Impl& gpu_;
    std::map<std::string, Shader> shaders_;  // nodes keep their addresses
    std::set<const Shader*> webgl2_shaders_;
    std::map<std::string, Pipeline> pipelines_;
};
