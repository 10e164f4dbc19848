#pragma once
#include <span>
#include <string>
#include <vector>

/// The frames of texts such as "3" and "0-63", as --frames takes them: ascending, each once, up to 999999. Fails with
/// Error on other texts, and on more than `most` frames; `holder` ("a page") names what cannot hold more.
std::vector<unsigned> frame_numbers(std::span<const std::string> texts, size_t most, const std::string& holder);
