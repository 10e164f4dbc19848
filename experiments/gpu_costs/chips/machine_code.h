#pragma once
#include "experiments/gpu_costs/chips/chip_rates.h"
#include "experiments/gpu_costs/chips/marked_shader.h"

#include <array>

/// The work of a wave for the parts of a chip.
struct ChipWork {
    double vector = 0;   ///< clocks of its SIMD
    double scalar = 0;   ///< instructions of scalar arithmetic and loads
    double shared = 0;   ///< clocks of the workgroup's memory
    double loads = 0;    ///< lanes of image loads without a filter
    double samples = 0;  ///< lanes of samples and gathers
    double stores = 0;   ///< lanes of image stores and atomics
    double buffers = 0;  ///< words of buffers' loads and stores, of all lanes
    double exports = 0;  ///< lanes of exports: writes of fragments to colour targets
    double latency = 0;  ///< clocks of the wave alone: issue and waiting

    void add(const ChipWork& other, double times);
};

/// The machine code of a shader as radv prints it.
struct MachineCode {
    struct Block {
        std::vector<unsigned> successors, marks;  ///< places in `blocks`; marks as MarkedShader has them
        ChipWork work;                            ///< of a wave that runs it once, without marks
        unsigned instructions = 0;                ///< without padding
        unsigned padding = 0;  ///< instructions that align loops: newer versions of Mesa state them in no number
    };
    std::vector<Block> blocks;
};

/// Parses the assembly. `lanes`: of a wave; inactive lanes cost as much. Fails with Error on a text that cannot be
/// parsed.
MachineCode machine_code_of(const std::string& assembly, unsigned lanes, const ChipRates& rates);

/// Whether both have the same blocks and edges.
bool have_same_flow(const MachineCode& a, const MachineCode& b);

/// The source of the number of runs of a block of machine code.
struct BlockRuns {
    unsigned shader_block = 0;  ///< index into ShaderFlow::blocks
    double share = 0;           ///< runs for each run of that block
    bool is_bound = false;      ///< no mark, and the block may have been skipped: the number is an upper bound
};

/// By block of the code. A block without a mark runs as often as the nearest block of its own loop that all paths to it
/// pass. Where a mark stands in several blocks, for example of an unrolled loop, each has its share.
std::vector<BlockRuns> runs_of(const MachineCode& code, const MarkedShader& marked);
