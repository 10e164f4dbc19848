#pragma once
#include "core/gbuffer/gbuffer.h"
#include "variants/resolves/resolve.h"

/// Both passes of the recurrent blur, with its parameters as the graph's: history is fetched from where it was, then it
/// and the pixels' own rays are blurred and blended. Returns `reflections`, rgba32f: rgb radiance, a confidence.
Image recurrent_blur(PassGraph& graph, const GBuffer& gbuffer, const OwnRays& own);
