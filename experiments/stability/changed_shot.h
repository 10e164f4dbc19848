#pragma once
#include "experiments/config/shots/shot.h"
#include "experiments/stability/stability_case.h"

/// The shot that a case draws. Fails with Error as load_shot() does.
Shot changed_shot(const CaseScene& wanted, const std::vector<std::filesystem::path>& search_path);
