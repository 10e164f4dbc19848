#pragma once
#include <string>

// Numbers as sentences, tables and pages of this program have them.

/// So many significant digits, without zeros at the end: "1.5", "2.3e-05".
std::string number_text(double value, int digits = 4);
/// So many digits behind the point.
std::string fixed_text(double value, int decimals = 0);
/// Of a share, as number_text(): "5 %".
std::string percent_text(double share, int digits = 3);
/// Of rays per second.
std::string ray_rate_text(double rays_per_second);
