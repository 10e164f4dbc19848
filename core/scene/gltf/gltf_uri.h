#pragma once
#include "core/reading_limits.h"

#include <filesystem>
#include <string>
#include <string_view>

/// Whether the URI holds its data itself (RFC 2397); the scheme is of any case.
bool is_data_uri(std::string_view uri);

/// The URI as messages show it, without the data that it may hold: "data:image/png (1234 bytes)".
std::string shown_uri(const std::string& uri);

/// The bytes of a data URI of any media type and parameters, in base64 or percent-encoded. Fails with Error, which
/// begins with `what`, where it has no comma or a letter that is no base64.
std::string decode_data_uri(std::string_view uri, const std::string& what);

/// The file which a relative URI names, below `folder` (file_below() of reading_limits.h). %20 and its like stand for
/// bytes, a '+' for itself (RFC 3986). Where there is no such file, the URI as it is written and with '\' as '/' are
/// looked for, too: exporters write names without percent-encoding. The file need not exist. Fails with Error for other
/// schemes than that of files beside the glTF. `named_by` begins messages.
std::filesystem::path file_of_uri(const std::filesystem::path& folder, const std::string& uri,
                                  const std::string& named_by);

/// The bytes of a data URI, or of the file that the URI names. Fails with Error, which begins with `what`.
std::string read_uri(const std::filesystem::path& folder, const std::string& uri, const std::string& what);
