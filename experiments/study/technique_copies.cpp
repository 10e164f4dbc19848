#include "experiments/study/technique_copies.h"

#include "core/files.h"
#include "core/path_inside.h"
#include "variants/registry.h"

#include <set>

void write_technique_copies(const std::filesystem::path& results, const std::vector<VariantConfig>& variants) {
    std::set<std::string> names;
    for (const VariantConfig& variant : variants)
        if (!variant.external) names.insert(variant.variant);
    for (const std::string& name : names) {
        const VariantEntry& entry = find_variant(name);
        if (entry.is_ssrlabs()) continue;
        for (const auto& [file, text] : entry.folder->files)
            write_text(path_inside(results, "techniques/" + name + "/" + file), text);
    }
}
