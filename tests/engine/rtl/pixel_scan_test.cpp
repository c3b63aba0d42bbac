#include "engine/model/blocks/parallel/pixel_rays.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vpixel_scan_0.h>
#include <Vpixel_scan_0_mutants.h>
#include <Vpixel_scan_5.h>
#include <Vpixel_scan_5_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module, int kPipe>
class PixelScanBench final : public Bench<Module> {
public:
    PixelScanBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(jobs_, RS_RTL_PORTS(module, scan_jobs), [this] { return job(); });
        this->input(
            free_, RS_RTL_PORTS(module, patch_free),
            [this] {
                --patches_left_;
                return model::Done{};
            },
            [this] { return patches_left_ > 0 && this->random_.chance(0.1); });
        this->input(
            done_, RS_RTL_PORTS(module, view_done),
            [this] {
                --views_left_;
                return model::Done{};
            },
            [this] { return views_left_ > 0 && this->random_.chance(0.02); });
        this->output(patches_, RS_RTL_PORTS(module, patches), [this](const model::PatchJob& patch) {
            ++patches_left_;
            views_left_ += static_cast<int>(patch.ends_view);
        });
        this->output(pixels_, RS_RTL_PORTS(module, scanned));
    }

private:
    static constexpr model::StripeShare kShare{kPipe, 16};

    model::ViewJob job() { return {random_view(registers_, this->random_)}; }
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::BoardView& view = registers_.view(valid_view(registers_, this->module_.view));
        this->module_.view_width = static_cast<SData>(view.width);
        this->module_.view_height = static_cast<SData>(view.height);
        this->module_.view_s0_q32 = static_cast<QData>(view.s0_q32) & ((QData{1} << 36) - 1);
        this->module_.view_sy_q32 = static_cast<QData>(view.sy_q32) & ((QData{1} << 34) - 1);
    }

    model::RegisterFile registers_ = random_stripe_views(kShare, this->random_);
    int patches_left_ = 0;
    int views_left_ = 0;
    model::Fifo<model::ViewJob> jobs_{"scan_jobs", 4, model::ViewJob::kBits};
    model::Fifo<model::Done> free_{"patch_free", 4, 1};
    model::Fifo<model::Done> done_{"view_done", 2, 1};
    model::Fifo<model::PatchJob> patches_{"patches", 4, model::PatchJob::kBits};
    model::Fifo<model::ScannedPixel> pixels_{"scanned", 4, model::ScannedPixel::kBits};
    model::PixelScan block_{
        registers_,
        kShare,
        {.jobs = jobs_, .patch_free = free_, .view_done = done_, .patches = patches_, .pixels = pixels_}};
};

template <class Module>
using FirstPipeBench = PixelScanBench<Module, 0>;
template <class Module>
using SixthPipeBench = PixelScanBench<Module, 5>;

RS_RTL_TESTS(RtlPixelScan0, FirstPipeBench, pixel_scan_0)
RS_RTL_TESTS(RtlPixelScan5, SixthPipeBench, pixel_scan_5)

}  // namespace
}  // namespace rs::engine::rtl
