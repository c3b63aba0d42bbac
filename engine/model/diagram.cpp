#include "engine/model/diagram.hpp"

#include <map>

namespace rs::engine::model {
namespace {

struct Ends {
    std::string from;
    std::string to;
};

void add_blocks(const Simulator::DomainParts& parts, const char* clock, std::string& out,
                std::map<std::string, Ends>& ends) {
    for (const Block* block : parts.blocks) {
        std::string in;
        std::string outs;
        for (const Port& port : block->ports()) {
            const bool reads = port.direction == Port::Direction::in;
            std::string& list = reads ? in : outs;
            list += (list.empty() ? "" : ", ") + port.fifo;
            (reads ? ends[port.fifo].to : ends[port.fifo].from) = block->name();
        }
        out += "| " + block->name() + " | " + clock + " | " + block->timing() + " | " + in + " | " + outs + " |\n";
    }
}

template <class F>
std::string fifo_row(const F& fifo, const std::map<std::string, Ends>& ends, const char* kind) {
    const auto at = ends.find(fifo.name());
    const Ends none;
    const Ends& e = at == ends.end() ? none : at->second;
    return "| " + fifo.name() + " | " + std::to_string(fifo.depth()) + " | " + std::to_string(fifo.width_bits()) +
           " | " + e.from + " | " + e.to + " | " + kind + " |\n";
}

}  // namespace

std::string diagram_tables(const BoardTop& board) {
    const Simulator::DomainParts& on_board = board.simulator.parts(Domain::board);
    const Simulator::DomainParts& on_bus = board.simulator.parts(Domain::pci);
    std::map<std::string, Ends> ends;
    std::string out = "| block | clock | timing | reads | writes |\n|---|---|---|---|---|\n";
    add_blocks(on_board, "board", out, ends);
    add_blocks(on_bus, "bus", out, ends);
    out += "\n| FIFO | depth | bits | from | to | kind |\n|---|---|---|---|---|---|\n";
    for (const FifoState* fifo : on_board.fifos) out += fifo_row(*fifo, ends, "one clock");
    for (const CrossingState* fifo : on_board.written) out += fifo_row(*fifo, ends, "board to bus");
    for (const CrossingState* fifo : on_bus.written) out += fifo_row(*fifo, ends, "bus to board");
    return out;
}

}  // namespace rs::engine::model
