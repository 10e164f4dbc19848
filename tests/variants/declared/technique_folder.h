#pragma once
#include "core/files.h"
#include "variants/registry.h"

#include <unistd.h>

namespace fs = std::filesystem;

/// A technique's folder in a temporary one, which goes with this.
struct TemporaryTechnique {
    explicit TemporaryTechnique(const std::string& name)
        : parent(fs::temp_directory_path() / ("technique_" + name)), folder(parent / name) {
        fs::remove_all(parent);
        fs::create_directories(folder);
    }
    ~TemporaryTechnique() { fs::remove_all(parent); }
    TemporaryTechnique(const TemporaryTechnique&) = delete;
    TemporaryTechnique& operator=(const TemporaryTechnique&) = delete;

    void write(const std::string& file, const std::string& text) const { write_text(folder / file, text); }
    const TechniqueEntry& add() const { return add_technique_folder(folder); }

    fs::path parent, folder;
};
