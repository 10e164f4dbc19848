// Needs the `camera` block.
#ifndef DENOISERS_PIXEL_SCALE_GLSL
#define DENOISERS_PIXEL_SCALE_GLSL

// Pixels of the screen per metre across the view at a view-space position.
float pixels_per_metre(vec3 position) {
    float w = (camera.clip_from_view * vec4(position, 1.0)).w;
    return 0.5 * camera.extent.y * abs(camera.clip_from_view[1][1]) / max(w, 1e-6);
}
#endif
