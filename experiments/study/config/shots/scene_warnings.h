#pragma once
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

/// What a scene's camera shows in frame 0, in the size that warnings take their shares of: 320 pixels wide.
struct FirstView {
    ScenePose scene;
    CameraPose camera;
    glm::uvec2 extent;
};

/// Of the scene's first camera. Fails with Error where camera or scene cannot be posed.
FirstView first_view(const Scene& scene);

/// A warning, and the share of the first view's pixels that show the material or node (with all below it) that it
/// concerns.
struct WarningShare {
    SceneWarning warning;
    std::optional<double> share;  ///< in [0, 1]; none of a warning without a material or node, or without a view
};

struct ShownWarnings {
    std::vector<WarningShare> all;  ///< in the scene's order
    /// As every command prints them, one for each kind: warnings that differ in the name of the material or node alone
    /// become one sentence, and the last sentence counts what is left out.
    std::vector<std::string> sentences;
};

/// Traces the first view only if a warning needs it. `most`: sentences.
ShownWarnings shown_warnings(const Scene& scene, size_t most);

/// The sentences alone, at most 20.
std::vector<std::string> warning_sentences(const Scene& scene);
