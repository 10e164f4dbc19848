#pragma once
#include "core/scene/scene.h"

/// Gives every triangle its own three vertices, whose normal is that of the triangle: what glTF 2.0, section 3.7.2.1,
/// asks for where normals are missing.
void make_flat_normals(Mesh& mesh);

/// Replaces normals of no length by that of a triangle which uses the vertex, and makes all of unit length.
void repair_normals(Mesh& mesh);

/// Derives tangents from positions, normals and the coordinates of `slot`, after Mikkelsen ("Simulation of Wrinkled
/// Surfaces Revisited", 2008): per triangle along +u, averaged over equal vertices weighted by the corner's angle,
/// apart for the two handednesses; a vertex that serves both is split. The bitangent runs along -v: glTF's v points
/// down, +Y of a normal map up.
void derive_tangents(Mesh& mesh, const TextureSlot& slot);

/// Makes the file's tangents unit and perpendicular to the normals, and their w +-1.
void repair_tangents(Mesh& mesh);

/// Turns the file's tangents, which follow the texture coordinates themselves (glTF 2.0, section 3.7.2.1), as
/// `slot.uv_transform` turns the texture: by the angle, and to the handedness, by which derive_tangents() with the
/// transform differs from it without. Where it does not turn them they keep their bits.
void turn_tangents(Mesh& mesh, const TextureSlot& slot);

/// Whether tangents of texture coordinates are others after the transform: unless it only moves and scales.
bool turns_tangents(const glm::mat3& uv_transform);

/// Any tangent perpendicular to each normal, for meshes without a normal map.
void make_any_tangents(Mesh& mesh);

/// Makes normals and tangents of what the file holds: normals where it has some (not Mesh::is_flat_shaded), tangents
/// where it `has_tangents`, too; the others are made from its triangles, tangents as `normal_texture` needs them.
void finish_normals(Mesh& mesh, bool has_tangents, const TextureSlot& normal_texture);
