#include "engine/model/report/waveform.hpp"

#include <bit>
#include <cstddef>
#include <span>
#include <utility>

namespace rs::engine::model {
namespace {

constexpr std::size_t kFlush_bytes = std::size_t{1} << 20;

// VCD identifiers, shortest first: "!", "\"", ... "!!", ...
std::string identifier(std::size_t n) {
    std::string id;
    do {
        id += static_cast<char>('!' + n % 94);
        n /= 94;
    } while (n > 0);
    return id;
}

std::string change(const std::string& id, int bits, std::uint64_t value) {
    if (bits == 1) return (value != 0 ? "1" : "0") + id + "\n";
    std::string text = "b";
    for (int bit = bits - 1; bit >= 0; --bit) text += (value >> static_cast<unsigned>(bit)) & 1U ? '1' : '0';
    return text + " " + id + "\n";
}

}  // namespace

Result<std::unique_ptr<Waveform>> Waveform::open(const std::filesystem::path& path, BoardTop& board,
                                                 std::uint64_t max_cycles) {
    RS_ASSIGN_OR_RETURN(StagedFile file, StagedFile::create(path));
    std::unique_ptr<Waveform> wave(new Waveform(std::move(file), board, max_cycles));
    wave->declare();
    Waveform* self = wave.get();
    board.simulator.observe([self](std::uint64_t cycle) { self->sample(cycle); });
    return wave;
}

Waveform::Waveform(StagedFile file, BoardTop& board, std::uint64_t max_cycles)
    : file_(std::move(file)), board_(board), max_cycles_(max_cycles) {}

void Waveform::put(const std::string& text) {
    buffer_ += text;
    if (buffer_.size() < kFlush_bytes) return;
    if (status_) status_ = file_.write(std::as_bytes(std::span(buffer_)));
    buffer_.clear();
}

void Waveform::add(const std::string& name, Signal signal, std::string& header) {
    signal.id = identifier(signals_.size());
    header += "$var wire " + std::to_string(signal.bits) + " " + signal.id + " " + name + " $end\n";
    signals_.push_back(std::move(signal));
}

void Waveform::declare() {
    std::string header = "$comment activity:";
    for (std::size_t a = 0; a < kActivities; ++a) {
        header += " " + std::to_string(a) + " " + std::string(activity_name(static_cast<Activity>(a)));
    }
    header += " $end\n$timescale 1 ps $end\n$scope module board $end\n";
    add("clock", {}, header);
    for (const Domain domain : {Domain::board, Domain::pci}) {
        const Simulator::DomainParts& parts = board_.simulator.parts(domain);
        for (const Block* block : parts.blocks) {
            header += "$scope module " + block->name() + " $end\n";
            Signal activity;
            activity.bits = static_cast<int>(std::bit_width(kActivities));
            activity.block = block;
            add("activity", activity, header);
            activity.bits = 1;
            activity.only_busy = true;
            add("busy", activity, header);
            header += "$upscope $end\n";
        }
        header += "$scope module fifos_" + std::string(domain == Domain::board ? "board" : "bus") + " $end\n";
        for (const FifoState* fifo : parts.fifos) {
            Signal count;
            count.bits = static_cast<int>(std::bit_width(static_cast<unsigned>(fifo->depth())));
            count.fifo = fifo;
            add(fifo->name(), count, header);
        }
        for (const CrossingState* fifo : parts.written) {
            Signal count;
            count.bits = static_cast<int>(std::bit_width(static_cast<unsigned>(fifo->depth())));
            count.crossing = fifo;
            add(fifo->name(), count, header);
        }
        header += "$upscope $end\n";
    }
    put(header + "$upscope $end\n$enddefinitions $end\n");
}

void Waveform::sample(std::uint64_t cycle) {
    if (seen_ >= max_cycles_) return;
    ++seen_;
    const std::uint64_t period_ps = 1'000'000 / static_cast<std::uint64_t>(board_.config.clock_mhz);
    std::string text = "#" + std::to_string((cycle - 1) * period_ps) + "\n1" + signals_.front().id + "\n";
    for (std::size_t n = 1; n < signals_.size(); ++n) {
        Signal& s = signals_[n];
        std::uint64_t value = 0;
        if (s.fifo != nullptr) value = static_cast<std::uint64_t>(s.fifo->count());
        if (s.crossing != nullptr) value = static_cast<std::uint64_t>(s.crossing->count());
        if (s.block != nullptr) {
            const Activity activity = s.block->last_activity();
            value = s.only_busy ? static_cast<std::uint64_t>(activity == Activity::busy)
                                : static_cast<std::uint64_t>(activity);
        }
        if (value == s.value) continue;
        s.value = value;
        text += change(s.id, s.bits, value);
    }
    put(text + "#" + std::to_string((cycle - 1) * period_ps + period_ps / 2) + "\n0" + signals_.front().id + "\n");
}

Status Waveform::finish() {
    board_.simulator.observe({});
    if (status_ && !buffer_.empty()) status_ = file_.write(std::as_bytes(std::span(buffer_)));
    if (!status_) return status_;
    return file_.commit();
}

}  // namespace rs::engine::model
