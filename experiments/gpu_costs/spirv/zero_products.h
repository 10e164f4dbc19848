#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"

/// How many products of a number with a constant 0 the last stage of a pipeline has, with its constants in place. Such
/// a product of NaN or infinity is NaN (IEEE 754), but compilers may take it for 0 (Vulkan, "Precision and Operation of
/// SPIR-V Instructions"), as lavapipe does, even with SignedZeroInfNanPreserve. Products within dot products, products
/// of matrices, mix, fma, cross, reflect and pow count, and quotients of 0, each component by itself. Products of
/// uniforms and of what integers become do not, as these are finite; nor do those with the counter of a loop, which is
/// 0 in its first round. Fails with Error on a shader that cannot be written as one function.
unsigned zero_products(const PipelineRecipe& recipe);
