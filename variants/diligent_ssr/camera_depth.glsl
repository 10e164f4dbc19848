// Distance from the camera plane (m). By the projection, not by its inverse: edges of a flat surface are found by
// differences that are as small as the rounding.
float camera_depth(float device_depth) {
    mat4 clip_from_view = camera.clip_from_view;
    return (device_depth * clip_from_view[3][3] - clip_from_view[3][2]) /
           (device_depth * clip_from_view[2][3] - clip_from_view[2][2]);
}
