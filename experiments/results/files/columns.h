#pragma once
#include "core/files.h"
#include "experiments/results/files/csv.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

/// A column of a table: the name in CSV files, cells and the report's data, and the row's member. A member is a text, a
/// number (`std::optional<double>` if it may be missing), or a bool (1 or 0 in CSV files).
template <class Row, class Value>
struct Column {
    const char* name;
    Value Row::*member;
};

/// A tuple of columns that are named like their members.
#define MEMBER_COLUMNS(Row, ...)                                                                  \
    [] {                                                                                          \
        using Of = Row;                                                                           \
        return std::tuple{NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(MEMBER_COLUMN, __VA_ARGS__))}; \
    }()
#define MEMBER_COLUMN(name) Column{#name, &Of::name},

/// Declares the columns of a row if all are named like their members. Otherwise the row defines `columns()` itself.
#define COLUMNS(Row, ...) \
    static constexpr auto columns() { return MEMBER_COLUMNS(Row, __VA_ARGS__); }

/// Calls `use(column)` for each column of a table, in order.
template <class Row, class Use>
void for_each_column(Use use) {
    std::apply([&](const auto&... column) { (use(column), ...); }, Row::columns());
}

/// When a results folder has a table's file.
enum class TableUse {
    always,   ///< every folder has the file
    of_runs,  ///< every folder; one row for each run, so it is read on demand only
    if_any,   ///< no file where there are no rows
};

/// A table of a results folder: the name of its file without `.csv`, and the member with its rows.
template <class Tables, class Row>
struct Table {
    const char* name;
    std::vector<Row> Tables::*rows;
    TableUse use;
};

template <class Row>
std::string csv_header() {
    std::string line;
    for_each_column<Row>([&](const auto& column) { line += std::string(column.name) + ","; });
    line.back() = '\n';
    return line;
}

template <class Row>
void append_csv_row(std::string& text, const Row& row) {
    for_each_column<Row>([&](const auto& column) { (text += csv_field(row.*column.member)) += ','; });
    text.back() = '\n';
}

/// Writes a table with its header; the header alone if there are no rows.
template <class Rows>
void write_rows(const std::filesystem::path& file, const Rows& rows) {
    using Row = std::remove_cvref_t<decltype(*std::begin(rows))>;
    std::string text = csv_header<Row>();
    for (const Row& row : rows) append_csv_row(text, row);
    write_text(file, text);
}

inline void read_field(const CsvReader& csv, size_t place, std::string& value) { value = csv.text(place); }
inline void read_field(const CsvReader& csv, size_t place, double& value) { value = csv.number(place); }
inline void read_field(const CsvReader& csv, size_t place, size_t& value) { value = csv.count(place); }
inline void read_field(const CsvReader& csv, size_t place, bool& value) { value = csv.count(place) != 0; }
inline void read_field(const CsvReader& csv, size_t place, std::optional<double>& value) {
    value = csv.optional_number(place);
}
inline void read_field(const CsvReader& csv, size_t place, unsigned& value) {
    value = unsigned(std::min<size_t>(csv.count(place), std::numeric_limits<unsigned>::max()));
}

/// Reads a table; other columns are ignored. Fails with Error on a file that cannot be read, lacks a column, or holds
/// an invalid value.
template <class Row>
std::vector<Row> read_rows(const std::filesystem::path& file) {
    std::vector<Row> rows;
    CsvReader csv(file);
    std::vector<size_t> places;
    for_each_column<Row>([&](const auto& column) { places.push_back(csv.place(column.name)); });
    rows.reserve(csv.most_records());
    while (csv.next()) {
        Row& row = rows.emplace_back();
        auto place = places.begin();
        for_each_column<Row>([&](const auto& column) { read_field(csv, *place++, row.*column.member); });
    }
    return rows;
}

inline nlohmann::json column_json(const std::optional<double>& value) {
    return value ? nlohmann::json(*value) : nullptr;
}
template <class Value>
nlohmann::json column_json(const Value& value) {
    return value;
}

inline void read_json(const nlohmann::json& json, std::optional<double>& value) {
    value = json.is_null() ? std::nullopt : std::optional(json.get<double>());
}
template <class Value>
void read_json(const nlohmann::json& json, Value& value) {
    json.get_to(value);
}

/// {column: value}; null for a missing value.
template <class Row>
nlohmann::json row_json(const Row& row) {
    nlohmann::json json = nlohmann::json::object();
    for_each_column<Row>([&](const auto& column) { json[column.name] = column_json(row.*column.member); });
    return json;
}

/// Fails with nlohmann::json::exception if a column is missing or of another type.
template <class Row>
Row row_from_json(const nlohmann::json& json) {
    Row row{};
    for_each_column<Row>([&](const auto& column) { read_json(json.at(column.name), row.*column.member); });
    return row;
}
