// What most sources include and the compiler would read each time: half of the build without it. Sources include what they
// use all the same.
#pragma once
#include <algorithm>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>
