#pragma once
// The tables of DIAGRAM.md, made from what the blocks and FIFOs of a board declare: so the page cannot differ from the
// code unseen.

#include "engine/model/board_top.hpp"

#include <string>

namespace rs::engine::model {

// Two tables as Markdown: blocks with clock, timing and ports; FIFOs with depth, width and the blocks at their ends. Of
// a parallel board one pipe stands for all ("_pN"), and a third table states what block RAM it takes.
std::string diagram_tables(const BoardTop& board);

}  // namespace rs::engine::model
