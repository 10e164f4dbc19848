// Unit vectors in two integers: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors",
// JCGT 3(2), "oct".
vec2 folded(vec2 p) { return (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0))); }

// The place of a unit vector in [-1, 1]^2.
vec2 octahedral_place(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z < 0.0 ? folded(p) : p;
}

vec3 octahedral_direction(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = folded(n.xy);
    return normalize(n);
}

// n after it was stored in two signed integers of so many bits.
vec3 octahedral(vec3 n, uint bits) {
    float largest = float((1u << (bits - 1u)) - 1u);
    return octahedral_direction(round(octahedral_place(n) * largest) / largest);
}
