#include "experiments/gpu_costs/chips/machine_code.h"

#include "core/error.h"
#include "experiments/gpu_costs/spirv/flow_graph.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <map>
#include <sstream>

namespace {

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> starts) {
    return std::ranges::any_of(starts, [&](std::string_view start) { return name.starts_with(start); });
}

/// The number behind `key`; nothing without it.
std::optional<unsigned> number_behind(std::string_view text, std::string_view key) {
    const size_t at = text.find(key);
    unsigned value = 0;
    if (at == text.npos) return {};
    const char* const begin = text.data() + at + key.size();
    if (std::from_chars(begin, text.data() + text.size(), value).ec != std::errc()) return {};
    return value;
}

struct Line {
    std::string_view name, rest;
};

/// A line of assembly without the bytes of its code; nothing of labels and comments. In Mesa's own listing
/// (`v1: %6:v[1] = v_and_b32 7, %658:v[0]`), what stands left of the instruction is left out.
std::optional<Line> line_of(std::string_view text) {
    if (!text.starts_with("\t") || text.starts_with("\t(")) return {};
    text = text.substr(1, text.find(';') - 1);
    if (const size_t defined = text.find(" = "); defined != text.npos) text.remove_prefix(defined + 3);
    const size_t end = text.find_first_of(" \t\n");
    return Line{text.substr(0, end), end == text.npos ? "" : text.substr(end + 1)};
}

enum class Unit { vector, scalar, shared, load, sample, store, buffer, exported, branch, none };

Unit unit_of(std::string_view name) {
    if (name.starts_with("v_")) return Unit::vector;
    if (is_one_of(name, {"s_cbranch", "s_branch"})) return Unit::branch;
    if (is_one_of(name, {"s_wait", "s_nop", "s_endpgm", "s_clause", "s_inst_prefetch", "s_delay_alu", "s_barrier",
                         "s_sendmsg", "s_code_end", "s_setprio", "s_sleep", "s_ttrace"}))
        return Unit::none;
    if (name.starts_with("s_")) return Unit::scalar;
    if (is_one_of(name, {"ds_", "lds_"})) return Unit::shared;
    if (is_one_of(name, {"image_store", "image_atomic"})) return Unit::store;
    if (name.starts_with("image_load")) return Unit::load;
    if (name.starts_with("image_")) return Unit::sample;
    if (is_one_of(name, {"buffer_", "tbuffer_", "global_", "flat_", "scratch_"})) return Unit::buffer;
    if (name.starts_with("exp")) return Unit::exported;
    return Unit::none;
}

double vector_clocks(std::string_view name, unsigned lanes, const ChipRates& rates) {
    const double whole = std::max(1.0, double(lanes) / rates.simd_lanes);
    if (name.find("_f64") != name.npos) return whole * rates.slow_double;
    if (is_one_of(name, {"v_mad_u64", "v_mad_i64", "v_lshlrev_b64", "v_lshrrev_b64", "v_ashrrev_i64"}))
        return whole * 2;
    if (is_one_of(name, {"v_rcp_", "v_rsq_", "v_sqrt_", "v_exp_", "v_log_", "v_sin_", "v_cos_"}))
        return whole * rates.slow;
    if (is_one_of(name, {"v_mul_lo_u32", "v_mul_lo_i32", "v_mul_hi_u32", "v_mul_hi_i32"}))
        return whole * rates.slow_integer;
    return whole;
}

/// Of a lane: by the name's end, "_b64" or "_dwordx4", and two of them if it has two addresses.
double words_of(std::string_view name) {
    double words = 1;
    for (const auto& [end, count] :
         {std::pair{"x2", 2}, {"b64", 2}, {"u64", 2}, {"x3", 3}, {"b96", 3}, {"x4", 4}, {"b128", 4}})
        if (name.ends_with(end)) words = count;
    return is_one_of(name, {"ds_read2", "ds_write2", "ds_load_2addr", "ds_store_2addr"}) ? 2 * words : words;
}

ChipWork work_of(const Line& line, Unit unit, unsigned lanes, const ChipRates& rates) {
    ChipWork work;
    switch (unit) {
        case Unit::vector:
            work.vector = vector_clocks(line.name, lanes, rates);
            break;
        case Unit::scalar:
            work.scalar = 1;
            break;
        case Unit::shared:
            work.shared = lanes * words_of(line.name) * 4 / rates.shared_bytes;
            break;
        case Unit::load:
            work.loads = lanes;
            break;
        case Unit::sample:
            work.samples = lanes;
            break;
        case Unit::store:
            work.stores = lanes;
            break;
        case Unit::buffer:
            work.buffers = lanes * words_of(line.name);
            break;
        case Unit::exported:
            work.exports = lanes;
            break;
        case Unit::branch:
        case Unit::none:
            break;
    }
    return work;
}

/// A store of a mark: to a constant place of a buffer.
std::optional<unsigned> mark_of(const Line& line) {
    if (!is_one_of(line.name, {"buffer_store_dword", "buffer_store_b32"})) return {};
    if (line.rest.find(", off, ") == line.rest.npos && line.rest.find("v1: undef") == line.rest.npos) return {};
    const std::optional<unsigned> offset = number_behind(line.rest, "offset:");
    if (!offset || *offset < first_mark_offset) return {};
    return (*offset - first_mark_offset) / 4;
}

/// Steps through a block as a wave does that has a SIMD for itself. What vector instructions give is taken to be there
/// at once.
class WaveClock {
public:
    explicit WaveClock(const ChipRates& rates) : rates_(rates) {}

    void step(const Line& line, Unit unit, double clocks) {
        now_ += unit == Unit::none ? 0 : std::max(1.0, clocks);
        const bool is_load = unit == Unit::load || unit == Unit::sample ||
                             (unit == Unit::buffer && line.name.find("_load") != line.name.npos);
        if (is_load || (rates_.waits_for_stores && (unit == Unit::store || unit == Unit::buffer)))
            count({"vmcnt", unit == Unit::sample ? "samplecnt" : "loadcnt"},
                  is_load ? now_ + rates_.memory_latency : now_);
        if (is_one_of(line.name, {"s_load", "s_buffer_load"}))
            count({"lgkmcnt", "kmcnt"}, now_ + rates_.scalar_latency);
        if (unit == Unit::shared) count({"lgkmcnt", "dscnt"}, now_ + rates_.shared_latency);
        if (!line.name.starts_with("s_wait")) return;
        for (auto& [counter, loads] : loads_) {
            const bool is_named = line.name.find(counter) != line.name.npos;  // s_wait_loadcnt imm:0, of RDNA 4
            if (const auto most = number_behind(line.rest, is_named ? "imm:" : counter + "(")) wait(loads, *most);
        }
    }
    double now() const { return now_; }

private:
    void count(std::initializer_list<const char*> counters, double there) {
        for (const char* counter : counters) loads_[counter].push_back(there);
    }

    /// Until there are `most` of them, which come in order.
    void wait(std::deque<double>& loads, size_t most) {
        for (; loads.size() > most; loads.pop_front()) now_ = std::max(now_, loads.front());
    }

    const ChipRates& rates_;
    double now_ = 0;
    /// When they will have come, by the counter that waits for them. RDNA 4 has more counters than its predecessors.
    std::map<std::string, std::deque<double>> loads_;
};

/// The lines of each block, by its label. "": before the first label.
using BlockLines = std::vector<std::pair<std::string, std::vector<Line>>>;

BlockLines block_lines(std::string_view assembly) {
    BlockLines blocks;
    while (!assembly.empty()) {
        const size_t end = std::min(assembly.find('\n'), assembly.size() - 1);
        const std::string_view text = assembly.substr(0, end);
        assembly.remove_prefix(end + 1);
        const std::optional<Line> line = line_of(text);
        const std::optional<unsigned> repeats = number_behind(text, "(then repeated ");  // as Mesa prints equal lines
        if (repeats && !blocks.empty() && !blocks.back().second.empty())
            blocks.back().second.insert(blocks.back().second.end(), *repeats, Line(blocks.back().second.back()));
        else if (text.starts_with("BB"))
            blocks.push_back({std::string(text.substr(0, text.find(':'))), {}});
        else if (line && blocks.empty())
            blocks.push_back({"", {*line}});
        else if (line)
            blocks.back().second.push_back(*line);
    }
    return blocks;
}

}  // namespace

void ChipWork::add(const ChipWork& other, double times) {
    vector += other.vector * times, scalar += other.scalar * times, shared += other.shared * times;
    loads += other.loads * times, samples += other.samples * times, stores += other.stores * times;
    buffers += other.buffers * times, exports += other.exports * times, latency += other.latency * times;
}

MachineCode machine_code_of(const std::string& assembly, unsigned lanes, const ChipRates& rates) {
    const BlockLines all = block_lines(assembly);
    if (all.empty()) fail("the machine code of a shader cannot be read");
    std::map<std::string, unsigned, std::less<>> places;
    for (const auto& [label, lines] : all) places.emplace(label, unsigned(places.size()));
    MachineCode code;
    for (const auto& [label, lines] : all) {
        MachineCode::Block& block = code.blocks.emplace_back();
        WaveClock clock(rates);
        bool falls_through = code.blocks.size() < all.size();
        for (const Line& line : lines) {
            if (const auto mark = mark_of(line)) {
                block.marks.push_back(*mark);
                continue;
            }
            const Unit unit = unit_of(line.name);
            const ChipWork work = work_of(line, unit, lanes, rates);
            block.work.add(work, 1);
            ++(is_one_of(line.name, {"s_nop", "s_inst_prefetch", "s_set_inst_prefetch"}) ? block.padding
                                                                                         : block.instructions);
            clock.step(line, unit, work.vector);
            if (unit == Unit::branch) {
                std::string_view label = line.rest.substr(0, line.rest.find_first_of(" \t"));
                if (label.starts_with("block:")) label.remove_prefix(label.find(':') + 1);  // in Mesa's listing
                const auto target = places.find(label);
                if (target == places.end()) fail("machine code jumps to a place that it lacks: ", line.rest);
                block.successors.push_back(target->second);
            }
            if (is_one_of(line.name, {"s_branch", "s_endpgm"})) falls_through = false;
        }
        block.work.latency = clock.now();
        if (falls_through) block.successors.push_back(unsigned(code.blocks.size()));
    }
    return code;
}

bool have_same_flow(const MachineCode& a, const MachineCode& b) {
    return std::ranges::equal(a.blocks, b.blocks, {}, &MachineCode::Block::successors, &MachineCode::Block::successors);
}

std::vector<BlockRuns> runs_of(const MachineCode& code, const MarkedShader& marked) {
    std::vector<unsigned> copies(marked.blocks.size(), 0);
    for (const MachineCode::Block& block : code.blocks)
        for (const unsigned mark : block.marks) {
            if (mark >= copies.size()) fail("a shader stores where marks are");
            ++copies[mark];
        }

    FlowGraph graph(code.blocks.size());
    for (size_t b = 0; b < code.blocks.size(); ++b)
        for (const unsigned next : code.blocks[b].successors) graph.add_edge(b, next);
    const std::vector<unsigned> before = nearest_dominators(graph), after = nearest_postdominators(graph);
    const std::vector<unsigned> depth = loop_depths(graph);

    std::vector<BlockRuns> runs(code.blocks.size());
    for (const size_t b : graph.order()) {
        const std::vector<unsigned>& marks = code.blocks[b].marks;
        if (!marks.empty()) {
            const unsigned mark = *std::ranges::min_element(marks, {}, [&](unsigned m) { return copies[m]; });
            runs[b] = {.shader_block = marked.blocks[mark], .share = 1.0 / copies[mark], .is_bound = false};
            continue;
        }
        size_t nearest = before[b];
        while (nearest < code.blocks.size() && depth[nearest] > depth[b]) nearest = before[nearest];
        if (nearest == code.blocks.size()) fail("a block of machine code follows no mark");
        size_t passed = after[nearest];
        while (passed < code.blocks.size() && passed != b) passed = after[passed];
        runs[b] = runs[nearest];
        runs[b].is_bound = runs[nearest].is_bound || passed != b || depth[nearest] != depth[b];
    }
    return runs;
}
