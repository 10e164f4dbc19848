#include "experiments/study/technique_copies.h"

#include "core/files.h"
#include "core/path_inside.h"
#include "variants/registry.h"

#include <set>

void write_technique_copies(const std::filesystem::path& results, const std::vector<PointConfig>& techniques) {
    std::set<std::string> names;
    for (const PointConfig& technique : techniques)
        if (!technique.external) names.insert(technique.technique);
    for (const std::string& name : names) {
        const TechniqueEntry& entry = find_technique(name);
        if (entry.is_ssrlabs()) continue;
        for (const auto& [file, text] : entry.folder->files)
            write_text(path_inside(results, "techniques/" + name + "/" + file), text);
    }
}
