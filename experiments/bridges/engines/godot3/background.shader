shader_type spatial;
render_mode cull_disabled, depth_draw_never, ambient_light_disabled;

uniform sampler2D light;
uniform vec2 size;

void vertex() {
	POSITION = vec4(VERTEX.xy, 1.0, 1.0);  // at the far plane, over the whole image
}

void fragment() {
	ALBEDO = vec3(0.0);
	ROUGHNESS = 1.0;
	EMISSION = /*EMITTED*/;
}
