#include "engine/model/blocks/parallel/image_reader.hpp"

#include "engine/model/limits/parallel_layout.hpp"

namespace rs::engine::model {

constexpr int kWordsOfImage = 5;

ImageReader::ImageReader(const RegisterFile& registers, const Ports& ports)
    : Block("picture_reader",
            std::to_string(kMultiplyCycles) +
                " cycles, 4, 5 or 10 requests, the memory's latency, 1 to hand over; 1 without a ray"),
      registers_(registers),
      in_(reads(ports.in)),
      requests_(writes(ports.requests)),
      answers_(reads(ports.answers)),
      out_(writes(ports.out)) {}

void ImageReader::send_request() {
    const BracketedRay& ray = in_.front();
    const ObjectRegisters& object = registers_.object_of(ray.view);
    const int image = requested_ < kWordsOfImage ? ray.first : ray.second;
    const int n = requested_ % kWordsOfImage;
    const int word = image * record_words(object.planes) + (n < 2 ? n : plane_words(ray.plane) + n - 2);
    requests_.push({object.lines + static_cast<WordAddress>(word), false});
    ++requested_;
}

void ImageReader::take(std::uint64_t word) {
    ImageLine& line = lined_.image[static_cast<std::size_t>(answered_ / kWordsOfImage)];
    const std::array<std::pair<std::int32_t*, std::int32_t*>, kWordsOfImage> places = {{
        {&line.cx_q16, &line.cy_q16},
        {&line.fl_y_q16, &line.height_q20},
        {&line.l0_q20, &line.l1_q30},
        {&line.q0_q16, &line.q1_q16},
        {&line.l2_q30, &line.q2_q16},
    }};
    const auto& place = places[static_cast<std::size_t>(answered_ % kWordsOfImage)];
    *place.first = low_half(word);
    *place.second = high_half(word);
    ++answered_;
}

Activity ImageReader::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    const BracketedRay& ray = in_.front();
    const int words = words_of(ray.kind);
    if (words > 0 && multiplying_ < kMultiplyCycles) {
        ++multiplying_;
        return Activity::busy;
    }
    if (answered_ < words) {
        Activity activity = Activity::memory_data;
        if (requested_ < words) {
            activity = Activity::memory_port;
            if (requests_.can_push()) {
                send_request();
                activity = Activity::busy;
            }
        }
        if (answers_.can_pop()) {
            take(answers_.pop().data);
            activity = Activity::busy;
        }
        return activity;
    }
    if (!out_.can_push()) return Activity::output_full;
    lined_.ray = ray;
    out_.push(lined_);
    in_.pop();
    lined_ = {};
    multiplying_ = requested_ = answered_ = 0;
    return Activity::busy;
}

}  // namespace rs::engine::model
