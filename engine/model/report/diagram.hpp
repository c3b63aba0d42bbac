#pragma once
// Tables of DIAGRAM.md, generated from the declarations of a board's blocks and FIFOs; a test compares them with the
// page.

#include "engine/model/board_top.hpp"

#include <string>

namespace rs::engine::model {

// Two tables as Markdown: blocks with clock, timing and ports; FIFOs with depth, width and the blocks at their ends.
// For a parallel board one pipe represents all ("_pN"), and a third table lists its block RAM.
std::string diagram_tables(const BoardTop& board);

}  // namespace rs::engine::model
