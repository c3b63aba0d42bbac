#include "engine/model/blocks/layer_choice.hpp"

namespace rs::engine::model {

LayerChoice::LayerChoice(Fifo<FilteredSample>& in, Fifo<ChosenPixel>& out, Fifo<MarchAgain>& again)
    : Block("layer_choice",
            "latency " + std::to_string(kStages + 1) + " behind a cell's last sample, a sample per cycle"),
      in_(reads(in)),
      out_(writes(out)),
      again_(writes(again)) {}

ShapeLayer LayerChoice::scored(const Layer& layer, int weight) {
    ShapeLayer out;
    if (!layer.is_there) return out;
    const SampleSum& first = layer.sample[0];
    const SampleSum& second = layer.sample[1];
    if ((first.exists && first.a == 0) || (second.exists && second.a == 0)) {
        out.exists = true;
        out.score = kTransparentScore;
        return out;
    }
    const bool show_first = first.exists && layer.sees[0];
    const bool show_second = second.exists && layer.sees[1];
    out.exists = show_first || show_second;
    if (show_first && show_second) {
        out.sum = mix(first, second, weight);
        out.score = disagreement(first, second);
    } else if (out.exists) {
        const SampleSum& one = show_first ? first : second;
        out.sum = mix(one, one, 0);
        out.score = kSingleScore;
    }
    return out;
}

LayerChoice::Outcome LayerChoice::decided(const SampleHead& last) const {
    ShapeLayer best = scored(layers_[0], last.weight);
    const ShapeLayer other = scored(layers_[1], last.weight);
    if (other.exists && (!best.exists || other.score < best.score)) best = other;
    Outcome out;
    const bool shows = best.exists && best.sum.a > 0;
    out.sends_back = !shows && !last.final;
    out.again = {last.id, last.next};
    out.chosen.id = last.id;
    if (shows) out.chosen = {last.id, best.sum.a, best.sum.r, best.sum.g, best.sum.b};
    return out;
}

Activity LayerChoice::tick(std::uint64_t) {
    if (line_.leaves()) {
        const Outcome& outcome = line_.leaving();
        if (outcome.sends_back ? !again_.can_push() : !out_.can_push()) return Activity::output_full;
        if (outcome.sends_back) {
            again_.push(outcome.again);
            ++sent_back_;
        } else {
            out_.push(outcome.chosen);
        }
    }
    if (!in_.can_pop()) {
        line_.advance();
        return Activity::idle;
    }
    const FilteredSample sample = in_.pop();
    if (sample.head.is_there) {
        Layer& layer = layers_[static_cast<std::size_t>(sample.head.layer)];
        const std::size_t n = sample.head.second ? 1 : 0;
        layer.is_there = true;
        layer.sees[n] = sample.head.sees;
        layer.sample[n] = {sample.inside, sample.a, sample.r, sample.g, sample.b};
    }
    if (!sample.head.last) {
        line_.advance();
        return Activity::busy;
    }
    line_.advance(decided(sample.head));
    layers_ = {};
    return Activity::busy;
}

}  // namespace rs::engine::model
