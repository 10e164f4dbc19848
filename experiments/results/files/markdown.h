#pragma once
#include <string>
#include <vector>

// Escapes texts of unknown authors for Markdown (CommonMark, GitHub's tables and mathematics). They appear as they are
// and make no link, HTML, line or column.

/// A name in a sentence or in a cell of a table.
std::string markdown_text(const std::string& text);
/// A name as code in a sentence.
std::string markdown_code(const std::string& text);
/// A table. `head` is Markdown; `rows` are plain texts. Ends with an empty line.
std::string markdown_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);
