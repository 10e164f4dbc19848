#pragma once
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

/// A scene's first camera at frame 0, with an image 320 pixels wide. Warnings state shares of its pixels.
struct FirstView {
    ScenePose scene;
    CameraPose camera;
    glm::uvec2 extent;
};

/// Fails with Error where camera or scene cannot be posed.
FirstView first_view(const Scene& scene);

/// A warning, and the share of the first view's pixels that show its material, or its node and all nodes below it.
struct WarningShare {
    SceneWarning warning;
    std::optional<double> share;  ///< in [0, 1]; none where the warning has no material or node, or there is no view
};

struct ShownWarnings {
    std::vector<WarningShare> all;  ///< in the scene's order
    /// The sentences that every command prints, one for each kind of warning. Warnings that differ in the name of the
    /// material or node alone share a sentence; the last sentence counts what is left out.
    std::vector<std::string> sentences;
};

/// Traces the first view only if a warning needs it. `most`: limit of sentences.
ShownWarnings shown_warnings(const Scene& scene, size_t most);

/// ShownWarnings::sentences, at most 20.
std::vector<std::string> warning_sentences(const Scene& scene);
