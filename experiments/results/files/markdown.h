#pragma once
#include <string>
#include <vector>

// Texts that somebody else may have written, in Markdown (CommonMark, GitHub's tables and mathematics): they are shown
// as they are, and make no link, no HTML, no line and no column.

/// A name in a sentence or in a cell of a table.
std::string markdown_text(const std::string& text);
/// A name as code in a sentence.
std::string markdown_code(const std::string& text);
/// `head`: in Markdown; `rows`: of texts as they are. Ends with an empty line.
std::string markdown_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);
