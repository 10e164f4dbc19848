// Numbers of groups for the passes that work through the lists.
#include "amd_sssr/lists.glsl"

layout(local_size_x = 1) in;
buffer indirect_arguments { uint ray_groups[3], tile_groups[3]; };

void main() {
    ray_count = rays_being_listed;
    tile_count = tiles_being_listed;
    rays_being_listed = tiles_being_listed = 0u;
    // Every device takes 65535 groups along an axis; beyond, they are spread over two.
    uint groups = (ray_count + 63u) / 64u;
    ray_groups = uint[](min(groups, 65535u), (groups + 65534u) / 65535u, 1u);
    tile_groups = uint[](tile_count, 1u, 1u);
}
