#ifndef TRACERS_STRIDE_GLSL
#define TRACERS_STRIDE_GLSL

// Coarse near the camera, where a pixel is short, and single pixels from `cutoff` (m from the camera plane; 0: nowhere)
// on: the law of kode80's port of McGuire & Mara 2014 for Unity.
float stride_at(float vs_z, float stride, float cutoff) {
    return cutoff == 0.0 ? stride : mix(stride, 1.0, min(-vs_z / cutoff, 1.0));
}
#endif
