uniform writeonly image2D target;
void main() { imageStore(target, ivec2(gl_FragCoord.xy), vec4(1.0)); }
