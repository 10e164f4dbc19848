#include "core/number_text.h"

#include <cstdio>

namespace {

std::string formatted(const char* format, int digits, double value) {
    char text[340];  // the largest double has 309 digits
    std::snprintf(text, sizeof text, format, digits, value);
    return text;
}

}  // namespace

std::string number_text(double value, int digits) { return formatted("%.*g", digits, value); }
std::string fixed_text(double value, int decimals) { return formatted("%.*f", decimals, value); }
std::string probability_text(double p) {
    return p < 0.005 ? "below 0.01" : p > 0.995 ? "above 0.99" : fixed_text(p, 2);
}
std::string percent_text(double share, int digits) { return number_text(100 * share, digits) + " %"; }
std::string ray_rate_text(double rays_per_second) { return fixed_text(rays_per_second * 1e-6, 1) + " Mray/s"; }
