#include "engine/model/blocks/host/host_program.hpp"

namespace rs::engine::model {

HostProgram host_program(std::vector<BoardView> views, const std::vector<ObjectRegisters>& objects) {
    HostProgram program;
    for (const BoardView& view : views) {
        const bool exists = view.object >= 0 && view.object < static_cast<int>(objects.size());
        program.register_writes +=
            register_writes(view, exists ? objects[static_cast<std::size_t>(view.object)].planes : 0);
    }
    ++program.register_writes;  // the start command
    program.bank.views = std::move(views);
    return program;
}

}  // namespace rs::engine::model
