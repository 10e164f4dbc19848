// Unit vectors in two integers: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors",
// JCGT 3(2), "oct".
vec2 folded(vec2 p) { return (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0))); }

// n after it was stored in two signed integers of so many bits.
vec3 octahedral(vec3 n, uint bits) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) p = folded(p);
    float largest = float((1u << (bits - 1u)) - 1u);
    p = round(p * largest) / largest;
    vec3 stored = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (stored.z < 0.0) stored.xy = folded(stored.xy);
    return normalize(stored);
}
