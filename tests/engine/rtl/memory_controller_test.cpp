#include "engine/model/blocks/memory/memory_controller.hpp"
#include "tests/engine/rtl/sdram_pins.hpp"

#include <Vmemory_controller_18.h>
#include <Vmemory_controller_18_mutants.h>
#include <Vmemory_controller_4.h>
#include <Vmemory_controller_4_mutants.h>

namespace rs::engine::rtl {
namespace {

constexpr int kRoomBits = 5;
constexpr int kReadBits = model::MemoryRead::kBits;

/// The controller of prototype-2000 (4 read ports) or of compressed-2000 (18).
template <class Module, int kPorts>
class MemoryControllerBench final : public Bench<Module> {
public:
    MemoryControllerBench(Module& module, Random& random) : Bench<Module>(module, random) {
        for (const auto& port : ports_) {
            this->input(port->requests, port->reads_valid, port->reads_ready, port->reads_data,
                        [this] { return this->read(); });
            this->output(port->answers, port->words_valid, port->words_ready, port->words_data);
        }
        this->input(image_writes_, RS_RTL_PORTS(module, image_writes), [this] { return write(image_address_); });
        this->output(view_written_, RS_RTL_PORTS(module, view_written));
        this->input(loads_, RS_RTL_PORTS(module, load_words), [this] { return write(load_address_); });
        this->output(object_loaded_, RS_RTL_PORTS(module, object_loaded));
    }

private:
    // FIFOs of a read port, and its part of the ports of the module.
    struct Port {
        Port(const std::string& name, int reads, int words)
            : requests(name + "_reads", reads, model::MemoryRead::kBits),
              answers(name + "_words", words, model::MemoryWord::kBits) {}
        model::Fifo<model::MemoryRead> requests;
        model::Fifo<model::MemoryWord> answers;
        CData reads_valid = 0, reads_ready = 0, words_valid = 0, words_ready = 0;
        IData reads_data = 0;
        QData words_data = 0;
    };
    static std::vector<std::unique_ptr<Port>> read_ports() {
        std::vector<std::unique_ptr<Port>> ports;
        const auto add = [&](const std::string& name, int reads, int words) {
            ports.push_back(std::make_unique<Port>(name, reads, words));
        };
        add("host", 4, 8);
        add("map", 2, 2);
        add("line", 4, 4);
        add("sample", 8, 16);  // or codebooks
        while (ports.size() < static_cast<std::size_t>(kPorts)) {
            const std::string name = std::to_string(ports.size());
            const bool is_record = ports.size() % 3 == 1;
            add(name, is_record ? 4 : 2, ports.size() < 10 ? (is_record ? 4 : 2) : (is_record ? 16 : 8));
        }
        return ports;
    }
    [[nodiscard]] std::vector<model::ReadPort> ports_of_model() const {
        std::vector<model::ReadPort> ports;
        for (const auto& port : ports_) ports.push_back({port->requests.name(), &port->requests, &port->answers});
        return ports;
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
        connect_ports();
        if (this->module_.rst == 0) difference_ = pins_.clock();
    }
    void connect_ports() {
        Module& module = this->module_;
        BitsWriter valid(kPorts);
        BitsWriter data(kPorts * kReadBits);
        BitsWriter room(kPorts * kRoomBits);
        for (std::size_t n = ports_.size(); n-- > 0;) {
            valid.put(ports_[n]->reads_valid, 1);
            data.put(ports_[n]->reads_data, kReadBits);
            room.put(ports_[n]->answers.room(), kRoomBits);
        }
        write_port(module.reads_valid, valid.bits(), kPorts);
        write_port(module.reads_data, data.bits(), kPorts * kReadBits);
        write_port(module.words_room, room.bits(), kPorts * kRoomBits);
        module.image_writes_count = static_cast<CData>(image_writes_.count());
        module.eval();
        for (std::size_t n = 0; n < ports_.size(); ++n) {
            ports_[n]->reads_ready = module.reads_ready >> n & 1U;
            ports_[n]->words_valid = module.words_valid >> n & 1U;
            ports_[n]->words_data = module.words_data;
        }
    }
    std::string compare() override { return difference_; }

    model::MemorySettings settings_;  // prototype-2000
    model::Sdram sdram_{settings_.shape, settings_.timing};
    SdramPins<Module> pins_{this->module_, sdram_, this->random_};
    std::string difference_;
    model::WordAddress image_address_ = model::WordAddress{15} << 23U;
    model::WordAddress load_address_ = 0;
    std::vector<std::unique_ptr<Port>> ports_ = read_ports();
    model::Fifo<model::MemoryWrite> image_writes_{"image_writes", 16, model::MemoryWrite::kBits};
    model::Fifo<model::Done> view_written_{"view_written", 2, model::Done::kBits};
    model::Fifo<model::MemoryWrite> loads_{"load_words", 64, model::MemoryWrite::kBits};
    model::Fifo<model::Done> object_loaded_{"object_loaded", 2, model::Done::kBits};
    model::MemoryController block_{"memory_controller",
                                   settings_,
                                   sdram_,
                                   {.read_ports = ports_of_model(),
                                    .image_writes = image_writes_,
                                    .view_written = view_written_,
                                    .loads = loads_,
                                    .object_loaded = object_loaded_}};
};

template <class Module>
using PrototypeMemoryBench = MemoryControllerBench<Module, 4>;
template <class Module>
using CompressedMemoryBench = MemoryControllerBench<Module, 18>;

RS_RTL_TESTS(RtlMemoryController, PrototypeMemoryBench, memory_controller_4)
RS_RTL_TESTS(RtlCompressedMemoryController, CompressedMemoryBench, memory_controller_18)

}  // namespace
}  // namespace rs::engine::rtl
