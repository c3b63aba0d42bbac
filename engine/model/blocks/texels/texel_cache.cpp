#include "engine/model/blocks/texels/texel_cache.hpp"

namespace rs::engine::model {

TexelCache::TexelCache(const Ports& ports)
    : Block("texel_cache", "a sample per cycle, beside it a texel written"),
      in_(reads(ports.in)),
      targets_(reads(ports.targets)),
      texels_(reads(ports.texels)),
      out_(writes(ports.out)) {}

bool TexelCache::read() {
    if (!in_.can_pop() || !out_.can_push() || in_.front().fills > fills_) return false;
    const WaitingSample sample = in_.pop();
    fills_ -= sample.fills;
    TexelQuad quad{sample.head, sample.inside, sample.fx, sample.fy, {}};
    for (std::size_t n = 0; n < 4; ++n) {
        if (!sample.inside || (n >= 2 && sample.fx == 0) || (n % 2 == 1 && sample.fy == 0)) continue;
        quad.rgba[n] = lines_[static_cast<std::size_t>(sample.line[n])][static_cast<std::size_t>(sample.texel[n])];
    }
    out_.push(quad);
    ++samples_;
    return true;
}

bool TexelCache::write(std::uint64_t samples_read) {
    if (!texels_.can_pop() || !targets_.can_pop()) return false;
    // The guard is within 512 samples before and 511 behind those read (texel_tags.hpp).
    if ((samples_read - targets_.front().guard) % kSampleNumbers > kWaitingSamples) return false;
    lines_[static_cast<std::size_t>(targets_.front().line)][static_cast<std::size_t>(written_)] = texels_.pop().rgba;
    if (++written_ < kLineTexels) return true;
    targets_.pop();
    written_ = 0;
    ++fills_;
    return true;
}

Activity TexelCache::tick(std::uint64_t) {
    const std::uint64_t samples_read = samples_;  // state before this cycle
    const bool had_sample = in_.can_pop();
    const bool blocked = had_sample && !out_.can_push();
    const bool reads_one = read();
    const bool writes_one = write(samples_read);
    if (reads_one) return Activity::busy;
    if (blocked) return Activity::output_full;
    if (had_sample) return Activity::memory_data;
    return writes_one ? Activity::busy : Activity::idle;
}

FilteredSample filter_quad(const TexelQuad& quad) {
    FilteredSample out{quad.head, quad.inside, 0, 0, 0, 0};
    if (!quad.inside) return out;
    const int weights[] = {(8 - quad.fx) * (8 - quad.fy), (8 - quad.fx) * quad.fy, quad.fx * (8 - quad.fy),
                           quad.fx * quad.fy};
    for (std::size_t n = 0; n < 4; ++n) {
        const auto byte = [&](unsigned at) { return static_cast<std::int32_t>((quad.rgba[n] >> (8 * at)) & 255U); };
        const std::int32_t share = weights[n] * byte(3);
        out.a += share;
        out.r += share * byte(0);
        out.g += share * byte(1);
        out.b += share * byte(2);
    }
    return out;
}

TexelFilter::TexelFilter(const Ports& ports)
    : Block("texel_filter", "latency " + std::to_string(kStages + 1) + ", a sample per cycle"),
      in_(reads(ports.in)),
      stage_(kStages, writes(ports.out)) {}

Activity TexelFilter::tick(std::uint64_t) {
    return stage_.step([&](std::optional<FilteredSample>& sample) {
        if (!in_.can_pop()) return Activity::idle;
        sample = filter_quad(in_.pop());
        return Activity::busy;
    });
}

}  // namespace rs::engine::model
