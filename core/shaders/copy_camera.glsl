// Member by member: on a copy of the whole block lavapipe 22.3 crashes. See shader_prelude_for_cpu().
void copy_camera() {
    camera.clip_from_view = camera_block.camera.clip_from_view;
    camera.view_from_clip = camera_block.camera.view_from_clip;
    camera.view_from_world = camera_block.camera.view_from_world;
    camera.world_from_view = camera_block.camera.world_from_view;
    camera.clip_from_world = camera_block.camera.clip_from_world;
    camera.world_from_clip = camera_block.camera.world_from_clip;
    camera.previous_clip_from_world = camera_block.camera.previous_clip_from_world;
    camera.previous_view_from_world = camera_block.camera.previous_view_from_world;
    camera.previous_world_from_view = camera_block.camera.previous_world_from_view;
    camera.previous_view_from_clip = camera_block.camera.previous_view_from_clip;
    camera.extent = camera_block.camera.extent;
    camera.depth = camera_block.camera.depth;
    camera.jitter = camera_block.camera.jitter;
    camera.frame = camera_block.camera.frame;
}
