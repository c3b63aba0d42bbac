#include "engine/model/blocks/prototype/sample_reading.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vsample_select.h>
#include <Vsample_select_mutants.h>

namespace rs::engine::rtl {
namespace {

using Kind = model::SampleTag::Kind;

template <class Module>
class SampleSelectBench final : public Bench<Module> {
public:
    SampleSelectBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(tags_, RS_RTL_PORTS(module, tags), [this] { return tag(); });
        this->input(words_, RS_RTL_PORTS(module, sample_words),
                    [this] { return model::MemoryWord{this->random_.word()}; });
        this->output(samples_, RS_RTL_PORTS(module, samples));
    }

private:
    // The tags of a pair of pixels, in the order of sample_fetch.
    void plan_pair() {
        Random& random = this->random_;
        const auto lane = [&](int most) { return static_cast<int>(random.in(0, most)); };
        model::SampleTag tag;
        tag.view = lane(14);
        const bool is_apart = random.chance(0.3);
        for (int word = 0; word < (is_apart ? 2 : 1); ++word) {
            model::SampleTag alpha = tag;
            for (const int n : {0, 1}) {
                alpha.lane[n] = lane(31);
                alpha.has_alpha[n] = is_apart ? n == word : random.chance(0.8);
            }
            planned_.push_back(alpha);
        }
        for (const int n : {0, 1}) {
            tag.pixel = n;
            tag.lane[1 - n] = 0;
            tag.kind = Kind::chroma;
            tag.lane[n] = lane(3);
            planned_.push_back(tag);
            tag.kind = Kind::luma;
            tag.lane[n] = lane(7);
            planned_.push_back(tag);
        }
    }
    model::SampleTag tag() {
        if (planned_.empty()) plan_pair();
        const model::SampleTag next = planned_.front();
        planned_.pop_front();
        return next;
    }
    model::Block& block() override { return block_; }

    std::deque<model::SampleTag> planned_;
    model::Fifo<model::SampleTag> tags_{"tags", 32, model::SampleTag::kBits};
    model::Fifo<model::MemoryWord> words_{"sample_words", 16, model::MemoryWord::kBits};
    model::Fifo<model::YuvaPixel> samples_{"samples", 4, model::YuvaPixel::kBits};
    model::SampleSelect block_{{.tags = tags_, .words = words_, .out = samples_}};
};

RS_RTL_TESTS(RtlSampleSelect, SampleSelectBench, sample_select)

}  // namespace
}  // namespace rs::engine::rtl
