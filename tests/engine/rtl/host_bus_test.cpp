#include "engine/model/blocks/host/host_bus.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vhost_bus.h>
#include <Vhost_bus_mutants.h>

namespace rs::engine::rtl {
namespace {

// Names of the states of the module, as the model prints them.
constexpr const char* kStates[] = {"idle", "grant",      "address",        "target",
                                   "data", "turnaround", "register write", "interrupt"};

model::PciSettings settings_with_retries(Random& random) {
    model::PciSettings settings;  // prototype-2000
    settings.retry_every = static_cast<int>(random.in(0, 3));
    return settings;
}

template <class Module>
class HostBusBench final : public Bench<Module> {
public:
    HostBusBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(
            words_, RS_RTL_PORTS(module, image_words), [this] { return word(); }, [this] { return has_images_; });
        this->output(commands_, RS_RTL_PORTS(module, commands));
        this->output(transferred_, RS_RTL_PORTS(module, transferred));
    }

private:
    // Images of a few words: a header, then the words.
    model::ImageWord word() {
        Random& random = this->random_;
        if (left_ > 0) {
            --left_;
            return {random.word(), false, false};
        }
        left_ = random.in(1, 20);
        const auto view = static_cast<std::uint64_t>(random.in(0, 14));
        return {static_cast<std::uint64_t>(left_) | view << 32U, true, random.chance(0.3)};
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        if (this->module_.rst != 0) return;
        Module& module = this->module_;
        if (this->random_.chance(program_rate_) && programs_.size() < written_ + 3) {
            programs_.push_back({{}, static_cast<int>(this->random_.in(1, 4))});
        }
        module.program_available = written_ < programs_.size();
        module.program_writes =
            module.program_available != 0 ? static_cast<SData>(programs_[written_].register_writes) : 0;
        module.image_words_visible = static_cast<CData>(words_.visible());
        const auto every = static_cast<std::uint64_t>(settings_.retry_every);
        module.pci_retry = every > 0 && block_.counters().bursts % every == 0;
        expected_state_ = block_.state_text();
    }
    std::string compare() override {
        Module& module = this->module_;
        if (expected_state_.rfind(std::string(kStates[module.pci_state]) + ",", 0) != 0) {
            return "the RTL is in the state " + std::string(kStates[module.pci_state]) +
                   ", the model: " + expected_state_;
        }
        if (module.pci_head != 0) ++heads_;
        if (module.pci_transfer != 0) {
            received_ = received_ >> 32U | std::uint64_t{module.pci_data} << 32U;
            is_half_ = !is_half_;
            if (!is_half_) ++received_words_;
        }
        if (module.commands_valid != 0 && module.commands_ready != 0) ++written_;
        return compare_images();
    }
    // The last word that the host has received.
    std::string compare_images() {
        const auto& images = block_.images();
        if (images.size() != heads_) return "another image begins";
        if (images.empty()) return {};
        std::size_t words = 0;
        for (const model::HostImage& image : images) words += image.words.size();
        if (words != received_words_) return "another number of words has been transferred";
        if (is_half_ || images.back().words.empty() || images.back().words.back() == received_) return {};
        return "another word is transferred";
    }

    model::PciSettings settings_ = settings_with_retries(this->random_);
    model::HostPrograms programs_;
    bool has_images_ = this->random_.chance(0.7);  // without, programs follow each other closely
    double program_rate_ = this->random_.chance(0.5) ? 0.02 : 1.0;
    std::uint64_t written_ = 0;  // programs, by the module
    std::int64_t left_ = 0;      // words of the image
    std::size_t heads_ = 0;
    std::size_t received_words_ = 0;
    std::uint64_t received_ = 0;
    bool is_half_ = false;
    std::string expected_state_;
    model::CrossingFifo<model::ImageWord> words_{"image_words", 32, model::ImageWord::kBits};
    model::CrossingFifo<model::StartCommand> commands_{"commands", 4, model::StartCommand::kBits};
    // Deeper than on the board, where an event follows the transfer of a whole buffer.
    model::CrossingFifo<model::Done> transferred_{"transferred", 4000, model::Done::kBits};
    model::HostBus block_{settings_, programs_, {.words = words_, .commands = commands_, .transferred = transferred_}};
};

RS_RTL_TESTS(RtlHostBus, HostBusBench, host_bus)

}  // namespace
}  // namespace rs::engine::rtl
