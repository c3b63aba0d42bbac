#include "engine/rtl/board/rtl_board.hpp"

namespace rs::engine::rtl {

Result<std::unique_ptr<RtlBoard>> make_rtl_board(const model::BoardConfig& /*config*/) {
    return Error{
        "this build has no verilated board; install Verilator and build again with the CMake option RAYSPACE_RTL=ON, "
        "or "
        "use the board's model without --rtl"};
}

}  // namespace rs::engine::rtl
