#include "experiments/cell.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

namespace nlohmann {
template <class T>
struct adl_serializer<std::optional<T>> {
    static void to_json(json& j, const std::optional<T>& value) {
        if (value)
            j = *value;
        else
            j = nullptr;
    }
    static void from_json(const json& j, std::optional<T>& value) {
        if (j.is_null())
            value.reset();
        else
            value = j.get<T>();
    }
};
}  // namespace nlohmann

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ResultRow, shot, scene, camera, frame, width, height, variant, point, seed, target, metric, formula, mask,
                                   value, is_corrected, uncorrected, low, high, floor, pixels, non_finite, negative)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TimeRow, shot, variant, point, seed, stage, frame, milliseconds, clock)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Cell, rows, times, images)

std::optional<Cell> CellStore::load(const std::string& hash) const {
    const std::filesystem::path file = folder_ / (hash + ".json");
    if (!std::filesystem::exists(file)) return {};
    try {
        return read_json(file).get<Cell>();
    } catch (const std::exception&) {
        return {};  // a broken file is as good as none: the cell is done again
    }
}

void CellStore::save(const std::string& hash, const Cell& cell) const {
    write_text(folder_ / (hash + ".json"), nlohmann::json(cell).dump(1) + "\n");
}
