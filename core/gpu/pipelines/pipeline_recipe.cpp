#include "core/gpu/pipelines/pipeline_recipe.h"

#include "core/error.h"

#include <nlohmann/json.hpp>

using nlohmann::json;

namespace {

json to_json(const PipelineState& state) {
    json formats = json::array();
    for (const Format format : state.attachments) formats.push_back(int(format));
    json depth;
    if (state.depth) depth = {int(state.depth->compare), state.depth->is_written, int(state.depth->format)};
    return {formats, int(state.stencil), state.stencil_value, depth};
}

PipelineState state_of(const json& j) {
    PipelineState state{.attachments = {}, .stencil = Stencil::Mode(j.at(1).get<int>()), .stencil_value = j.at(2)};
    for (const json& format : j.at(0)) state.attachments.push_back(Format(format.get<int>()));
    if (const json& depth = j.at(3); !depth.is_null())
        state.depth = {DepthTest::Compare(depth.at(0).get<int>()), depth.at(1), Format(depth.at(2).get<int>())};
    return state;
}

json to_json(const PipelineRecipe& recipe) {
    json resources = json::array();
    for (const ShaderInterface::Resource& r : recipe.resources)
        resources.push_back({r.name, r.binding, int(r.kind), r.is_vertex});
    return {{"spirv", recipe.spirv},         {"is_compute", recipe.is_compute}, {"resources", resources},
            {"push_size", recipe.push_size}, {"local_size", recipe.local_size}, {"constants", recipe.constants},
            {"state", to_json(recipe.state)}};
}

PipelineRecipe recipe_of(const json& j) {
    PipelineRecipe recipe{.spirv = j.at("spirv"),
                          .is_compute = j.at("is_compute"),
                          .resources = {},
                          .push_size = j.at("push_size"),
                          .local_size = j.at("local_size"),
                          .constants = j.at("constants"),
                          .state = state_of(j.at("state"))};
    for (const json& r : j.at("resources"))
        recipe.resources.push_back({r.at(0), r.at(1), ShaderInterface::Kind(r.at(2).get<int>()), r.at(3)});
    return recipe;
}

}  // namespace

std::string bytes_of(const std::vector<PipelineRecipe>& recipes) {
    json all = json::array();
    for (const PipelineRecipe& recipe : recipes) all.push_back(to_json(recipe));
    std::string bytes;
    json::to_cbor(all, bytes);
    return bytes;
}

std::vector<PipelineRecipe> recipes_of(const std::string& bytes) {
    try {
        std::vector<PipelineRecipe> recipes;
        for (const json& recipe : json::from_cbor(bytes)) recipes.push_back(recipe_of(recipe));
        return recipes;
    } catch (const json::exception& e) {
        fail("these are no recipes of pipelines: ", e.what());
    }
}
