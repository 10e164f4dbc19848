#include "experiments/results/cells/file_name.h"

#include "core/files.h"

#include <cctype>

std::string file_name(const std::string& text, size_t longest) {
    std::string name = text;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '-';
    if (name.size() <= longest) return name;
    ContentHash hash;
    hash.add(text);
    const std::string end = "-" + hash.hex().substr(0, 12);
    return name.substr(0, longest - end.size()) + end;
}
