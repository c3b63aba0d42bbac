#include "engine/model/report/report.hpp"

#include <map>

namespace rs::engine::model {
namespace {

struct FifoEnds {
    std::string from;
    std::string to;
};

// Blocks and FIFOs of pipe 0 represent those of all pipes: "texel_tags_pN".
bool is_of_other_pipe(const std::string& name) {
    const std::string without = name_without_pipe(name);
    return without != name && name != without + "_p0";
}
std::string shown(const std::string& name) {
    const std::string without = name_without_pipe(name);
    return without == name ? name : without + "_pN";
}

void add_blocks(const Simulator::DomainParts& parts, const char* clock, std::string& out,
                std::map<std::string, FifoEnds>& ends) {
    for (const Block* block : parts.blocks) {
        std::string in;
        std::string outs;
        for (const Port& port : block->ports()) {
            const bool reads = port.direction == Port::Direction::in;
            (reads ? ends[port.fifo].to : ends[port.fifo].from) = shown(block->name());
            if (is_of_other_pipe(port.fifo)) continue;
            std::string& list = reads ? in : outs;
            list += (list.empty() ? "" : ", ") + shown(port.fifo);
        }
        if (is_of_other_pipe(block->name())) continue;
        out +=
            "| " + shown(block->name()) + " | " + clock + " | " + block->timing() + " | " + in + " | " + outs + " |\n";
    }
}

template <class F>
std::string fifo_row(const F& fifo, const std::map<std::string, FifoEnds>& ends, const char* kind) {
    const auto at = ends.find(fifo.name());
    if (is_of_other_pipe(fifo.name())) return {};
    const FifoEnds none;
    const FifoEnds& e = at == ends.end() ? none : at->second;
    return "| " + shown(fifo.name()) + " | " + std::to_string(fifo.depth()) + " | " +
           std::to_string(fifo.width_bits()) + " | " + e.from + " | " + e.to + " | " + kind + " |\n";
}

std::string memory_table(const PipeMemoryBits& bits) {
    const auto row = [](const char* what, std::size_t n) {
        return std::string("| ") + what + " | " + std::to_string(n) + " |\n";
    };
    return "\n| block RAM of a pipe | bits |\n|---|---|\n" +
           row("codebooks, two sets (double_buffered_codebook)", bits.books) +
           row("cells of two stripes (cell_march)", bits.cells) +
           row("words of the last column's cells (cell_march)", bits.held_words) +
           row("pixels under way (cell_march)", bits.march_pixels) +
           row("effective depths (cell_march)", bits.effective_depths) +
           row("pixels at rims (surface_blend)", bits.rim_pixels) + row("texels (texel_cache)", bits.texels) +
           row("patches (patch_store)", bits.patches) +
           row("columns of two stripes (ray_rise, cell_march, sample_place)", bits.columns) +
           row("FIFOs of 64 places and more", bits.fifos) + row("all", bits.all());
}

}  // namespace

std::string diagram_tables(const BoardTop& board) {
    const Simulator::DomainParts& on_board = board.simulator.parts(Domain::board);
    const Simulator::DomainParts& on_bus = board.simulator.parts(Domain::pci);
    std::map<std::string, FifoEnds> ends;
    std::string out = "| block | clock | timing | reads | writes |\n|---|---|---|---|---|\n";
    add_blocks(on_board, "board", out, ends);
    add_blocks(on_bus, "bus", out, ends);
    out += "\n| FIFO | depth | bits | from | to | kind |\n|---|---|---|---|---|---|\n";
    for (const FifoState* fifo : on_board.fifos) out += fifo_row(*fifo, ends, "one clock");
    for (const CrossingState* fifo : on_board.written) out += fifo_row(*fifo, ends, "board to bus");
    for (const CrossingState* fifo : on_bus.written) out += fifo_row(*fifo, ends, "bus to board");
    if (const auto bits = board.body->pipe_memory()) out += memory_table(*bits);
    return out;
}

}  // namespace rs::engine::model
