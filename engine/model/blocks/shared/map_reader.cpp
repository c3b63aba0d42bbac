#include "engine/model/blocks/shared/map_reader.hpp"

namespace rs::engine::model {

MapReader::MapReader(const Ports& ports)
    : Block("map_reader", "1 cycle to ask, the memory's latency, 1 cycle to hand over; 1 without a ray"),
      in_(reads(ports.in)),
      requests_(writes(ports.requests)),
      answers_(reads(ports.answers)),
      out_(writes(ports.out)) {}

Activity MapReader::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    const RayPoint& point = in_.front();
    MappedRay ray{point.view, false,       point.plane, point.x_q20, point.lambda_q20,
                  0,          point.u_q28, point.n_q28, point.t_q28};
    if (point.has_ray) {
        if (!requested_) {
            if (!requests_.can_push()) return Activity::memory_port;
            requests_.push({static_cast<WordAddress>(point.cell_byte / 8), false});
            requested_ = true;
            return Activity::busy;
        }
        if (!answers_.can_pop()) return Activity::memory_data;
        if (!out_.can_push()) return Activity::output_full;
        const std::uint64_t word = answers_.pop().data;
        ray.image = static_cast<int>((word >> (8 * (point.cell_byte % 8))) & 255U);
        ray.has_ray = ray.image != kNoImageByte;
        requested_ = false;
    } else if (!out_.can_push()) {
        return Activity::output_full;
    }
    out_.push(ray);
    in_.pop();
    return Activity::busy;
}

}  // namespace rs::engine::model
