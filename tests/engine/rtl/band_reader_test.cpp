#include "engine/model/blocks/parallel/band_reader.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vband_reader_0.h>
#include <Vband_reader_0_mutants.h>
#include <Vband_reader_5.h>
#include <Vband_reader_5_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module, int kPipe>
class BandReaderBench final : public Bench<Module> {
public:
    BandReaderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(set_up_, RS_RTL_PORTS(module, set_up), [this] { return setup(); });
        this->input(
            free_, RS_RTL_PORTS(module, stripe_free),
            [this] {
                --stripes_;
                return model::Done{};
            },
            [this] { return stripes_ > 0 && this->random_.chance(0.01); });
        this->output(reads_, RS_RTL_PORTS(module, band_reads));
        this->output(to_rise_, RS_RTL_PORTS(module, rise_columns));
        this->output(to_march_, RS_RTL_PORTS(module, march_columns));
        this->output(to_place_, RS_RTL_PORTS(module, place_columns),
                     [this](const model::ColumnSetup& setup) { stripes_ += static_cast<int>(setup.column == 0); });
    }

private:
    static constexpr model::StripeShare kShare{kPipe, 16};

    static model::RegisterFile random_shapes(Random& random) {
        model::RegisterFile file = random_stripe_views(kShare, random);
        for (model::ObjectRegisters& object : file.objects) {
            model::ShapeRegisters& shape = object.shape;
            shape.exists = true;
            shape.bands = static_cast<int>(random.chance(0.9) ? random.in(1, 16) : random.in(1, kMaxBands));
            shape.p_cells = static_cast<int>(random.in(1, std::int64_t{1} << random.in(0, 12)));
            const std::int64_t most = (1 << 26) / (shape.p_cells * model::column_words(shape.bands));
            shape.lines = random.in(1, most);
            shape.cells = static_cast<model::WordAddress>(random.in(0, 1 << 26));
        }
        return file;
    }
    // The next column of the pipe.
    model::ColumnSetup setup() {
        Random& random = this->random_;
        if (columns_left_ == 0) {
            view_ = random_view(registers_, random);
            for (int column = 0; column < registers_.view(view_).width; ++column) {
                columns_left_ += static_cast<int>(kShare.owns_column(view_, column));
            }
        }
        --columns_left_;
        model::ColumnSetup setup;
        setup.view = view_;
        setup.kind = random.chance(0.8) ? model::RayKind::shape : static_cast<model::RayKind>(random.in(0, 2));
        setup.image = static_cast<int>(random.in(0, 119));
        setup.image_column = static_cast<int>(random.in(0, 511));
        setup.row_0_q16 = random.of_any_length(46);
        setup.row_step_q16 = random.of_any_length(36);
        setup.images = {image(), image()};
        setup.weight = static_cast<int>(random.in(0, 256));
        setup.lambda_foot_q20 = random.of_any_length(30);
        setup.lambda0_q20 = random.of_any_length(31);
        setup.lambda1_q21 = random.in(0, 1 << 19);
        setup.inverse_r_q20 = random.in(0, 1 << 24);
        setup.inverse_rho_q20 = random.in(0, 1 << 21);
        setup.line_part = static_cast<int>(random.in(0, 7));
        setup.p_part = static_cast<int>(random.in(0, 7));
        choose_cells(setup);
        return setup;
    }
    model::ImageSetup image() {
        const auto number = [&](int width_bits) { return this->random_.of_any_length(width_bits); };
        const auto number_32 = [&](int width_bits) { return static_cast<std::int32_t>(number(width_bits)); };
        return {static_cast<int>(this->random_.in(0, 119)),
                number(30),
                number(20),
                number(31),
                number(22),
                number_32(31),
                number_32(31),
                number_32(31),
                number_32(29)};
    }
    // Most columns have some of the cells of the last one.
    void choose_cells(model::ColumnSetup& setup) {
        Random& random = this->random_;
        const model::ShapeRegisters& shape = registers_.object_of(setup.view).shape;
        for (std::int64_t& line : lines_) {
            if (line >= shape.lines || random.chance(0.2)) line = random.in(0, shape.lines - 1);
        }
        if (places_[1] >= shape.p_cells || random.chance(0.2)) {
            places_[0] = static_cast<int>(random.in(0, shape.p_cells - 1));
            places_[1] = std::min(places_[0] + static_cast<int>(random.in(0, 1)), shape.p_cells - 1);
        }
        if (random.chance(0.2)) places_[1] = places_[0];
        setup.map_line = lines_;
        setup.map_place = places_;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const int number = valid_view(registers_, this->module_.view);
        const model::ShapeRegisters& shape = registers_.object_of(number).shape;
        this->module_.view_width = static_cast<SData>(registers_.view(number).width);
        this->module_.shape_p_cells = static_cast<SData>(shape.p_cells);
        this->module_.shape_bands = static_cast<SData>(shape.bands);
        this->module_.shape_cells = shape.cells;
    }

    model::RegisterFile registers_ = random_shapes(this->random_);
    int view_ = 0;
    int columns_left_ = 0;
    int stripes_ = 0;  // that are not drawn yet
    std::array<std::int64_t, 2> lines_{};
    std::array<int, 2> places_{};
    model::Fifo<model::ColumnSetup> set_up_{"set_up", 2, model::ColumnSetup::kBits};
    model::Fifo<model::Done> free_{"stripe_free", 2, model::Done::kBits};
    model::Fifo<model::MemoryRead> reads_{"band_reads", 4, model::MemoryRead::kBits};
    model::Fifo<model::ColumnSetup> to_rise_{"rise_columns", 2, model::ColumnSetup::kRiseBits};
    model::Fifo<model::ColumnSetup> to_march_{"march_columns", 2, model::ColumnSetup::kMarchBits};
    model::Fifo<model::ColumnSetup> to_place_{"place_columns", 2, model::ColumnSetup::kPlaceBits};
    model::BandReader block_{registers_,
                             kShare,
                             {.in = set_up_,
                              .stripe_free = free_,
                              .requests = reads_,
                              .to_rise = to_rise_,
                              .to_march = to_march_,
                              .to_place = to_place_}};
};

template <class Module>
using FirstPipeBandBench = BandReaderBench<Module, 0>;
template <class Module>
using SixthPipeBandBench = BandReaderBench<Module, 5>;

RS_RTL_TESTS(RtlBandReader0, FirstPipeBandBench, band_reader_0)
RS_RTL_TESTS(RtlBandReader5, SixthPipeBandBench, band_reader_5)

}  // namespace
}  // namespace rs::engine::rtl
