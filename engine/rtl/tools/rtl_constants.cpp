// rtl_constants CONFIG FILE: writes the SystemVerilog package `board` of a board with uncompressed images:
// depth and width of every FIFO, latencies of the blocks, and the settings of its configuration. All values come from
// the model, so that RTL and model cannot differ in them.

#include "engine/model/board_top.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/file/file_output.hpp"

#include <bit>
#include <cctype>
#include <cstdint>
#include <iostream>
#include <string>

namespace rs::engine::model {
namespace {

class PackageText {
public:
    void add(std::string name, std::int64_t value) {
        for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        text_ += "  localparam int " + name + " = " + std::to_string(value) + ";\n";
    }
    void add_fifo(const std::string& name, int depth, int bits) {
        add(name + "_depth", depth);
        add(name + "_bits", bits);
    }
    [[nodiscard]] std::string package(const std::string& config) const {
        return "// Constants of the board " + config +
               ", generated from the model.\n\n"
               "/* verilator lint_off UNUSEDPARAM */\npackage board;\n" +
               text_ + "endpackage\n/* verilator lint_on UNUSEDPARAM */\n";
    }

private:
    std::string text_;
};

int bits_of(int largest) {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(largest)));
}

void add_group(PackageText& package, const FifoGroup& group) {
    for (const FifoState* fifo : group.fifos()) package.add_fifo(fifo->name(), fifo->depth(), fifo->width_bits());
}

void add_fifos(PackageText& package, const BoardTop& top) {
    for (const Domain domain : {Domain::board, Domain::pci}) {
        const Simulator::DomainParts& parts = top.simulator.parts(domain);
        for (const FifoState* fifo : parts.fifos) package.add_fifo(fifo->name(), fifo->depth(), fifo->width_bits());
        for (const CrossingState* fifo : parts.written) {
            package.add_fifo(fifo->name(), fifo->depth(), fifo->width_bits());
        }
    }
}

void add_latencies(PackageText& package) {
    package.add("multiply_cycles", kMultiplyCycles);
    package.add("divide_cycles", kDivideCycles);
    package.add("product_cycles", kProductCycles);
    package.add("root_cycles", kRootCycles);
    package.add("no_ray_latency", RayPosition::kNoRayLatency);
    package.add("ray_position_miss_latency", RayPosition::kMissLatency);
    package.add("ray_position_latency", RayPosition::kLatency);
    package.add("compensation_too_near_latency", VerticalCompensation::kTooNearLatency);
    package.add("compensation_outside_latency", VerticalCompensation::kOutsideLatency);
    package.add("compensation_latency", VerticalCompensation::kLatency);
    package.add("column_address_latency", ColumnAddress::kLatency);
    package.add("colour_stages", ColourConversion::kStages);
    static_assert(RayPosition::kNoRayLatency == VerticalCompensation::kNoRayLatency &&
                  RayPosition::kNoRayLatency == ColumnAddress::kNoRayLatency);
}

void add_tags(PackageText& package) {
    package.add("tag_alpha", static_cast<int>(SampleTag::Kind::alpha));
    package.add("tag_chroma", static_cast<int>(SampleTag::Kind::chroma));
    package.add("tag_luma", static_cast<int>(SampleTag::Kind::luma));
}

// Block decompression, which prototype-2000 lacks: its FIFOs, of which those of hop N end in _N, and its messages.
void add_block_decompression(PackageText& package) {
    const RegisterFile no_registers;
    const RecordChains chains(no_registers);
    for (const auto& hop : chains.hop_fifos) add_group(package, *hop);
    add_group(package, chains);
    package.add("asks_bits", BlockRequest::kBits);
    package.add("found_bits", FoundTile::kBits);
    package.add("tiles_bits", RequestedTile::kBits);
    package.add("asked_records_bits", RequestedRecord::kBits);
    package.add("records_bits", BlockRecord::kBits);
    package.add("coded_pixels_bits", CodedPixel::bits(0));
    package.add("coded_colour_bits", CodedPixel::kColourBits);
    package.add("hop_lookup_bits", HopLookup::kBits);
    package.add("yuv_bits", YuvaPixel::kBits - 2);
    package.add("alpha_none", static_cast<int>(CodedPixel::Alpha::none));
    package.add("alpha_full", static_cast<int>(CodedPixel::Alpha::full));
    package.add("alpha_book", static_cast<int>(CodedPixel::Alpha::book));
    package.add("empty_sample", codec::kEmptySample);
    package.add("book_stages", BookLookup::kStages);
    package.add("tile_same", static_cast<int>(RequestedTile::Kind::same));
    package.add("tile_nothing", static_cast<int>(RequestedTile::Kind::nothing));
    package.add("tile_read", static_cast<int>(RequestedTile::Kind::read));
    package.add("run_pixels", BlockScan::kMaxPixels);
}

// Messages and limits of the blocks of `parallel`.
void add_parallel_blocks(PackageText& package) {
    package.add("direction_bits", RayPoint::kBitsWithDirection - RayPoint::kBits);
    package.add("fills_bits", TexelFill::kBits);
    package.add("targets_bits", FillTarget::kBits);
    package.add("kinds_bits", FillKind::kBits);
    package.add("quads_bits", TexelQuad::kBits);
    package.add("filtered_bits", FilteredSample::kBits);
    package.add("patches_bits", PatchJob::kBits);
    package.add("scanned_bits", ScannedPixel::kBits);
    package.add("risen_bits", PixelBandRay::kBits);
    package.add("met_bits", SurfaceHit::kBits);
    package.add("ray_rise_stages", RayRise::kStages);
    package.add("cell_march_stages", CellMarch::kStages);
    package.add("march_at_foot", MarchState::kFoot);
    package.add("resolved_bits", FinishedPixel::kBits);
    package.add("empty_bits", FinishedPixel::kBitsOfEmpty);
    package.add("again_bits", ReturnedPixel::kBits);
    package.add("surface_blend_stages", SurfaceBlend::kStages);
    package.add("covering_alpha", kCoveringAlpha);
    package.add("texel_filter_stages", TexelFilter::kStages);
    package.add("raw_block_words", kRawBlockWords);
    package.add("stripe_turn", kStripeTurn);
    package.add("bracketed_bits", BracketedRay::kBits);
    package.add("image_line_bits", ImageLine::kBits);
    package.add("lined_bits", RayWithLines::kBits);
    package.add("set_up_bits", ColumnSetup::kBits);
    package.add("rise_columns_bits", ColumnSetup::kRiseBits);
    package.add("march_columns_bits", ColumnSetup::kMarchBits);
    package.add("place_columns_bits", ColumnSetup::kPlaceBits);
    package.add("column_setup_too_far_latency", ColumnSetupStage::kTooFarLatency);
    package.add("column_setup_latency", ColumnSetupStage::kShapeLatency);
    package.add("ray_none", static_cast<int>(RayKind::none));
    package.add("ray_plane", static_cast<int>(RayKind::plane));
    package.add("ray_foot", static_cast<int>(RayKind::foot));
    package.add("ray_shape", static_cast<int>(RayKind::shape));
    package.add("placed_samples_bits", PlacedSample::kBits);
    package.add("sample_place_stages", SamplePlace::kStages);
    package.add("waiting_bits", WaitingSample::kBits);
    package.add("waiting_samples", kWaitingSamples);
    const ParallelFifos fifos;
    for (const FifoState* fifo : fifos.fifos()) {
        package.add_fifo("parallel_" + fifo->name(), fifo->depth(), fifo->width_bits());
    }
}

void add_limits(PackageText& package, const BoardLimits& limits) {
    package.add("objects", limits.objects);
    package.add("object_bits", bits_of(limits.objects - 1));
    package.add("views", limits.views_per_cycle);
    package.add("view_bits", ViewJob::kBits);
    package.add("planes", kMaxPlanes);
    package.add("plane_bits", bits_of(kMaxPlanes));
    package.add("image_bits", bits_of(limits.images_per_object));
    package.add("image_side_bits", bits_of(limits.image_side_px));
    package.add("view_side_bits", bits_of(limits.image_buffer_side_px));
    package.add("map_side_bits", bits_of(limits.map_side));
    package.add("image_buffer_side_px", limits.image_buffer_side_px);
}

void add_memory(PackageText& package, const MemorySettings& memory, const RegisterFile& registers) {
    const SdramTiming& t = memory.timing;
    package.add("address_bits", memory.shape.address_bits());
    package.add("sdram_bank_bits", memory.shape.bank_bits);
    package.add("sdram_row_bits", memory.shape.row_bits);
    package.add("sdram_column_bits", memory.shape.column_bits);
    package.add("sdram_activate_to_column", t.activate_to_column);
    package.add("sdram_precharge_to_activate", t.precharge_to_activate);
    package.add("sdram_activate_to_precharge", t.activate_to_precharge);
    package.add("sdram_activate_to_activate", t.activate_to_activate);
    package.add("sdram_write_to_precharge", t.write_to_precharge);
    package.add("sdram_refresh_to_any", t.refresh_to_any);
    package.add("sdram_read_latency", t.read_latency);
    package.add("sdram_interface_latency", t.interface_latency);
    package.add("read_cycles", MemoryController::read_cycles(memory));
    package.add("maintenance_interval", memory.maintenance_interval);
    package.add("load_words_per_window", memory.load_words_per_window);
    package.add("write_batch", memory.write_batch);
    package.add("first_image_word", registers.images);
    package.add("words_per_image_buffer", registers.words_per_buffer);
    package.add("words_per_image", registers.words_per_view);
    package.add("image_size_bits", bits_of(registers.words_per_view));
}

void add_buses(PackageText& package, const BoardConfig& config) {
    package.add("queue_cycles", config.queue_cycles);
    package.add("pci_width_bits", config.pci.width_bits);
    package.add("pci_burst_words", config.pci.burst_words);
    package.add("pci_grant_clocks", config.pci.grant_clocks);
    package.add("pci_target_clocks", config.pci.target_clocks);
    package.add("pci_wait_per_transfer", config.pci.wait_per_transfer);
    package.add("pci_register_clocks", config.pci.register_clocks);
    package.add("pci_interrupt_clocks", config.pci.interrupt_clocks);
    package.add("pci_compression", config.pci.compression);
    package.add("pci_dedicated", config.pci.dedicated);
    package.add("disk_cycles_per_transfer", config.disk.cycles_per_transfer);
    package.add("disk_timeout_cycles", static_cast<std::int64_t>(config.disk.timeout_cycles));
}

Status write_constants(const std::string& config_name, const std::string& path) {
    RS_ASSIGN_OR_RETURN(const BoardConfig config, read_board_config(config_name));
    if (config.limits.kind != BoardKind::raw_images) {
        return Error{config_name +
                     ": its images are compressed, and the RTL reads uncompressed ones; give "
                     "prototype-2000, or a configuration based on it"};
    }
    const BoardTop top(config);
    PackageText package;
    add_fifos(package, top);
    add_latencies(package);
    add_tags(package);
    add_block_decompression(package);
    add_parallel_blocks(package);
    add_limits(package, config.limits);
    add_memory(package, config.memory, top.registers);
    add_buses(package, config);
    return write_file(path, package.package(config.name));
}

}  // namespace
}  // namespace rs::engine::model

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "Usage: rtl_constants CONFIG FILE\n";
        return 2;
    }
    if (const rs::Status status = rs::engine::model::write_constants(argv[1], argv[2]); !status) {
        std::cerr << "rtl_constants: " << status.error().message << '\n';
        return 1;
    }
    return 0;
}
