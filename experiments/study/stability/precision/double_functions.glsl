// What GLSL has of floats only, for double_shader.cpp: functions of doubles, to 1e-15 of their size, and the ways between
// doubles and what holds floats: images, and bits.
#define COMPONENTWISE(f)                                                                 \
    dvec2 f(dvec2 v) { return dvec2(f(v.x), f(v.y)); }                                   \
    dvec3 f(dvec3 v) { return dvec3(f(v.x), f(v.y), f(v.z)); }                           \
    dvec4 f(dvec4 v) { return dvec4(f(v.x), f(v.y), f(v.z), f(v.w)); }

double sum_of_odd_series(double x, double square_sign, int terms) {  // x + s x^3 / 3 + x^5 / 5 + ..., s = +-1
    double square = square_sign * x * x, power = x, sum = 0.0LF;
    for (int k = 0; k < terms; ++k) {
        sum += power / double(2 * k + 1);
        power *= square;
    }
    return sum;
}

double exp2(double x) {
    if (isnan(x)) return x;
    if (x < -1022.0LF) return 0.0LF;
    if (x >= 1024.0LF) return 1.0LF / 0.0LF;
    double whole = min(floor(x + 0.5LF), 1023.0LF);
    double r = (x - whole) * 0.693147180559945309417LF, power = 1.0LF, sum = 1.0LF;
    for (int k = 1; k <= 20; ++k) {
        power *= r / double(k);
        sum += power;
    }
    return sum * packDouble2x32(uvec2(0u, uint(int(whole) + 1023) << 20));
}
double log(double x) {
    if (isnan(x) || isinf(x) || x < 0.0LF) return x < 0.0LF ? 0.0LF / 0.0LF : x;
    if (x == 0.0LF) return -1.0LF / 0.0LF;
    double scale = x < 1e-290LF ? 18014398509481984.0LF : 1.0LF;  // 2^54, for denormals
    uvec2 bits = unpackDouble2x32(x * scale);
    int exponent = int(bits.y >> 20) - 1023 - (scale > 1.0LF ? 54 : 0);
    double mantissa = packDouble2x32(uvec2(bits.x, (bits.y & 0xfffffu) | 0x3ff00000u));
    if (mantissa > 1.41421356237309504880LF) {
        mantissa *= 0.5LF;
        ++exponent;
    }
    return double(exponent) * 0.693147180559945309417LF +
           2.0LF * sum_of_odd_series((mantissa - 1.0LF) / (mantissa + 1.0LF), 1.0LF, 14);
}
double exp(double x) { return exp2(x * 1.44269504088896340736LF); }
double log2(double x) { return log(x) * 1.44269504088896340736LF; }
double pow(double x, double y) { return x == 0.0LF && y > 0.0LF ? 0.0LF : exp2(y * log2(x)); }

dvec2 cosine_and_sine(double x) {
    double quarters = floor(x * 0.636619772367581343076LF + 0.5LF);
    double r = (x - quarters * 1.57079632679489655800LF) - quarters * 6.12323399573676603587e-17LF;
    dvec2 sums = dvec2(0.0LF), term = dvec2(1.0LF, r);
    for (int k = 0; k < 12; ++k) {
        sums += term;
        term *= -r * r / dvec2(double((2 * k + 1) * (2 * k + 2)), double((2 * k + 2) * (2 * k + 3)));
    }
    int turn = int(quarters - 4.0LF * floor(0.25LF * quarters));
    return turn == 0 ? sums : turn == 1 ? dvec2(-sums.y, sums.x) : turn == 2 ? -sums : dvec2(sums.y, -sums.x);
}
double cos(double x) { return cosine_and_sine(x).x; }
double sin(double x) { return cosine_and_sine(x).y; }
double tan(double x) {
    dvec2 v = cosine_and_sine(x);
    return v.y / v.x;
}
double atan_within_one(double x) {  // by two halvings of the angle
    double half_tangent = x / (1.0LF + sqrt(1.0LF + x * x));
    double quarter_tangent = half_tangent / (1.0LF + sqrt(1.0LF + half_tangent * half_tangent));
    return 4.0LF * sum_of_odd_series(quarter_tangent, -1.0LF, 14);
}
double atan(double x) {
    if (abs(x) > 1.0LF) return sign(x) * 1.57079632679489661923LF - atan_within_one(1.0LF / x);
    return atan_within_one(x);
}
double atan(double y, double x) {
    if (x == 0.0LF) return sign(y) * 1.57079632679489661923LF;
    double angle = atan(y / x);
    return x > 0.0LF ? angle : angle + (y < 0.0LF ? -3.14159265358979323846LF : 3.14159265358979323846LF);
}
double acos(double x) { return atan(sqrt((1.0LF - x) * (1.0LF + x)), x); }
double asin(double x) { return atan(x, sqrt((1.0LF - x) * (1.0LF + x))); }

COMPONENTWISE(exp2)
COMPONENTWISE(exp)
COMPONENTWISE(log2)
COMPONENTWISE(log)
COMPONENTWISE(sin)
COMPONENTWISE(cos)
dvec2 pow(dvec2 x, dvec2 y) { return dvec2(pow(x.x, y.x), pow(x.y, y.y)); }
dvec3 pow(dvec3 x, dvec3 y) { return dvec3(pow(x.xy, y.xy), pow(x.z, y.z)); }
dvec4 pow(dvec4 x, dvec4 y) { return dvec4(pow(x.xyz, y.xyz), pow(x.w, y.w)); }

// To what an image, a sampler or bits hold, and from there; numbers that are no floats stay.
#define NARROWED(wide, narrow)                                                           \
    narrow narrowed(wide v) { return narrow(v); }                                        \
    narrow narrowed(narrow v) { return v; }                                              \
    wide widened(narrow v) { return wide(v); }
NARROWED(double, float)
NARROWED(dvec2, vec2)
NARROWED(dvec3, vec3)
NARROWED(dvec4, vec4)
int narrowed(int v) { return v; }
uvec4 narrowed(uvec4 v) { return v; }
uvec4 widened(uvec4 v) { return v; }

#define texelFetch(image, place, level) widened(texelFetch(image, place, level))
#define textureLod(image, place, level) widened(textureLod(image, narrowed(place), narrowed(level)))
#define texture(image, place) widened(texture(image, narrowed(place)))
#define imageLoad(image, place) widened(imageLoad(image, place))
#define imageStore(image, place, value) imageStore(image, place, narrowed(value))
#define floatBitsToUint(value) floatBitsToUint(narrowed(value))
#define packHalf2x16(value) packHalf2x16(narrowed(value))
