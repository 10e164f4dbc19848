#include "experiments/study/config/shots/scene_warnings.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/number_text.h"
#include "core/scene/view_shares.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace {

/// What warnings of a scene take their shares from; nothing where no warning needs it, or nothing can be seen.
class SharesOfFirstView {
public:
    explicit SharesOfFirstView(const Scene& scene) : scene_(scene) {
        const bool is_needed =
            std::ranges::any_of(scene.warnings, [](const SceneWarning& w) { return w.material >= 0 || w.node >= 0; });
        if (!is_needed || scene.cameras.empty()) return;
        try {
            const FirstView view = first_view(scene);
            shares_ = view_shares(scene, view.scene, view.camera, view.extent);
            of_node_.resize(scene.nodes.size());
            for (size_t i = 0; i < scene.instances.size(); ++i)
                add(of_node_[scene.instances[i].node], shares_->of_instance[i]);
            for (size_t i = scene.nodes.size(); i-- > 0;)  // parents come before children
                if (const int parent = scene.nodes[i].parent; parent >= 0 && of_node_[i])
                    add(of_node_[size_t(parent)], *of_node_[i]);
        } catch (const MachineError&) {
            throw;
        } catch (const Error&) {  // a camera that cannot be posed is refused by who renders
        }
    }

    /// Of all pixels that show what the warning concerns.
    std::optional<double> of(const SceneWarning& warning) const {
        if (!shares_) return {};
        if (warning.material >= 0) return std::min(shares_->of_material.at(size_t(warning.material)), 1.0);
        return warning.node >= 0 ? of_node_.at(size_t(warning.node)) : std::nullopt;
    }

    /// Of all pixels that show what any of the warnings concerns, which all name a material, or all a node.
    std::optional<double> of_any(const std::vector<const SceneWarning*>& warnings) const {
        if (!of(*warnings.front())) return {};
        std::vector<bool> is_material(scene_.materials.size()), is_node(scene_.nodes.size());
        for (const SceneWarning* warning : warnings) {
            if (warning->material >= 0)
                is_material.at(size_t(warning->material)) = true;
            else
                is_node.at(size_t(warning->node)) = true;
        }
        for (size_t i = 0; i < is_node.size(); ++i)
            if (const int parent = scene_.nodes[i].parent; parent >= 0 && is_node[size_t(parent)]) is_node[i] = true;
        double sum = 0;
        for (size_t i = 0; i < is_material.size(); ++i) sum += is_material[i] ? shares_->of_material[i] : 0.0;
        for (size_t i = 0; i < scene_.instances.size(); ++i)
            sum += is_node[scene_.instances[i].node] ? shares_->of_instance[i] : 0.0;
        return std::min(sum, 1.0);
    }

private:
    static void add(std::optional<double>& sum, double share) { sum = std::min(sum.value_or(0) + share, 1.0); }

    const Scene& scene_;
    std::optional<ViewShares> shares_;
    std::vector<std::optional<double>> of_node_;  ///< with all nodes below it; none where these draw nothing
};

std::string share_of_first_view(double share) {
    if (share <= 0) return "not in the first view";
    return (share < 0.001 ? "less than 0.1 %" : percent_text(share)) + " of the first view's pixels";
}

/// Name of the material or node that a warning concerns, as its sentence has it between quotation marks.
std::string name_in(const Scene& scene, const SceneWarning& warning) {
    const std::string& name = warning.material >= 0 ? scene.materials.at(size_t(warning.material)).name
                              : warning.node >= 0   ? scene.nodes.at(size_t(warning.node)).name
                                                    : std::string();
    for (const std::string& quoted : {"'" + name + "'", "'" + shortened(name) + "'"})
        if (!name.empty() && warning.text.find(quoted) != std::string::npos) return quoted;
    return {};
}

/// Warnings whose sentences differ in a name alone.
using WarningKind = std::vector<const SceneWarning*>;

std::vector<WarningKind> kinds_of(const Scene& scene) {
    std::vector<WarningKind> kinds;
    std::map<std::string, size_t> kind_of;  // by the sentence without its name
    for (const SceneWarning& warning : scene.warnings) {
        std::string key = warning.text;
        const std::string name = name_in(scene, warning);
        if (!name.empty()) key.replace(key.find(name), name.size(), warning.material >= 0 ? "\1" : "\2");
        const auto [found, is_new] = kind_of.try_emplace(key, kinds.size());
        if (is_new) kinds.emplace_back();
        kinds[found->second].push_back(&warning);
    }
    return kinds;
}

/// "the materials 'b', 'c' and 9 more": all but the first.
std::string others_of(const Scene& scene, const WarningKind& kind) {
    constexpr size_t most_names = 3;
    const size_t count = kind.size() - 1, named = count <= most_names ? count : most_names - 1;
    std::string text = kind.front()->material >= 0 ? "the material" : "the node";
    if (count > 1) text += "s";
    for (size_t i = 1; i <= named; ++i) text += (i == 1 ? " " : i == count ? " and " : ", ") + name_in(scene, *kind[i]);
    return named == count ? text : text + " and " + std::to_string(count - named) + " more";
}

std::string sentence_of(const Scene& scene, WarningKind kind, const SharesOfFirstView& shares) {
    // What is seen most is named first.
    std::ranges::stable_sort(kind, std::ranges::greater(), [&](const SceneWarning* w) { return shares.of(*w); });
    std::string text = kind.front()->text;
    const bool has_stop = text.ends_with('.');
    if (has_stop) text.pop_back();
    const bool are_several = kind.size() > 1 && !name_in(scene, *kind.front()).empty();
    if (are_several) text += "; the same holds for " + others_of(scene, kind);
    if (const auto share = shares.of_any(kind))
        text += (are_several && *share > 0 ? " (together " : " (") + share_of_first_view(*share) + ")";
    return has_stop ? text + "." : text;
}

}  // namespace

FirstView first_view(const Scene& scene) {
    constexpr unsigned width = 320, least_height = 20, most_height = 1280;
    const SceneCamera& camera = scene.camera("");
    const float aspect = camera.aspect > 0 ? camera.aspect : 16.0f / 9.0f;
    FirstView view{.scene = pose_scene(scene, 0.0f), .camera = {}, .extent = {width, 0}};
    view.camera = pose_camera(camera, view.scene, 0.0f);
    view.extent.y = unsigned(std::lround(std::clamp(width / aspect, float(least_height), float(most_height))));
    return view;
}

ShownWarnings shown_warnings(const Scene& scene, size_t most) {
    const SharesOfFirstView shares(scene);
    ShownWarnings shown;
    for (const SceneWarning& warning : scene.warnings) shown.all.push_back({warning, shares.of(warning)});
    std::vector<WarningKind> kinds = kinds_of(scene);
    const size_t left = kinds.size() > most ? kinds.size() - most + 1 : 0;
    kinds.resize(kinds.size() - left);
    for (const WarningKind& kind : kinds) shown.sentences.push_back(sentence_of(scene, kind, shares));
    if (left > 0)
        shown.sentences.push_back(std::to_string(left) + " further warnings: `ssrlab inspect --all` lists them.");
    return shown;
}

std::vector<std::string> warning_sentences(const Scene& scene) {
    constexpr size_t most = 20;
    return shown_warnings(scene, most).sentences;
}
