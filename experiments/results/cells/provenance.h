#pragma once
#include "core/gpu/device.h"
#include "experiments/results/cells/cell.h"

#include <span>

/// The present maker of cells: {"ssrlab": build_info(), "device": {"name", "driver", "api", "type", "memory_mib"},
/// "host": host_info()}.
nlohmann::json maker_of_cells(const Device& device);

/// Cell::provenance: the maker with {"what": for readers, "started", "finished"}.
nlohmann::json cell_provenance(const nlohmann::json& maker, const std::string& what, const std::string& started);

/// manifest.json's `provenance`: each maker once, with its cells and their times.
nlohmann::json provenance_entries(std::span<const Cell> cells);
