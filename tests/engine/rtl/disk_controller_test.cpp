#include "engine/model/blocks/memory/disk_controller.hpp"
#include "engine/rtl/simulation/disk_card.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vdisk_controller.h>
#include <Vdisk_controller_mutants.h>

#include <algorithm>

namespace rs::engine::rtl {
namespace {

// Fast disks, of which some stop delivering for longer than the timeout.
model::DiskSettings random_disk(Random& random) {
    model::DiskSettings settings;
    settings.start_cycles = static_cast<std::uint64_t>(random.in(0, 20));
    settings.media_cycles_per_sector = static_cast<int>(random.in(1, 1500));
    settings.buffer_sectors = static_cast<int>(random.in(1, 3));
    settings.stall_after_bytes = random.chance(0.5) ? 0 : 512;
    settings.stall_cycles = static_cast<std::uint64_t>(random.in(0, 400));
    settings.timeout_cycles = static_cast<std::uint64_t>(random.in(2, 500));
    return settings;
}

template <class Module>
class DiskControllerBench final : public Bench<Module> {
public:
    DiskControllerBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->output(words_, RS_RTL_PORTS(module, load_words),
                     [this](const model::MemoryWrite& word) { in_memory_ += word.last; });
        this->input(
            loaded_, RS_RTL_PORTS(module, object_loaded),
            [this] {
                --in_memory_;
                return model::Done{};
            },
            [this] { return in_memory_ > 0; });
        this->output(object_ready_, RS_RTL_PORTS(module, object_ready));
    }

private:
    // A load of a few segments, up to 2.5 sectors.
    void request_load() {
        Random& random = this->random_;
        auto segments = std::make_shared<std::vector<model::MemorySegment>>();
        for (std::int64_t n = random.in(1, 3); n > 0; --n) {
            model::MemorySegment& segment = segments->emplace_back();
            segment.address = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 100));
            for (std::int64_t word = random.in(1, random.chance(0.5) ? 4 : 60); word > 0; --word)
                segment.words.push_back(random.word());
        }
        model::LoadJob job{static_cast<int>(random.in(0, 19)), random_object(random), std::move(segments)};
        jobs_.push_back(job);
        block_.load(std::move(job));
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        Module& module = this->module_;
        if (module.rst != 0) return;
        if (jobs_.size() < 2 && this->random_.chance(0.05)) request_load();
        if (is_loading_) drive_.clock(now_);
        module.load_available = !jobs_.empty();
        module.load_object = static_cast<CData>(jobs_.empty() ? 0 : jobs_.front().slot);
        module.timeout_cycles = static_cast<IData>(settings_.timeout_cycles);
        module.drive_has_data = is_loading_ && drive_.has_data();
        if (!is_loading_) return;
        const model::MemoryWrite word = word_at(jobs_.front(), drive_.sent_bytes());
        module.drive_data = static_cast<SData>(word.data >> (8 * (drive_.sent_bytes() % 8)));
        module.drive_address = word.address;
        module.drive_is_last = word.last;
    }
    std::string compare() override {
        Module& module = this->module_;
        if (module.drive_takes != 0) drive_.take();
        if (module.load_begins != 0) {
            drive_.begin(now_, bytes_of(jobs_.front()));
            is_loading_ = true;
            ++begun_;
        }
        if (module.load_ends != 0) {
            is_loading_ = false;
            jobs_.pop_front();
            ++ended_;
        }
        failed_ += module.load_fails;
        ++now_;
        const auto& loads = block_.loads();
        const auto count = [&](auto is) { return static_cast<std::size_t>(std::ranges::count_if(loads, is)); };
        if (loads.size() != begun_) return "another load begins";
        if (count([](const auto& load) { return load.failed; }) != failed_) return "another load fails";
        if (count([](const auto& load) { return load.finished > 0; }) != ended_) return "another load ends";
        return {};
    }

    model::DiskSettings settings_ = random_disk(this->random_);
    model::RegisterFile registers_ = random_registers(this->random_);
    Drive drive_{settings_};
    std::deque<model::LoadJob> jobs_;  // the first one in progress if `is_loading_`
    bool is_loading_ = false;
    int in_memory_ = 0;  // loads whose last word is in memory
    std::uint64_t now_ = 0;
    std::size_t begun_ = 0, ended_ = 0, failed_ = 0;
    // Less deep than on the board, so that they are often full.
    model::Fifo<model::MemoryWrite> words_{"load_words", 1, model::MemoryWrite::kBits};
    model::Fifo<model::Done> loaded_{"object_loaded", 2, model::Done::kBits};
    model::Fifo<model::Done> object_ready_{"object_ready", 1, 5};
    model::DiskController block_{
        settings_, registers_, {.words = words_, .loaded = loaded_, .object_ready = object_ready_}};
};

RS_RTL_TESTS(RtlDiskController, DiskControllerBench, disk_controller)

}  // namespace
}  // namespace rs::engine::rtl
