#pragma once
#include "variants/passes/declaration.h"

/// A technique of a folder: its row of the table, and its technique.json.
struct DeclaredEntry {
    TechniqueEntry entry;
    std::shared_ptr<const Declaration> declaration;
};

/// Reads and checks `folder`/technique.json and all files that it uses, but not tuned_presets.json. Fails with Error,
/// which names file and place, if something is wrong. `checks_frames`: also runs check_frames(), which takes longest;
/// for ssrlab's own techniques a test does so.
DeclaredEntry read_technique(const std::filesystem::path& folder, bool checks_frames = true);
TechniqueEntry declared_entry(const std::filesystem::path& folder, bool checks_frames = true);

/// Absolute, without links and without a '/' at its end.
std::filesystem::path whole_path(const std::filesystem::path& folder);

/// The technique's name, which is the folder's. Fails with Error unless it is of small letters, digits and '_'.
std::string declared_name(const std::filesystem::path& folder);

/// A technique that runs the declaration. Until it renders it needs only its parameters and tracers.
std::unique_ptr<Technique> make_declared(std::shared_ptr<const Declaration> declaration);
