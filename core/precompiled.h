// Headers that most sources include: precompiling them halves the build's time. Sources still include what they use.
#pragma once
#include <tbb/parallel_for.h>  // with it the compiler's vector intrinsics: 1 s in each of 26 units
#include <algorithm>
#include <charconv>
#include <chrono>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>
