#include "engine/model/blocks/texels/surface_blend.hpp"

namespace rs::engine::model {
namespace {

// Blends both samples; empty if one of them states that the point is not on the object.
SampleSum blend_samples(const std::array<SampleSum, 2>& samples, int weight) {
    const auto& [first, second] = samples;
    if ((first.exists && first.a == 0) || (second.exists && second.a == 0)) return {};
    if (first.exists && second.exists) return mix(first, second, weight);
    if (!first.exists && !second.exists) return {};
    const SampleSum& one = first.exists ? first : second;
    return mix(one, one, 0);
}

// Packs a colour, R in the low byte.
std::uint32_t packed(const Rgba8& c) {
    return std::uint32_t{c.r} | std::uint32_t{c.g} << 8U | std::uint32_t{c.b} << 16U | std::uint32_t{c.a} << 24U;
}

}  // namespace

SurfaceBlend::SurfaceBlend(const Ports& ports)
    : Block("surface_blend",
            "latency " + std::to_string(kStages + 1) + " behind a surface's last sample, a sample per cycle"),
      in_(reads(ports.in)),
      out_(writes(ports.out)),
      again_(writes(ports.again)) {}

SurfaceBlend::Outcome SurfaceBlend::resolve_surface(const SampleHead& last) {
    const SampleSum sum = blend_samples(samples_, last.weight);
    const Rgba8 colour = resolve(sum);
    Rgba8& kept = kept_[static_cast<std::size_t>(last.id)];
    const Rgba8 so_far = blend_over({kept}, {colour}).colour;
    const bool needs_behind = last.next.begin > MarchState::kFoot && colour.a < kCoveringAlpha;
    Outcome out;
    out.again = {last.id, last.next};
    out.sends_back = !last.final && (sum.a == 0 || needs_behind);
    if (!out.sends_back) out.pixel = {last.id, packed(so_far)};
    kept = out.sends_back ? so_far : Rgba8{};
    return out;
}

Activity SurfaceBlend::tick(std::uint64_t) {
    if (line_.has_output()) {
        const Outcome& outcome = line_.output();
        if (outcome.sends_back ? !again_.can_push() : !out_.can_push()) return Activity::output_full;
        if (outcome.sends_back) {
            again_.push(outcome.again);
            ++sent_back_;
        } else {
            out_.push(outcome.pixel);
        }
    }
    if (!in_.can_pop()) {
        line_.advance();
        return Activity::idle;
    }
    const FilteredSample sample = in_.pop();
    if (sample.head.is_there) {
        samples_[sample.head.second ? 1 : 0] = {sample.inside, sample.a, sample.r, sample.g, sample.b};
    }
    if (!sample.head.last) {
        line_.advance();
        return Activity::busy;
    }
    line_.advance(resolve_surface(sample.head));
    samples_ = {};
    return Activity::busy;
}

}  // namespace rs::engine::model
