#include "engine/model/blocks/parallel/bracket_finder.hpp"

#include "engine/model/limits/parallel_layout.hpp"

namespace rs::engine::model {

BracketFinder::BracketFinder(const RegisterFile& registers, const Ports& ports)
    : Block("bracket_finder", "a word per look and a word and " + std::to_string(kMultiplyCycles) +
                                  " cycles per crossing, 1 to decide; 1 without a ray or a shape map"),
      registers_(registers),
      in_(reads(ports.in)),
      requests_(writes(ports.requests)),
      answers_(reads(ports.answers)),
      out_(writes(ports.out)) {}

// Reads a word of an image record; word_ is valid when answered_ is set.
Activity BracketFinder::read(int image, int word) {
    if (!requested_) {
        if (!requests_.can_push()) return Activity::memory_port;
        const ObjectRegisters& object = registers_.object_of(in_.front().view);
        const int at = image * record_words(object.planes) + word;
        requests_.push({object.lines + static_cast<WordAddress>(at), false});
        requested_ = true;
        return Activity::busy;
    }
    if (!answers_.can_pop()) return Activity::memory_data;
    word_ = answers_.pop().data;
    answered_ = true;
    return Activity::busy;
}

Activity BracketFinder::crossing(int image, Crossing& into) {
    const MappedRay& ray = in_.front();
    if (!answered_) return read(image, plane_words(ray.plane) + 3);
    if (++multiplying_ < kMultiplyCycles) return Activity::busy;
    into = {true, low_half(word_) + ((ray.u_q28 * high_half(word_)) >> 28)};
    requested_ = answered_ = false;
    multiplying_ = 0;
    return Activity::busy;
}

void BracketFinder::next_step() {
    step_ = !gap_known_ ? Step::gap_word : !first_.known ? Step::first : !second_.known ? Step::second : Step::decide;
}

Activity BracketFinder::send_output(const BracketedRay& ray) {
    if (!out_.can_push()) return Activity::output_full;
    out_.push(ray);
    in_.pop();
    step_ = Step::idle;
    looks_ = 0;
    gap_known_ = first_.known = second_.known = false;
    return Activity::busy;
}

Activity BracketFinder::decide() {
    const MappedRay& ray = in_.front();
    const int count = registers_.object_of(ray.view).images;
    BracketedRay out{ray.view,
                     RayKind::foot,
                     ray.plane,
                     ray.x_q20,
                     ray.lambda_q20,
                     ray.n_q28,
                     ray.t_q28,
                     ray.image,
                     ray.image,
                     0,
                     0,
                     0,
                     0,
                     false,
                     false};
    const int lines = low_half(gap_word_) & 0xFFFF;
    if (lines == 0) return send_output(out);
    if (ray.x_q20 >= first_.x_q20 && ray.x_q20 < second_.x_q20) {
        out.kind = RayKind::shape;
        out.first = gap_;
        out.second = (gap_ + 1) % count;
        out.from_first_q20 = ray.x_q20 - first_.x_q20;
        out.width_q20 = second_.x_q20 - first_.x_q20;
        out.lines = lines;
        out.first_line = static_cast<std::uint32_t>(high_half(gap_word_));
        out.lines_before = (low_half(gap_word_) >> 16 & 1) != 0;
        out.lines_behind = (low_half(gap_word_) >> 17 & 1) != 0;
        return send_output(out);
    }
    if (looks_ + 1 == count) return send_output(out);
    ++looks_;
    if (ray.x_q20 < first_.x_q20) {
        gap_ = (gap_ + count - 1) % count;
        second_ = first_;
        first_.known = false;
    } else {
        gap_ = (gap_ + 1) % count;
        first_ = second_;
        second_.known = false;
    }
    gap_known_ = false;
    next_step();
    return Activity::busy;
}

Activity BracketFinder::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    const MappedRay& ray = in_.front();
    const ObjectRegisters& object = registers_.object_of(ray.view);
    switch (step_) {
        case Step::idle:
            if (!ray.has_ray || !object.shape.exists) {
                return send_output({ray.view, ray.has_ray ? RayKind::plane : RayKind::none, ray.plane, ray.x_q20,
                                    ray.lambda_q20, 0, 0, ray.image, ray.image, 0, 0, 0, 0, false, false});
            }
            step_ = Step::near;
            return crossing(ray.image, first_);
        case Step::near: {
            const Activity activity = crossing(ray.image, first_);
            if (!first_.known) return activity;
            gap_ = ray.image;
            if (first_.x_q20 > ray.x_q20) {
                gap_ = (gap_ + object.images - 1) % object.images;
                second_ = first_;
                first_.known = false;
            }
            next_step();
            return activity;
        }
        case Step::gap_word: {
            const Activity activity = read(gap_, 2);
            if (!answered_) return activity;
            gap_word_ = word_;
            gap_known_ = true;
            requested_ = answered_ = false;
            // No lines: no other word is needed.
            if ((low_half(gap_word_) & 0xFFFF) == 0) {
                step_ = Step::decide;
            } else {
                next_step();
            }
            return activity;
        }
        case Step::first:
        case Step::second: {
            Crossing& wanted = step_ == Step::first ? first_ : second_;
            const Activity activity = crossing(step_ == Step::first ? gap_ : (gap_ + 1) % object.images, wanted);
            if (wanted.known) next_step();
            return activity;
        }
        case Step::decide:
            return decide();
    }
    return Activity::idle;
}

}  // namespace rs::engine::model
