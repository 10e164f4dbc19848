// Numbers of groups for indirect dispatches.
#ifndef COMMON_INDIRECT_GROUPS_GLSL
#define COMMON_INDIRECT_GROUPS_GLSL

// Every device takes 65535 groups along an axis; beyond, they are spread over two.
uint[3] spread(uint groups) { return uint[](min(groups, 65535u), (groups + 65534u) / 65535u, 1u); }
#endif
