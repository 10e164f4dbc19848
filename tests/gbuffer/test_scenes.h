#pragma once
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "core/scene/scene.h"

// Small scenes built in code, and what the tests of this folder share.

Mesh quad(unsigned material, glm::vec3 corner, glm::vec3 u, glm::vec3 v);  ///< front side along cross(u, v); uv 0..1

/// A textured, a masked, a normal-mapped and a plain material on quads before a floor; one node moves and one is
/// mirrored (negative determinant). Camera "main" moves, "orthographic" stands still. All in an environment with a
/// gradient.
Scene varied_scene();
/// The same with dielectrics of other reflectances than 0.04, by factors and textures, coloured and above 1.
Scene dielectric_scene();

/// varied_scene() with two deformed meshes, which joints and a morph target move from frame to frame: the textured quad
/// (instance 1), whose vertices all follow its joints alike, so that it stays flat, and in place of the normal-mapped
/// quad (instance 3) a grid that bends and bulges.
Scene deforming_scene();

Device& test_device();  ///< one for all tests, validated as SSRLAB_VALIDATE says

FrameView view_of(glm::uvec2 extent, unsigned frame = 0, DepthDirection direction = DepthDirection::standard);

/// Number of values whose bits differ; all of them if the extents do.
size_t differing_bits(const HostImage& a, const HostImage& b);
