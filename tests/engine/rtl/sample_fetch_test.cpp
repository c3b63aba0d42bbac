#include "engine/model/blocks/prototype/sample_reading.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vsample_fetch.h>
#include <Vsample_fetch_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class SampleFetchBench final : public Bench<Module> {
public:
    SampleFetchBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(pairs_, RS_RTL_PORTS(module, pairs), [this] { return pair(); });
        this->output(reads_, RS_RTL_PORTS(module, sample_reads));
        this->output(tags_, RS_RTL_PORTS(module, tags));
    }

private:
    model::PixelPair pair() {
        Random& random = this->random_;
        model::PixelPair pair;
        pair.view = static_cast<int>(random.in(0, 14));
        for (const int n : {0, 1}) {
            pair.is_visible[n] = random.chance(0.8);
            if (pair.is_visible[n]) pair.row[n] = static_cast<int>(random.in(0, 511));
        }
        if (random.chance(0.5) && pair.is_visible[0] && pair.is_visible[1]) pair.row[1] = (pair.row[0] + 1) & 511;
        pair.luma = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
        pair.chroma = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
        pair.alpha = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
        return pair;
    }
    model::Block& block() override { return block_; }

    model::Fifo<model::PixelPair> pairs_{"pairs", 4, model::PixelPair::kBits};
    model::Fifo<model::MemoryRead> reads_{"sample_reads", 8, model::MemoryRead::kBits};
    model::Fifo<model::SampleTag> tags_{"tags", 32, model::SampleTag::kBits};
    model::SampleFetch block_{{.in = pairs_, .requests = reads_, .tags = tags_}};
};

RS_RTL_TESTS(RtlSampleFetch, SampleFetchBench, sample_fetch)

}  // namespace
}  // namespace rs::engine::rtl
