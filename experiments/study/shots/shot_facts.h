#pragma once
#include "core/gbuffer/scene_facts.h"
#include "experiments/study/config/config.h"
#include "groundtruth/reference/reference.h"

#include <nlohmann/json.hpp>

// Entries of manifest.json about a shot's scene and pixels (`needs`) and its references.

nlohmann::json fact_entries(const std::vector<SceneFact>& facts);
nlohmann::json reference_entry(const Reference& reference, unsigned frame, const Config& config);
