#pragma once
#include "experiments/gpu_costs/chips/chip_rates.h"
#include "experiments/gpu_costs/chips/marked_shader.h"

#include <array>

/// What a wave asks of the parts of a chip.
struct ChipWork {
    double vector = 0;   ///< clocks of its SIMD
    double scalar = 0;   ///< instructions of scalar arithmetic and loads
    double shared = 0;   ///< clocks of the workgroup's memory
    double loads = 0;    ///< lanes of image loads without a filter
    double samples = 0;  ///< lanes of samples and gathers
    double stores = 0;   ///< lanes of image stores and atomics
    double buffers = 0;  ///< words of buffers' loads and stores, of all lanes
    double exports = 0;  ///< lanes of exports: what a fragment gives to a colour target
    double latency = 0;  ///< clocks until it has ended, if it is alone: what it issues, and what it waits for

    void add(const ChipWork& other, double times);
};

/// The machine code of a shader as radv prints it.
struct MachineCode {
    struct Block {
        std::vector<unsigned> successors, marks;  ///< places in `blocks`; marks as MarkedShader has them
        ChipWork work;                            ///< of a wave that runs it once; marks aside
        unsigned instructions = 0;
    };
    std::vector<Block> blocks;
};

/// `lanes`: of a wave; inactive ones cost as much. Fails with Error on a text that cannot be read.
MachineCode machine_code_of(const std::string& assembly, unsigned lanes, const ChipRates& rates);

/// Whether both have the same blocks with the same ways between them.
bool have_same_flow(const MachineCode& a, const MachineCode& b);

/// Where the number of a block's runs comes from.
struct BlockRuns {
    unsigned shader_block = 0;  ///< a place in ShaderFlow::blocks
    double share = 0;           ///< runs for each run of that
    bool is_bound = false;      ///< no mark says it, and it may have been jumped over: at most so many
};

/// By block of the code. One without a mark runs as often as the nearest one that all ways to it pass in its own loop.
/// Where a mark stands in several blocks, as in a loop that was unrolled, each has its part.
std::vector<BlockRuns> runs_of(const MachineCode& code, const MarkedShader& marked);
