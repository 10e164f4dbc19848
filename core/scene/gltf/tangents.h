#pragma once
#include "core/scene/scene.h"

/// Gives every triangle its own three vertices with the triangle's normal, as glTF 2.0, section 3.7.2.1, asks for
/// without normals.
void make_flat_normals(Mesh& mesh);

/// Replaces zero normals by that of a triangle at the vertex, and makes all normals unit.
void repair_normals(Mesh& mesh);

/// Derives tangents from positions, normals and the coordinates of `slot`, after Mikkelsen ("Simulation of Wrinkled
/// Surfaces Revisited", 2008): per triangle along +u, averaged over equal vertices weighted by the corner's angle,
/// apart for the two handednesses; a vertex that serves both is split. The bitangent runs along -v: glTF's v points
/// down, +Y of a normal map up.
void derive_tangents(Mesh& mesh, const TextureSlot& slot);

/// Makes the file's tangents unit and perpendicular to the normals, and their w +-1.
void repair_tangents(Mesh& mesh);

/// Turns the file's tangents, which follow the texture coordinates themselves (glTF 2.0, section 3.7.2.1), as
/// `slot.uv_transform` turns the texture. Angle and handedness change as those of derive_tangents() do with the
/// transform. Tangents that are not turned keep their bits.
void turn_tangents(Mesh& mesh, const TextureSlot& slot);

/// Whether the transform changes tangents: it does unless it only moves and scales.
bool turns_tangents(const glm::mat3& uv_transform);

/// Any tangent perpendicular to each normal, for meshes without a normal map.
void make_any_tangents(Mesh& mesh);

/// Completes normals and tangents: keeps the file's normals (if not Mesh::is_flat_shaded) and, if it `has_tangents`,
/// its tangents. Makes the others from the triangles, and tangents as `normal_texture` needs them.
void finish_normals(Mesh& mesh, bool has_tangents, const TextureSlot& normal_texture);
