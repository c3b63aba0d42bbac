#include "engine/model/blocks/shared/map_reader.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vmap_reader_0.h>
#include <Vmap_reader_0_mutants.h>
#include <Vmap_reader_1.h>
#include <Vmap_reader_1_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module, int kPointBits, int kMappedBits>
class MapReaderBench final : public Bench<Module> {
public:
    MapReaderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(points_, RS_RTL_PORTS(module, points), [this] { return point(); });
        this->output(map_reads_, RS_RTL_PORTS(module, map_reads), [this](const model::MemoryRead&) { ++requested_; });
        this->input(
            map_words_, RS_RTL_PORTS(module, map_words), [this] { return word(); }, [this] { return requested_ > 0; });
        this->output(mapped_, RS_RTL_PORTS(module, mapped));
    }

private:
    model::RayPoint point() {
        Random& random = this->random_;
        model::RayPoint point;
        point.view = static_cast<int>(random.in(0, 14));
        point.has_ray = random.chance(0.8);
        point.plane = static_cast<int>(random.in(0, 11));
        point.x_q20 = random.of_any_length(23);
        point.lambda_q20 = random.in(0, (1 << 29) - 1);
        point.cell_byte = static_cast<std::uint64_t>(random.in(0, (1 << 30) - 1));
        point.u_q28 = random.of_any_length(30);
        point.n_q28 = random.in(0, (std::int64_t{1} << 31) - 1);
        point.t_q28 = random.of_any_length(32);
        return point;
    }
    model::MemoryWord word() {
        --requested_;
        const std::uint64_t word = this->random_.word();
        return {this->random_.chance(0.3) ? word | 0xFF'FF'FF'FF'FFU : word};
    }
    model::Block& block() override { return block_; }

    int requested_ = 0;
    model::Fifo<model::RayPoint> points_{"points", 2, kPointBits};
    model::Fifo<model::MemoryRead> map_reads_{"map_reads", 2, model::MemoryRead::kBits};
    model::Fifo<model::MemoryWord> map_words_{"map_words", 2, model::MemoryWord::kBits};
    model::Fifo<model::MappedRay> mapped_{"mapped", 2, kMappedBits};
    model::MapReader block_{{.in = points_, .requests = map_reads_, .answers = map_words_, .out = mapped_}};
};

template <class Module>
using PrototypeMapBench = MapReaderBench<Module, model::RayPoint::kBits, model::MappedRay::kBits>;
template <class Module>
using ParallelMapBench =
    MapReaderBench<Module, model::RayPoint::kBitsWithDirection, model::MappedRay::kBitsWithDirection>;

RS_RTL_TESTS(RtlMapReader, PrototypeMapBench, map_reader_0)
RS_RTL_TESTS(RtlParallelMapReader, ParallelMapBench, map_reader_1)

}  // namespace
}  // namespace rs::engine::rtl
