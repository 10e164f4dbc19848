#pragma once
#include <array>
#include <optional>
#include <string>

/// What a GPU's compiler states about one shader. Numbers are empty if it does not state them, or if a newer Mesa uses
/// another name.
struct CompilerNumbers {
    unsigned lanes = 0;                                                ///< of a wave: 32 or 64
    std::optional<double> vgprs, sgprs, spilled_vgprs, spilled_sgprs;  ///< registers of a lane and of a wave
    std::optional<double> scratch_bytes;                               ///< of a wave in memory, spills included
    std::optional<double> lds_bytes;                                   ///< of a workgroup
    std::optional<double> code_bytes, instructions, branches;
    /// The compiler's own estimate for a wave, in cycles: until it ends, and how long it keeps the busiest unit. It
    /// assumes that loops run 8, 4, 2 times by depth, and that 3 of 4 divergent branches are taken.
    std::optional<double> latency, inverse_throughput;
    std::string hash;  ///< of the machine code, as the driver states it
};

struct CompilerNumber {
    const char* name;       ///< name of the column
    const char* statistic;  ///< name in Mesa's radv
    std::optional<double> CompilerNumbers::*member;
};

inline constexpr std::array compiler_numbers = {
    CompilerNumber{"vgprs", "VGPRs", &CompilerNumbers::vgprs},
    CompilerNumber{"sgprs", "SGPRs", &CompilerNumbers::sgprs},
    CompilerNumber{"spilled_vgprs", "Spilled VGPRs", &CompilerNumbers::spilled_vgprs},
    CompilerNumber{"spilled_sgprs", "Spilled SGPRs", &CompilerNumbers::spilled_sgprs},
    CompilerNumber{"scratch_bytes", "Scratch size", &CompilerNumbers::scratch_bytes},
    CompilerNumber{"lds_bytes", "LDS size", &CompilerNumbers::lds_bytes},
    CompilerNumber{"code_bytes", "Code size", &CompilerNumbers::code_bytes},
    CompilerNumber{"instructions", "Instructions", &CompilerNumbers::instructions},
    CompilerNumber{"branches", "Branches", &CompilerNumbers::branches},
    CompilerNumber{"latency", "Latency", &CompilerNumbers::latency},
    CompilerNumber{"inverse_throughput", "Inverse Throughput", &CompilerNumbers::inverse_throughput},
};
