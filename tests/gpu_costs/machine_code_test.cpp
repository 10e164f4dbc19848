#include "experiments/gpu_costs/chips/machine_code.h"
#include "core/error.h"

#include <gtest/gtest.h>

namespace {

const ChipRates rates = *chip_rates("navi21");

/// A store of the mark of that number.
std::string mark(unsigned number) {
    return "\tbuffer_store_dword v2, off, s[8:11], 0 offset:" + std::to_string(first_mark_offset + 4 * number) +
           " glc ; e0704400\n";
}

/// Marks of as many blocks of a shader, each at its own place.
MarkedShader marks(unsigned count) {
    MarkedShader result{.recipe = {}, .blocks = {}, .shader_blocks = count};
    for (unsigned i = 0; i < count; ++i) result.blocks.push_back(i);
    return result;
}

void expect_runs(const BlockRuns& runs, unsigned block, double share, bool is_bound) {
    EXPECT_EQ(runs.shader_block, block);
    EXPECT_DOUBLE_EQ(runs.share, share);
    EXPECT_EQ(runs.is_bound, is_bound);
}

}  // namespace

TEST(MachineCode, WorkIsThatOfItsInstructions) {
    const MachineCode code = machine_code_of(
        "BB0:\n\tv_add_f32_e32 v0, v1, v2 ; 06000302\n\t(then repeated 3 times)\n\tv_rcp_f32_e32 v0, v0\n"
        "\tv_mul_lo_u32 v5, s4, v0\n\tv_fma_f64 v[0:1], v[2:3], v[4:5], v[6:7]\n\ts_add_u32 s1, s1, 1\n"
        "\ts_load_dwordx4 s[8:11], s[2:3], 0x80\n\ts_waitcnt lgkmcnt(0)\n\tds_read_b128 v[0:3], v9\n"
        "\timage_load v0, v[2:3], s[8:15] dmask:0x1 dim:SQ_RSRC_IMG_2D unorm\n"
        "\timage_sample_lz v5, v[6:7], s[8:15], s[20:23] dmask:0x2 dim:SQ_RSRC_IMG_2D\n"
        "\timage_store v[0:3], v[2:3], s[8:15] dmask:0xf dim:SQ_RSRC_IMG_2D unorm\n"
        "\tbuffer_load_dwordx2 v[4:5], v6, s[8:11], 0 offen\n\texp mrt0 v0, v1, v2, v3 done vm\n\ts_endpgm\n",
        64, rates);
    ASSERT_EQ(code.blocks.size(), 1u);
    const ChipWork& work = code.blocks[0].work;
    EXPECT_EQ(work.vector, 4 * 2 + 4 * 2 + 4 * 2 + 16 * 2);  // two halves of a wave of 64
    EXPECT_EQ(work.scalar, 2);
    EXPECT_EQ(work.shared, 64 * 16 / 128);
    EXPECT_EQ(work.loads, 64);
    EXPECT_EQ(work.samples, 64);
    EXPECT_EQ(work.stores, 64);
    EXPECT_EQ(work.buffers, 128);
    EXPECT_EQ(work.exports, 64);
    EXPECT_EQ(code.blocks[0].instructions, 17u);
    EXPECT_TRUE(code.blocks[0].successors.empty());
    EXPECT_THROW(machine_code_of("nothing of the kind\n", 64, rates), Error);
    EXPECT_THROW(machine_code_of("BB0:\n\ts_branch BB7\n", 64, rates), Error);
}

/// Where LLVM cannot print the code, Mesa lists it in its own way. RDNA 4 has one counter for each kind of load.
TEST(MachineCode, MesasOwnListingSaysTheSame) {
    const std::string assembly =
        "BB0:\n\tv_lshrrev_b32_e32 v0, 10, v0\n\ts_load_dwordx8 s[8:15], s[2:3], 0x20\n"
        "\tds_read_b128 v[4:7], v9\n\ts_waitcnt lgkmcnt(0)\n" +
        mark(1) +
        "\ts_cbranch_execz BB2\nBB1:\n\timage_load v2, v[0:1], s[8:15] dmask:0x1 dim:SQ_RSRC_IMG_2D unorm\n"
        "\timage_sample_lz v3, v[0:1], s[8:15], s[20:23] dmask:0x2 dim:SQ_RSRC_IMG_2D\n\ts_waitcnt vmcnt(1)\n"
        "\tv_mov_b32_e32 v5, v2\n\ts_waitcnt vmcnt(0)\nBB2:\n\ts_endpgm\n";
    const std::string listing =
        "Shader disassembly is not supported in the current configuration, falling back to print_program.\n\n"
        "ACO shader stage: SW (CS), HW (COMPUTE_SHADER)\nBB0\n/* logical preds: / linear preds: / kind: branch, */\n"
        "\t v1: %9:v[0] = v_lshrrev_b32 10, %658:v[0]\n\t s8: %32:s[8-15] = s_load_dwordx8 %31:s[2-3], 32\n"
        "\t v4: %33:v[4-7] = ds_read_b128 %34:v[9]\n\ts_wait_kmcnt imm:0\n\tbuffer_store_dword %7:s[8-11], v1: undef, "
        "0, "
        "%8:v[2] offset:" +
        std::to_string(first_mark_offset + 4) +
        " glc\n\ts_cbranch_execz block:BB2\nBB1\n/* logical preds: BB0, / kind: uniform, */\n"
        "\t v1: %682:v[2] = image_load %32:s[8-15],  s4: undef,  v1: undef, %7:v[0], %11:v[1] 2d unrm\n"
        "\t v1: %683:v[3] = image_sample_lz %32:s[8-15], %35:s[20-23],  v1: undef, %7:v[0], %11:v[1] dmask:y 2d\n"
        "\ts_wait_loadcnt imm:0\n\t v1: (precise)%690:v[5] = v_mov_b32 %682:v[2]\n\ts_wait_samplecnt imm:0\nBB2\n"
        "/* logical preds: BB1, BB0, / kind: uniform, */\n\ts_endpgm\n";
    const MachineCode a = machine_code_of(assembly, 64, rates), b = machine_code_of(listing, 64, rates);
    ASSERT_EQ(a.blocks.size(), 3u);
    EXPECT_TRUE(have_same_flow(a, b));
    for (size_t i = 0; i < 3; ++i) {
        const ChipWork &x = a.blocks[i].work, &y = b.blocks[i].work;
        EXPECT_EQ(a.blocks[i].instructions, b.blocks[i].instructions);
        EXPECT_EQ(a.blocks[i].marks, b.blocks[i].marks);
        EXPECT_EQ(
            std::tie(x.vector, x.scalar, x.shared, x.loads, x.samples, x.stores, x.buffers, x.exports, x.latency),
            std::tie(y.vector, y.scalar, y.shared, y.loads, y.samples, y.stores, y.buffers, y.exports, y.latency));
    }
    EXPECT_EQ(b.blocks[0].marks, std::vector<unsigned>{1});
    EXPECT_GT(b.blocks[1].work.latency, rates.memory_latency);
}

TEST(MachineCode, PaddingOfLoopsIsNoInstruction) {
    const MachineCode code = machine_code_of(
        "BB0:\n\tv_mov_b32 v0, v1\n\ts_inst_prefetch 0x3\n\ts_nop 0\n\ts_nop 0\nBB1:\n\tv_mov_b32 v0, v2\n"
        "\ts_cbranch_scc1 BB1\nBB2:\n\ts_set_inst_prefetch_distance 0x2\n\ts_endpgm\n",
        64, rates);
    ASSERT_EQ(code.blocks.size(), 3u);
    EXPECT_EQ(code.blocks[0].instructions, 1u);
    EXPECT_EQ(code.blocks[0].padding, 3u);
    EXPECT_EQ(code.blocks[2].padding, 1u);
}

/// BB0 jumps over BB1 where no lane is left; BB2 follows both; BB3 is a loop that BB4 ends.
TEST(MachineCode, BlocksWithoutMarksRunAsThoseThatLeadToThem) {
    const MachineCode code = machine_code_of("BB0:\n" + mark(0) +
                                                 "\ts_cbranch_execz BB2\nBB1:\n\tv_mov_b32 v0, v1\nBB2:\n"
                                                 "\tv_mov_b32 v0, v1\nBB3:\n" +
                                                 mark(1) +
                                                 "\ts_cbranch_scc0 BB5\nBB4:\n"
                                                 "\tv_mov_b32 v0, v1\n\ts_branch BB3\nBB5:\n\ts_endpgm\n",
                                             64, rates);
    const std::vector<BlockRuns> runs = runs_of(code, marks(2));
    ASSERT_EQ(runs.size(), 6u);
    expect_runs(runs[0], 0, 1, false);
    expect_runs(runs[1], 0, 1, true);   // may be jumped over
    expect_runs(runs[2], 0, 1, false);  // is not
    expect_runs(runs[3], 1, 1, false);
    expect_runs(runs[4], 1, 1, true);   // a loop's head runs once more than its body
    expect_runs(runs[5], 0, 1, false);  // behind the loop: as often as what led to it
    EXPECT_TRUE(have_same_flow(code, code));
}

/// A loop of three turns that was unrolled: each copy has a third, and a block that also starts something else is that.
TEST(MachineCode, CopiesOfAMarkShareItsRuns) {
    const MachineCode code = machine_code_of("BB0:\n" + mark(0) + mark(1) + "\ts_cbranch_execz BB3\nBB1:\n" + mark(1) +
                                                 "\ts_cbranch_execz BB3\nBB2:\n" + mark(1) + "BB3:\n\ts_endpgm\n",
                                             64, rates);
    const std::vector<BlockRuns> runs = runs_of(code, marks(2));
    expect_runs(runs[0], 0, 1, false);
    expect_runs(runs[1], 1, 1.0 / 3, false);
    expect_runs(runs[2], 1, 1.0 / 3, false);
    expect_runs(runs[3], 0, 1, false);
    EXPECT_THROW(runs_of(code, marks(1)), Error);  // a store that is no mark of the shader
}
