#include "engine/model/blocks/prototype/column_address.hpp"

#include "rayspace/object/ray_space_object.hpp"

namespace rs::engine::model {

ColumnAddress::ColumnAddress(const RegisterFile& registers, Fifo<ColumnWalk>& in, Fifo<PlacedColumn>& out)
    : SerialStage(
          "column_address",
          "latency and interval " + std::to_string(kLatency) + " (" + std::to_string(kNoRayLatency) + " without a ray)",
          in, out),
      registers_(registers) {}

int ColumnAddress::work(const ColumnWalk& in, PlacedColumn& out) {
    out = {};
    out.view = in.view;
    if (!in.has_ray) return kNoRayLatency;
    const ObjectRegisters& object = registers_.object_of(in.view);
    const int column = in.picture * object.width + in.column;
    const int chroma_column = in.picture * half_size(object.width) + (in.column >> 1);
    out.has_ray = true;
    out.row_0_q16 = in.row_0_q16;
    out.row_step_q16 = in.row_step_q16;
    out.luma = object.luma + static_cast<WordAddress>(column * object.luma_pitch);
    out.chroma = object.chroma + static_cast<WordAddress>(chroma_column * object.chroma_pitch);
    out.alpha = object.alpha + static_cast<WordAddress>(column * object.alpha_pitch);
    return kLatency;
}

}  // namespace rs::engine::model
