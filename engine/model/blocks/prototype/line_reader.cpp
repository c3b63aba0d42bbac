#include "engine/model/blocks/prototype/line_reader.hpp"

namespace rs::engine::model {
namespace {

std::int32_t low(std::uint64_t word) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(word));
}
std::int32_t high(std::uint64_t word) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(word >> 32U));
}

}  // namespace

LineReader::LineReader(const RegisterFile& registers, const Ports& ports)
    : Block("line_reader", std::to_string(kMultiplyCycles) +
                               " cycles, four requests, the memory's latency, 1 to hand over; 1 without a ray"),
      registers_(registers),
      in_(reads(ports.in)),
      requests_(writes(ports.requests)),
      answers_(reads(ports.answers)),
      out_(writes(ports.out)) {}

void LineReader::send_request() {
    const MappedRay& ray = in_.front();
    const ObjectRegisters& object = registers_.object_of(ray.view);
    const int record = ray.image * (1 + object.planes);
    const int word = requested_ < 2 ? 2 * record + requested_ : 2 * (record + 1 + ray.plane) + requested_ - 2;
    requests_.push({object.lines + static_cast<WordAddress>(word), false});
    ++requested_;
}

Activity LineReader::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    const MappedRay& ray = in_.front();
    if (!ray.has_ray) {
        if (!out_.can_push()) return Activity::output_full;
        RayLine none;
        none.view = ray.view;
        out_.push(none);
        in_.pop();
        return Activity::busy;
    }
    if (multiplying_ < kMultiplyCycles) {
        ++multiplying_;
        return Activity::busy;
    }
    Activity activity = Activity::memory_data;
    if (requested_ < 4) {
        activity = Activity::memory_port;
        if (requests_.can_push()) {
            send_request();
            activity = Activity::busy;
        }
    }
    if (answered_ < 4) {
        if (answers_.can_pop()) {
            words_[static_cast<std::size_t>(answered_++)] = answers_.pop().data;
            activity = Activity::busy;
        }
        return activity;
    }
    if (!out_.can_push()) return Activity::output_full;
    out_.push({ray.view, true, ray.x_q20, ray.lambda_q20, ray.image, low(words_[0]), high(words_[0]), low(words_[1]),
               high(words_[1]), low(words_[2]), high(words_[2]), low(words_[3]), high(words_[3])});
    in_.pop();
    multiplying_ = requested_ = answered_ = 0;
    return Activity::busy;
}

}  // namespace rs::engine::model
