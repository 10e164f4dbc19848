// What most sources include and the compiler would read each time, for half of the build's time. Sources include what
// they use all the same.
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
