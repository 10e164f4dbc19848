void main() {
    if (gl_FragCoord.x > 0.5 * camera.extent.x) discard;
}
