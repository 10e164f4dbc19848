#include "experiments/results/files/csv.h"

#include "core/digits.h"
#include "core/error.h"
#include "core/files.h"
#include "core/list_text.h"
#include "core/near_miss.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ranges>

namespace {

/// Whether a spreadsheet would take a text for a formula, or would once an apostrophe before it is gone.
bool is_formula(std::string_view text) {
    const size_t at = text.find_first_not_of('\'');
    return at != std::string_view::npos && std::string_view("=+-@\t\r").find(text[at]) != std::string_view::npos;
}

bool is_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

CsvReader::CsvReader(std::filesystem::path file) : file_(std::move(file)), content_(read_text(file_)) {
    if (!read_record()) fail(file_.string(), " is empty: its first line must name the columns");
    for (size_t i = 0; i < field_count_; ++i)
        if (!columns_.emplace(fields_[i], i).second)
            fail(file_.string(), ":1: the column '", fields_[i], "' is named twice");
}

bool CsvReader::next() {
    if (!read_record()) return false;
    if (field_count_ != columns_.size())
        fail(file_.string(), ":", record_line_, ": ", field_count_, " fields, but the first line names ",
             columns_.size(), " columns");
    return true;
}

size_t CsvReader::most_records() const {
    const auto lines = size_t(std::ranges::count(content_, '\n'));
    return std::min(lines, content_.size() / columns_.size());  // a record has a separator or line feed a column
}

bool CsvReader::read_record() {
    if (at_ == content_.size()) return false;
    read_fields();
    for (size_t i = 0; i < field_count_; ++i)
        if (std::string& field = fields_[i]; field.starts_with('\'') && is_formula(field))
            field.erase(0, 1);  // as csv_field() wrote it
    return true;
}

std::string& CsvReader::new_field() {
    if (field_count_ == fields_.size()) fields_.emplace_back();
    std::string& field = fields_[field_count_++];
    field.clear();
    return field;
}

void CsvReader::read_fields() {
    record_line_ = line_;
    field_count_ = 0;
    std::string* field = &new_field();
    bool is_quoted = false;
    for (; at_ < content_.size(); ++at_) {
        const char c = content_[at_];
        if (c == '\n') ++line_;
        if (is_quoted) {
            const bool is_double_quote = c == '"' && content_.compare(at_ + 1, 1, "\"") == 0;
            if (c == '"' && !is_double_quote) {
                is_quoted = false;
            } else {
                *field += c;
                if (is_double_quote) ++at_;
            }
        } else if (c == '"' && field->empty()) {
            is_quoted = true;
        } else if (c == ',') {
            field = &new_field();
        } else if (c == '\n') {
            ++at_;
            return;
        } else if (c != '\r') {
            *field += c;
        }
    }
    if (is_quoted) fail(file_.string(), ":", record_line_, ": a quoted field is not closed");
}

void CsvReader::fail_at(size_t place, const char* allowed) const {
    const auto column = std::ranges::find(columns_, place, [](const auto& entry) { return entry.second; });
    fail(file_.string(), ":", record_line_, ": '", column->first, "' = \"", text(place), "\" is not ", allowed);
}

size_t CsvReader::place(const std::string& column) const {
    const auto found = columns_.find(column);
    if (found == columns_.end())
        fail(file_.string(), " has no column '", column, "'", suggestion(column, names_of(std::views::keys(columns_))));
    return found->second;
}

double CsvReader::number(size_t place) const {
    const std::string& field = text(place);
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
        fail_at(place, "a finite number");
    return value;
}

std::optional<double> CsvReader::optional_number(size_t place) const {
    if (text(place).empty()) return {};
    return number(place);
}

size_t CsvReader::count(size_t place) const {
    const std::string& field = text(place);
    size_t value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size()) fail_at(place, "a whole number from 0");
    return value;
}

std::string csv_field(double value) { return shortest_digits(value); }

std::string csv_field(const std::optional<double>& value) { return value ? csv_field(*value) : ""; }
std::string csv_field(unsigned value) { return std::to_string(value); }
std::string csv_field(size_t value) { return std::to_string(value); }
std::string csv_field(bool value) { return value ? "1" : "0"; }

std::string csv_field(const std::string& value) {
    const std::string text = is_formula(value) && !is_number(value) ? "'" + value : value;
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}
