layout(location = 0) out vec4 color;
void main() {
    float one = 1;
    color = vec4(one);
}
