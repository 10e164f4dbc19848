#pragma once
#include <string>

// Numbers as ssrlab's sentences, tables and pages show them.

/// At most `digits` significant digits, without zeros at the end: "1.5", "2.3e-05".
std::string number_text(double value, int digits = 4);
/// `decimals` digits behind the point.
std::string fixed_text(double value, int decimals = 0);
/// Two decimals; "above 0.99" and "below 0.01" where these would read as certainty.
std::string probability_text(double probability);
/// A share in per cent, as number_text(): "5 %".
std::string percent_text(double share, int digits = 3);
/// A rate of rays: "1.2 Mray/s".
std::string ray_rate_text(double rays_per_second);
