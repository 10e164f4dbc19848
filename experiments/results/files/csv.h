#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Reads a CSV file (RFC 4180, header first) row by row; columns are asked for by name. Every mistake is an Error that
/// names file, line and column.
///
///     for (CsvReader csv("times.csv"); csv.next();) sum += csv.number("milliseconds");
class CsvReader {
public:
    explicit CsvReader(std::filesystem::path file);

    bool next();                  ///< false at the end of the file
    size_t most_records() const;  ///< not fewer than the file has, without its header

    /// A column of the file, for the functions below: who reads many rows looks it up once.
    size_t place(const std::string& column) const;
    const std::string& text(size_t place) const { return fields_[place]; }
    double number(size_t place) const;                          ///< finite
    std::optional<double> optional_number(size_t place) const;  ///< none if the field is empty
    size_t count(size_t place) const;                           ///< a whole number >= 0

    const std::string& text(const std::string& column) const { return text(place(column)); }
    double number(const std::string& column) const { return number(place(column)); }
    std::optional<double> optional_number(const std::string& column) const { return optional_number(place(column)); }

private:
    bool read_record();
    void read_fields();
    std::string& new_field();
    [[noreturn]] void fail_at(size_t place, const char* allowed) const;

    std::filesystem::path file_;
    std::string content_;
    size_t at_ = 0, line_ = 1, record_line_ = 1;
    std::map<std::string, size_t> columns_;
    std::vector<std::string> fields_;
    size_t field_count_ = 0;  ///< of the record; `fields_` keeps the memory of longer ones
};

/// One line of a CSV file of the given values, with its line feed. Numbers are the shortest text that reads back
/// exactly.
std::string csv_field(double value);
std::string csv_field(const std::optional<double>& value);  ///< empty for nullopt
std::string csv_field(unsigned value);
std::string csv_field(size_t value);
std::string csv_field(bool value);  ///< 1 or 0
/// A text that a spreadsheet would read as a formula gets an apostrophe in front; CsvReader removes it.
std::string csv_field(const std::string& value);

template <class... Values>
std::string csv_line(const Values&... values) {
    std::string line;
    ((line += csv_field(values) + ","), ...);
    line.back() = '\n';
    return line;
}
