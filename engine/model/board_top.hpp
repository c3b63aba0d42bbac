#pragma once
// The board: constructs and wires the FIFOs and blocks (see DIAGRAM.md), and nothing else.

#include "engine/model/block_decompression.hpp"
#include "engine/model/blocks/host/host_bus.hpp"
#include "engine/model/blocks/host/host_dma.hpp"
#include "engine/model/blocks/memory/disk_controller.hpp"
#include "engine/model/blocks/memory/image_writer.hpp"
#include "engine/model/blocks/memory/memory_controller.hpp"
#include "engine/model/blocks/parallel/dispatch.hpp"
#include "engine/model/blocks/prototype/image_scan.hpp"
#include "engine/model/blocks/prototype/line_reader.hpp"
#include "engine/model/blocks/prototype/render_control.hpp"
#include "engine/model/blocks/prototype/sample_reading.hpp"
#include "engine/model/blocks/prototype/vertical_compensation.hpp"
#include "engine/model/blocks/shared/colour_conversion.hpp"
#include "engine/model/blocks/shared/map_reader.hpp"
#include "engine/model/blocks/shared/view_rays.hpp"
#include "engine/model/clock/simulator.hpp"
#include "engine/model/parallel_pipe.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace rs::engine::model {

// A pipe: FIFOs from a column's start to its pixels. The part between `walks` and `samples` depends on the images:
// SampleReading, or block decompression.
struct PipeFifos : FifoGroup {
    explicit PipeFifos(int sample_bits) : samples(*this, "samples", 4, sample_bits) {}
    Fifo<ViewJob> jobs{*this, "jobs", 2, ViewJob::kBits};
    Fifo<ColumnRay> columns{*this, "columns", 2, ColumnRay::kBits};
    Fifo<RayPoint> points{*this, "points", 2, RayPoint::kBits};
    Fifo<MappedRay> mapped{*this, "mapped", 2, MappedRay::kBits};
    Fifo<RayLine> lines{*this, "lines", 2, RayLine::kBits};
    Fifo<ColumnWalk> walks{*this, "walks", 2, ColumnWalk::kBits};
    Fifo<YuvaPixel> samples;
    Fifo<RgbaPixel> pixels{*this, "pixels", 4, RgbaPixel::kBits};

    Fifo<MemoryRead> map_reads{*this, "map_reads", 2, MemoryRead::kBits};
    Fifo<MemoryWord> map_words{*this, "map_words", 2, MemoryWord::kBits};
    Fifo<MemoryRead> line_reads{*this, "line_reads", 4, MemoryRead::kBits};
    Fifo<MemoryWord> line_words{*this, "line_words", 4, MemoryWord::kBits};
    Fifo<MemoryWrite> image_writes{*this, "image_writes", 16, MemoryWrite::kBits};
    Fifo<Done> view_written{*this, "view_written", 2, Done::kBits};
};

// Uncompressed images: reads the samples of a column's walk, pixel by pixel.
struct SampleReading : FifoGroup {
    static constexpr int kSampleBits = YuvaPixel::kBits;
    SampleReading(const RegisterFile& registers, Fifo<ColumnWalk>& walks, Fifo<YuvaPixel>& samples);
    void add_to(Simulator& simulator);
    void add_ports(std::vector<ReadPort>& ports);

    Fifo<PlacedColumn> placed{*this, "placed", 4, PlacedColumn::kBits};
    Fifo<PixelPair> pairs{*this, "pairs", 4, PixelPair::kBits};
    Fifo<SampleTag> tags{*this, "tags", 32, SampleTag::kBits};
    Fifo<MemoryRead> sample_reads{*this, "sample_reads", 8, MemoryRead::kBits};
    Fifo<MemoryWord> sample_words{*this, "sample_words", 16, MemoryWord::kBits};
    ColumnAddress column_address;
    RowScan row_scan;
    SampleFetch sample_fetch;
    SampleSelect sample_select;
};

// Rendering part of a board: pipes with their memory channels. Views enter, and leave when they are in the image
// buffer.
struct BoardBody : FifoGroup {
    virtual ~BoardBody() = default;
    virtual Fifo<ViewJob>& views_in() = 0;
    virtual Fifo<Done>& views_out() = 0;
    virtual std::vector<DmaPort> dma_ports() = 0;
    virtual void add_pipes(Simulator& simulator) = 0;
    virtual void add_loading(Simulator& /*simulator*/) {}  // adds the block between the disk and several channels
    [[nodiscard]] virtual int channels() const = 0;
    [[nodiscard]] virtual const MemoryController& object_memory_bytes(int channel) const = 0;
    [[nodiscard]] virtual Sdram& sdram_of(int channel) = 0;
    [[nodiscard]] virtual std::optional<PipeMemoryBits> memory_of_a_pipe() const { return std::nullopt; }
};

// One pipe and one memory channel: boards of 2000. `Reading`: SampleReading or BlockDecompression.
template <class Reading>
struct SingleBoard final : BoardBody {
    SingleBoard(const BoardConfig& config, const RegisterFile& registers, Fifo<MemoryWrite>& load_words,
                Fifo<Done>& object_loaded);
    Fifo<ViewJob>& views_in() override { return fifos.jobs; }
    Fifo<Done>& views_out() override { return fifos.view_written; }
    std::vector<DmaPort> dma_ports() override { return {{&host_reads, &host_words}}; }
    void add_pipes(Simulator& simulator) override;
    [[nodiscard]] int channels() const override { return 1; }
    [[nodiscard]] const MemoryController& object_memory_bytes(int) const override { return memory; }
    [[nodiscard]] Sdram& sdram_of(int) override { return sdram; }

    Sdram sdram;
    Fifo<MemoryRead> host_reads{*this, "host_reads", 4, MemoryRead::kBits};
    Fifo<MemoryWord> host_words{*this, "host_words", 8, MemoryWord::kBits};
    PipeFifos fifos{Reading::kSampleBits};
    RasterGenerator raster_generator;
    RayPosition ray_position;
    MapReader map_reader;
    LineReader line_reader;
    VerticalCompensation vertical_compensation;
    Reading reading;
    ColourConversion colour_conversion;
    ImageWriter image_writer;
    MemoryController memory;
};

// The parallel board: several pipes, each with its own channel.
struct ParallelBoard final : BoardBody {
    ParallelBoard(const BoardConfig& config, const RegisterFile& registers, Fifo<MemoryWrite>& load_words,
                  Fifo<Done>& object_loaded);
    Fifo<ViewJob>& views_in() override { return jobs; }
    Fifo<Done>& views_out() override { return view_written; }
    std::vector<DmaPort> dma_ports() override;
    void add_pipes(Simulator& simulator) override;
    void add_loading(Simulator& simulator) override { simulator.add(Domain::board, load_broadcast); }
    [[nodiscard]] int channels() const override { return static_cast<int>(pipes.size()); }
    [[nodiscard]] const MemoryController& object_memory_bytes(int channel) const override {
        return pipe(channel).memory;
    }
    [[nodiscard]] Sdram& sdram_of(int channel) override { return pipe(channel).sdram; }
    [[nodiscard]] std::optional<PipeMemoryBits> memory_of_a_pipe() const override { return pipe_memory_bits(pipe(0)); }
    [[nodiscard]] ParallelPipe& pipe(int n) const { return *pipes[static_cast<std::size_t>(n)]; }

    Fifo<ViewJob> jobs{*this, "jobs", 2, ViewJob::kBits};
    Fifo<Done> view_written{*this, "view_written", 2, Done::kBits};
    std::vector<std::unique_ptr<ParallelPipe>> pipes;
    ViewDispatcher view_dispatcher;
    LoadBroadcast load_broadcast;
};

struct BoardTop : FifoGroup {
    explicit BoardTop(const BoardConfig& config, std::uint64_t shuffle_seed = 0);

    const BoardConfig config;
    RegisterFile registers;
    HostPrograms programs;

    CrossingFifo<StartCommand> commands{"commands", 4, StartCommand::kBits};
    CrossingFifo<ImageWord> image_words{"image_words", 32, ImageWord::kBits};
    CrossingFifo<Done> transferred{"transferred", 2, Done::kBits};
    Fifo<Done> images_ready{*this, "images_ready", 2, Done::kBits};
    Fifo<Done> buffer_free{*this, "buffer_free", 2, Done::kBits};
    Fifo<MemoryWrite> load_words{*this, "load_words", 64, MemoryWrite::kBits};
    Fifo<Done> object_loaded{*this, "object_loaded", 2, Done::kBits};
    Fifo<Done> object_ready;

    std::unique_ptr<BoardBody> body;
    RenderControl render_control;
    HostDma host_dma;
    DiskController disk_controller;
    HostBus host_bus;
    Simulator simulator;

    [[nodiscard]] int channels() const { return body->channels(); }
    [[nodiscard]] const MemoryController& memory(int channel = 0) const { return body->object_memory_bytes(channel); }
    [[nodiscard]] Sdram& sdram(int channel = 0) { return body->sdram_of(channel); }
};

}  // namespace rs::engine::model
