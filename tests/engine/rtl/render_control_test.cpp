#include "engine/model/blocks/prototype/render_control.hpp"
#include "engine/model/signals/board_config.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vrender_control.h>
#include <Vrender_control_mutants.h>

namespace rs::engine::rtl {
namespace {

model::BoardConfig prototype() {
    return *model::read_board_config("prototype-2000");
}

template <class Module>
class RenderControlBench final : public Bench<Module> {
public:
    RenderControlBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(commands_, RS_RTL_PORTS(module, commands), [this] { return command(); });
        this->output(jobs_, RS_RTL_PORTS(module, jobs), [this](const model::ViewJob&) { ++drawn_views_; });
        this->input(
            view_written_, RS_RTL_PORTS(module, view_written),
            [this] {
                --drawn_views_;
                return model::Done{};
            },
            [this] { return drawn_views_ > 0; });
        this->output(images_ready_, RS_RTL_PORTS(module, images_ready),
                     [this](const model::Done& buffer) { sent_buffers_.push_back(buffer.number); });
        this->input(
            buffer_free_, RS_RTL_PORTS(module, buffer_free),
            [this] {
                const int buffer = sent_buffers_.front();
                sent_buffers_.pop_front();
                return model::Done{buffer};
            },
            [this] { return !sent_buffers_.empty(); });
        this->input(object_ready_, RS_RTL_PORTS(module, object_ready), [this] {
            const int slot = static_cast<int>(this->random_.in(0, 19));
            registers_.loaded[static_cast<std::size_t>(slot)] = random_object(this->random_);
            registers_.loaded[static_cast<std::size_t>(slot)].serial = ++serial_;
            return model::Done{slot};
        });
    }

private:
    // A program of 1 to 4 views, sometimes more; one in five has registers that the board refuses.
    model::StartCommand command() {
        Random& random = this->random_;
        model::HostProgram program;
        const std::int64_t views = random.chance(0.9) ? random.in(1, 4) : random.in(1, 15);
        for (std::int64_t n = 0; n < views; ++n) program.bank.views.push_back(random_board_view(registers_, random));
        if (random.chance(0.2)) program.bank.views.back().width = 0;
        programs_.push_back(program);
        return {programs_.size() - 1};
    }
    [[nodiscard]] bool is_valid(const model::ViewBank& bank) const {
        return std::all_of(bank.views.begin(), bank.views.end(), [&](const model::BoardView& view) {
            return model::register_error(view, registers_, config_.limits).empty();
        });
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        Module& module = this->module_;
        if (commands_.can_pop()) {
            const model::ViewBank& bank = programs_[commands_.front().program].bank;
            module.program_is_valid = is_valid(bank);
            module.program_views = static_cast<CData>(bank.views.size());
        }
        if (module.rst == 0 && module.active_bank != registers_.active) difference_ = "another bank is active";
    }
    std::string compare() override {
        Module& module = this->module_;
        accepted_ += module.accepts_program;
        refused_ += module.refuses_program;
        begun_ += module.activates_bank;
        if (refused_ != block_.refusals().size()) return "another program is refused";
        if (accepted_ + refused_ != block_.commands_taken()) return "another program is accepted";
        if (begun_ != block_.cycles_begun()) return "another cycle begins";
        if (module.activates_bank != 0 && module.bank_of_cycle != registers_.active) return "another bank is activated";
        if (module.validates_object != 0) {
            const std::size_t slot = module.loaded_object;
            if (registers_.objects[slot].serial != registers_.loaded[slot].serial) return "another object is validated";
        }
        return difference_;
    }

    model::BoardConfig config_ = prototype();
    model::RegisterFile registers_ = [this] {
        model::RegisterFile file = random_registers(this->random_);
        file.active = 0;
        return file;
    }();
    model::HostPrograms programs_;
    int drawn_views_ = 0;
    std::deque<int> sent_buffers_;
    std::uint32_t serial_ = 0;
    std::uint64_t accepted_ = 0, refused_ = 0, begun_ = 0;
    std::string difference_;
    model::CrossingFifo<model::StartCommand> commands_{"commands", 4, model::StartCommand::kBits};
    model::Fifo<model::ViewJob> jobs_{"jobs", 2, model::ViewJob::kBits};
    model::Fifo<model::Done> view_written_{"view_written", 2, model::Done::kBits};
    model::Fifo<model::Done> images_ready_{"images_ready", 2, model::Done::kBits};
    model::Fifo<model::Done> buffer_free_{"buffer_free", 2, model::Done::kBits};
    model::Fifo<model::Done> object_ready_{"object_ready", 2, 5};
    model::RenderControl block_{config_,
                                registers_,
                                programs_,
                                {.commands = commands_,
                                 .jobs = jobs_,
                                 .view_written = view_written_,
                                 .images_ready = images_ready_,
                                 .buffer_free = buffer_free_,
                                 .object_ready = object_ready_}};
};

RS_RTL_TESTS(RtlRenderControl, RenderControlBench, render_control)

}  // namespace
}  // namespace rs::engine::rtl
