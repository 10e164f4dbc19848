#pragma once
#include "variants/passes/declaration.h"

/// A technique of a folder: its row of the table, and what its technique.json declares.
struct DeclaredEntry {
    TechniqueEntry entry;
    std::shared_ptr<const Declaration> declaration;
};

/// Reads and judges `folder`/technique.json with all that takes part; its tuned_presets.json is left to the table.
/// Fails with Error, which names file and place, on what is wrong in it. `checks_frames`: by check_frames(), which
/// takes longer than all else; a test checks ssrlab's own.
DeclaredEntry read_technique(const std::filesystem::path& folder, bool checks_frames = true);
TechniqueEntry declared_entry(const std::filesystem::path& folder, bool checks_frames = true);

/// The technique's name, which is the folder's. Fails with Error unless it is of small letters, digits and '_'.
std::string declared_name(const std::filesystem::path& folder);

/// Runs it. Needs no more than its parameters and tracers until it renders.
std::unique_ptr<Technique> make_declared(std::shared_ptr<const Declaration> declaration);
