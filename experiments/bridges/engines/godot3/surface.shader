shader_type spatial;
// ssrlab draws all surfaces from both sides; normals are its own where nodes are scaled differently along their axes.
render_mode cull_disabled, ensure_correct_normals/*MODES*/;

uniform sampler2D light;  // what each pixel of the image emits, first row at the top
uniform vec2 size;        // of it, in pixels
uniform vec3 base_color;
uniform sampler2D base_color_texture : hint_albedo;
uniform mat3 base_color_uv;
uniform float metalness;
uniform float perceptual_roughness;
uniform sampler2D metalness_roughness_texture : hint_white;
uniform mat3 metalness_roughness_uv;
uniform float dielectric_specular;  // scales the reflectance 0.04
uniform sampler2D normal_texture;
uniform mat3 normal_uv;
uniform float normal_scale;
uniform float alpha_cutoff;

void fragment() {
	vec4 base = vec4(base_color, 1.0) * COLOR * texture(base_color_texture, (base_color_uv * vec3(UV, 1.0)).xy);
	if (base.a < alpha_cutoff) discard;
	vec4 factors = texture(metalness_roughness_texture, (metalness_roughness_uv * vec3(UV, 1.0)).xy);
	ALBEDO = base.rgb;
	METALLIC = metalness * factors.b;
	ROUGHNESS = perceptual_roughness * factors.g;
	SPECULAR = 0.5 * sqrt(dielectric_specular);  // the engine's reflectance is 0.16 SPECULAR^2
	if (normal_scale > 0.0) {
		// NORMALMAP_DEPTH would blend with the vertices' normal, where glTF scales x and y.
		vec3 bent = texture(normal_texture, (normal_uv * vec3(UV, 1.0)).xy).xyz * 2.0 - 1.0;
		NORMALMAP = 0.5 + 0.5 * normalize(vec3(bent.xy * normal_scale, bent.z));
	}
	EMISSION = /*EMITTED*/;
}
