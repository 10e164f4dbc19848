// Writes the numbers of groups for the passes that work through the lists.
#include "amd_sssr/lists.glsl"
#include "common/indirect_groups.glsl"

layout(local_size_x = 1) in;
buffer indirect_arguments { uint ray_groups[3], tile_groups[3], tile_octet_groups[3]; };

void main() {
    ray_count = rays_being_listed;
    tile_count = tiles_being_listed;
    rays_being_listed = tiles_being_listed = 0u;
    ray_groups = spread((ray_count + 63u) / 64u);
    tile_groups = spread(tile_count);
    tile_octet_groups = spread((tile_count + 7u) / 8u);
}
