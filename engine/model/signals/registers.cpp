#include "engine/model/signals/registers.hpp"

#include <cstdlib>

namespace rs::engine::model {
namespace {

bool fits(std::int64_t value, int bits) {
    const std::int64_t limit = std::int64_t{1} << (bits - 1);
    return value >= -limit && value < limit;
}

}  // namespace

Result<BoardView> board_view(const engine::ViewRegisters& registers, int object) {
    if (!registers.upright()) {
        return Error{
            "view: the camera is tilted, but the board renders upright views only (every view column a vertical "
            "plane of rays); make the camera upright and move its principal point, or render it with rs-engine render"};
    }
    if (registers.filter != engine::TexelFilter::kBilinear) {
        return Error{
            "view: it uses the sharp or the smooth filter, but the board samples bilinearly; prepare it "
            "with the bilinear filter, or render it with rs-engine render"};
    }
    if (registers.planes.size() > static_cast<std::size_t>(kMaxPlanes)) {
        return Error{"view: its object has " + std::to_string(registers.planes.size()) +
                     " reference planes, more than the board's " + std::to_string(kMaxPlanes)};
    }
    BoardView view;
    view.object = object;
    view.width = registers.width;
    view.height = registers.height;
    view.b_q20 = registers.b_q20;
    view.s0_q32 = registers.rise.at_origin;
    view.sy_q32 = registers.rise.per_row;
    for (std::size_t k = 0; k < registers.planes.size(); ++k) {
        const PlaneRegisters& plane = registers.planes[k];
        view.planes[k] = {plane.a_q20,
                          plane.c_q20,
                          plane.along_normal.at_origin,
                          plane.along_normal.per_column,
                          plane.along_tangent.at_origin,
                          plane.along_tangent.per_column};
    }
    return view;
}

int register_writes(const BoardView&, int planes) {
    constexpr int kOfView = 2 + 1 + 4;   // object and size, b, s0 and sy in two writes each
    constexpr int kOfPlane = 2 + 4 * 2;  // a, c; n0, nx, t0, tx in two writes each
    return kOfView + planes * kOfPlane;
}

std::string register_error(const BoardView& view, const RegisterFile& file, const BoardLimits& limits) {
    if (view.object < 0 || view.object >= limits.objects ||
        !file.objects[static_cast<std::size_t>(view.object)].valid) {
        return "object slot " + std::to_string(view.object) + " holds no object";
    }
    if (view.width < 1 || view.height < 1 || view.width > limits.image_buffer_side_px ||
        view.height > limits.image_buffer_side_px) {
        return "size " + std::to_string(view.width) + "x" + std::to_string(view.height) + " is outside 1.." +
               std::to_string(limits.image_buffer_side_px);
    }
    constexpr int kDirection = 36;
    constexpr int kPosition = 29;
    bool in_range = fits(view.b_q20, kPosition) && fits(view.s0_q32, kDirection) && fits(view.sy_q32, 34);
    for (int k = 0; k < file.objects[static_cast<std::size_t>(view.object)].planes; ++k) {
        const PlaneView& p = view.planes[static_cast<std::size_t>(k)];
        in_range = in_range && fits(p.a_q20, kPosition) && fits(p.c_q20, kPosition);
        // Linear over the view: in range at both ends implies in range between.
        for (const auto& [origin, step] : {std::pair{p.n0_q32, p.nx_q32}, std::pair{p.t0_q32, p.tx_q32}}) {
            in_range = in_range && fits(origin, kDirection) && fits(step, kDirection) &&
                       fits(origin + (view.width - 1) * step, kDirection);
        }
    }
    return in_range ? "" : "a number has more bits than its register";
}

}  // namespace rs::engine::model
