#pragma once
// Waveform of a run as VCD (IEEE 1364), for GTKWave and other viewers: the board's clock, the fill level of every FIFO,
// and for every block its activity (numbers of Activity) and a busy flag.

#include "engine/model/board_top.hpp"
#include "rayspace/file/file_output.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rs::engine::model {

class Waveform {
public:
    // Records `board` from now on, for at most `max_cycles` board cycles. The board must outlive finish().
    static Result<std::unique_ptr<Waveform>> open(const std::filesystem::path& path, BoardTop& board,
                                                  std::uint64_t max_cycles);
    // Ends recording and publishes the file. Fails with the first write error.
    Status finish();

private:
    Waveform(StagedFile file, BoardTop& board, std::uint64_t max_cycles);
    void declare();
    void sample(std::uint64_t cycle);
    void put(const std::string& text);

    struct Signal {
        std::string id;
        int bits = 1;
        std::uint64_t value = ~std::uint64_t{0};
        const FifoState* fifo = nullptr;
        const CrossingState* crossing = nullptr;
        const Block* block = nullptr;
        bool only_busy = false;
    };
    void add(const std::string& name, Signal signal, std::string& header);

    StagedFile file_;
    BoardTop& board_;
    std::uint64_t max_cycles_;
    std::uint64_t seen_ = 0;
    std::vector<Signal> signals_;
    std::string buffer_;
    Status status_;
};

}  // namespace rs::engine::model
