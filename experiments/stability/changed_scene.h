#pragma once
#include "core/scene/scene.h"
#include "experiments/stability/stability_case.h"

/// The scene that a case draws, and the one camera that sees it. Fails with Error as load_scene() does.
struct ChangedScene {
    Scene scene;
    SceneCamera camera;
};
ChangedScene changed_scene(const CaseScene& wanted, const std::vector<std::filesystem::path>& search_path);
