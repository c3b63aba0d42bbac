#include "engine/model/blocks/memory/image_writer.hpp"

namespace rs::engine::model {

ImageWriter::ImageWriter(const RegisterFile& registers, const Ports& ports)
    : Block("image_writer", "a pixel per cycle, a word every second"),
      registers_(registers),
      in_(reads(ports.in)),
      out_(writes(ports.out)) {}

Activity ImageWriter::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    if (!has_first_) {
        const RgbaPixel pixel = in_.pop();
        if (left_ == 0) {
            address_ = registers_.image(registers_.active, pixel.view);
            left_ = registers_.view(pixel.view).words();
        }
        first_ = pixel.rgba;
        has_first_ = true;
        return Activity::busy;
    }
    if (!out_.can_push()) return Activity::output_full;
    const RgbaPixel second = in_.pop();
    --left_;
    out_.push({address_++, std::uint64_t{first_} | std::uint64_t{second.rgba} << 32U, left_ == 0});
    has_first_ = false;
    return Activity::busy;
}

}  // namespace rs::engine::model
