#include "engine/model/blocks/host/host_dma.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vhost_dma.h>
#include <Vhost_dma_mutants.h>

namespace rs::engine::rtl {
namespace {

// Small images, so that an episode has many buffers.
model::RegisterFile registers_of_small_images(Random& random) {
    model::RegisterFile file = random_registers(random);
    for (const std::size_t buffer : {0U, 1U}) {
        for (int& words : file.buffer_words[buffer])
            words = static_cast<int>(random.in(1, random.chance(0.5) ? 3 : 30));
    }
    return file;
}

template <class Module>
class HostDmaBench final : public Bench<Module> {
public:
    HostDmaBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(images_ready_, RS_RTL_PORTS(module, images_ready),
                    [this] { return model::Done{static_cast<int>(this->random_.in(0, 1))}; });
        this->output(reads_, RS_RTL_PORTS(module, host_reads), [this](const model::MemoryRead&) { ++outstanding_; });
        this->input(
            answers_, RS_RTL_PORTS(module, host_words),
            [this] {
                --outstanding_;
                return model::MemoryWord{this->random_.word()};
            },
            [this] { return outstanding_ > 0; });
        this->output(words_, RS_RTL_PORTS(module, image_words));
        this->input(transferred_, RS_RTL_PORTS(module, transferred), [] { return model::Done{}; });
        this->output(buffer_free_, RS_RTL_PORTS(module, buffer_free));
    }

private:
    model::Block& block() override { return block_; }
    void look_up() override {
        const std::vector<int>& words = registers_.buffer_words[this->module_.buffer];
        const std::size_t view = this->module_.view;
        this->module_.buffer_views = static_cast<CData>(words.size());
        this->module_.buffer_words = static_cast<IData>(view < words.size() ? words[view] : 0);
    }

    model::RegisterFile registers_ = registers_of_small_images(this->random_);
    int outstanding_ = 0;
    model::Fifo<model::Done> images_ready_{"images_ready", 2, model::Done::kBits};
    model::Fifo<model::MemoryRead> reads_{"host_reads", 4, model::MemoryRead::kBits};
    model::Fifo<model::MemoryWord> answers_{"host_words", 8, model::MemoryWord::kBits};
    model::CrossingFifo<model::ImageWord> words_{"image_words", 32, model::ImageWord::kBits};
    model::CrossingFifo<model::Done> transferred_{"transferred", 2, model::Done::kBits};
    model::Fifo<model::Done> buffer_free_{"buffer_free", 1, model::Done::kBits};
    model::HostDma block_{registers_,
                          {.images_ready = images_ready_,
                           .channels = {{&reads_, &answers_}},
                           .words = words_,
                           .transferred = transferred_,
                           .buffer_free = buffer_free_}};
};

RS_RTL_TESTS(RtlHostDma, HostDmaBench, host_dma)

}  // namespace
}  // namespace rs::engine::rtl
