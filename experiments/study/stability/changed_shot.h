#pragma once
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/stability/stability_case.h"

/// Loads the shot of a case, with its changes. Fails with Error as load_shot() does.
Shot changed_shot(const CaseScene& wanted, const std::vector<std::filesystem::path>& search_path);
