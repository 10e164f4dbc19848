// Where the original takes the depth buffer for empty: also a surface that close to the far plane.
bool is_far_plane(float device_depth) {
    return camera.depth.w == 1.0 ? device_depth < 1e-6 : device_depth >= 1.0 - 1e-6;
}
