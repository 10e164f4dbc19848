#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// A source file of ssrlab: C++, GLSL, or a table that is read at run time.
struct SourceFile {
    std::string path;                   ///< from the project's root
    std::string hash;                   ///< hash of the bytes
    std::vector<std::string> includes;  ///< files that it includes in quotes, as written
};

/// The sources of core, groundtruth, metrics, variants and experiments below `root`, without benchmarks, ordered by
/// path. Fails with MachineError if one cannot be read.
std::vector<SourceFile> read_sources(const std::filesystem::path& root);

/// One line for each source: path, hash, includes.
std::string source_table(const std::vector<SourceFile>& sources);
std::vector<SourceFile> parse_source_table(std::string_view table);

/// The sources that a number depends on, so that an edit redoes what may have changed and nothing else.
///
/// - A source needs what it includes.
/// - In core, groundtruth, metrics, variants and gpu_costs, whatever needs a source needs its whole folder: a class may
///   be spread over several files. A folder within one of these must therefore have a header that is included from
///   outside.
/// - In the rest of experiments, a header needs the source of its name: each source implements its own header alone.
/// - Nothing depends on code that reads configs: cells hold the values that were read.
/// - Techniques and tracers are declared by name (variants/registry.cpp, variants/tracers/tracers.cpp) and included by
///   nothing that runs them, so they are asked for by folder.
class SourceCode {
public:
    explicit SourceCode(std::vector<SourceFile> sources);

    /// All sources that `roots` need, including themselves: sources, or folders with names that end in "/". An unknown
    /// name is a mistake of the program.
    std::set<std::string> needed_by(const std::vector<std::string>& roots) const;
    /// The hash of needed_by(roots).
    std::string hash_of(const std::vector<std::string>& roots) const;

private:
    std::map<std::string, SourceFile> sources_;
};
