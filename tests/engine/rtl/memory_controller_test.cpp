#include "engine/model/blocks/memory/memory_controller.hpp"
#include "tests/engine/rtl/sdram_pins.hpp"

#include <Vmemory_controller.h>
#include <Vmemory_controller_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class MemoryControllerBench final : public Bench<Module> {
public:
    MemoryControllerBench(Module& module, Random& random) : Bench<Module>(module, random) {
        const auto read = [this] { return this->read(); };
        this->input(host_.requests, RS_RTL_PORTS(module, host_reads), read);
        this->input(map_.requests, RS_RTL_PORTS(module, map_reads), read);
        this->input(line_.requests, RS_RTL_PORTS(module, line_reads), read);
        this->input(sample_.requests, RS_RTL_PORTS(module, sample_reads), read);
        this->output(host_.answers, RS_RTL_PORTS(module, host_words));
        this->output(map_.answers, RS_RTL_PORTS(module, map_words));
        this->output(line_.answers, RS_RTL_PORTS(module, line_words));
        this->output(sample_.answers, RS_RTL_PORTS(module, sample_words));
        this->input(image_writes_, RS_RTL_PORTS(module, image_writes), [this] { return write(image_address_); });
        this->output(view_written_, RS_RTL_PORTS(module, view_written));
        this->input(loads_, RS_RTL_PORTS(module, load_words), [this] { return write(load_address_); });
        this->output(object_loaded_, RS_RTL_PORTS(module, object_loaded));
    }

private:
    struct Port {
        model::Fifo<model::MemoryRead> requests;
        model::Fifo<model::MemoryWord> answers;
    };
    static Port port(const std::string& name, int requests, int answers) {
        return {{name + "_reads", requests, model::MemoryRead::kBits},
                {name + "_words", answers, model::MemoryWord::kBits}};
    }
    // Few banks and rows, so that rows are often hit, and as often in the way.
    model::WordAddress address() {
        const auto bank = static_cast<model::WordAddress>(this->random_.chance(0.9) ? this->random_.in(0, 2) : 15);
        const auto row = static_cast<model::WordAddress>(this->random_.chance(0.9) ? 0 : this->random_.in(1, 8191));
        return bank << 23U | row << 10U | static_cast<model::WordAddress>(this->random_.in(0, 1023));
    }
    model::MemoryRead read() { return {address(), this->random_.chance(0.1)}; }
    // Words in ascending order, sometimes elsewhere.
    model::MemoryWrite write(model::WordAddress& next) {
        if (this->random_.chance(0.1)) next = address();
        return {next++, this->random_.word(), this->random_.chance(0.2)};
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        this->module_.host_words_room = static_cast<CData>(host_.answers.room());
        this->module_.map_words_room = static_cast<CData>(map_.answers.room());
        this->module_.line_words_room = static_cast<CData>(line_.answers.room());
        this->module_.sample_words_room = static_cast<CData>(sample_.answers.room());
        this->module_.image_writes_count = static_cast<CData>(image_writes_.count());
        if (this->module_.rst == 0) difference_ = pins_.clock();
    }
    std::string compare() override { return difference_; }

    model::MemorySettings settings_;  // prototype-2000
    model::Sdram sdram_{settings_.shape, settings_.timing};
    SdramPins<Module> pins_{this->module_, sdram_, this->random_};
    std::string difference_;
    model::WordAddress image_address_ = model::WordAddress{15} << 23U;
    model::WordAddress load_address_ = 0;
    Port host_ = port("host", 4, 8);
    Port map_ = port("map", 2, 2);
    Port line_ = port("line", 4, 4);
    Port sample_ = port("sample", 8, 16);
    model::Fifo<model::MemoryWrite> image_writes_{"image_writes", 16, model::MemoryWrite::kBits};
    model::Fifo<model::Done> view_written_{"view_written", 2, model::Done::kBits};
    model::Fifo<model::MemoryWrite> loads_{"load_words", 64, model::MemoryWrite::kBits};
    model::Fifo<model::Done> object_loaded_{"object_loaded", 2, model::Done::kBits};
    model::MemoryController block_{"memory_controller",
                                   settings_,
                                   sdram_,
                                   {.read_ports = {{"host", &host_.requests, &host_.answers},
                                                   {"map", &map_.requests, &map_.answers},
                                                   {"line", &line_.requests, &line_.answers},
                                                   {"sample", &sample_.requests, &sample_.answers}},
                                    .image_writes = image_writes_,
                                    .view_written = view_written_,
                                    .loads = loads_,
                                    .object_loaded = object_loaded_}};
};

RS_RTL_TESTS(RtlMemoryController, MemoryControllerBench, memory_controller)

}  // namespace
}  // namespace rs::engine::rtl
