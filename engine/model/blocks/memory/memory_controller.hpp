#pragma once
// Memory controller: one 64-bit port to one channel of SDRAM, one command per cycle.
//
// Order of service: the maintenance window; a batch of image writes that has begun, or for which `write_batch` words
// wait; the read ports in their order; other image writes if no port can be served. A read is accepted only if its
// answer FIFO will have space. The chosen client keeps the port until its word is transferred; a closed row costs a
// precharge and an activate.
//
// Maintenance window, every `maintenance_interval` cycles: all banks are closed and refreshed, then as many words of
// the private bus as fit are written. Its duration does not depend on the number of words, so loading an object does
// not change the timing of rendering by a single cycle:
//
//     precharge all | tRP | refresh | tRFC | activate | tRCD | load words | tWR | precharge | tRP

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"

#include <vector>

namespace rs::engine::model {

struct ReadPort {
    std::string client;
    Fifo<MemoryRead>* requests = nullptr;
    Fifo<MemoryWord>* answers = nullptr;
};

class MemoryController final : public Block {
public:
    struct Counters {
        std::vector<std::uint64_t> words_read;  // per read port
        std::vector<std::uint64_t> nulls;       // per read port
        std::uint64_t image_words = 0;
        std::uint64_t load_words = 0;
        std::uint64_t row_misses = 0;
        std::uint64_t write_batches = 0;
        std::uint64_t windows = 0;
    };

    struct Ports {
        std::vector<ReadPort> read_ports;
        Fifo<MemoryWrite>& image_writes;
        Fifo<Done>& view_written;
        Fifo<MemoryWrite>& loads;
        Fifo<Done>& object_loaded;
    };
    MemoryController(std::string name, const MemorySettings& settings, Sdram& sdram, const Ports& ports);
    Activity tick(std::uint64_t now) override;

    [[nodiscard]] const Counters& counters() const { return counters_; }
    [[nodiscard]] const std::vector<ReadPort>& read_ports() const { return ports_; }
    [[nodiscard]] std::string state_text() const override;

    // Cycles of the window from its refresh command, from which on its duration is fixed.
    static int window_cycles(const MemorySettings& settings);
    // Cycles from a read command until its word is visible to the client.
    static int read_cycles(const MemorySettings& settings);

private:
    static constexpr int kNoClient = -1;
    static constexpr int kImageWrite = -2;
    enum class Window { none, closing, refreshing, loading };

    void deliver(std::uint64_t now);
    Activity maintain(std::uint64_t now);
    void load_word(std::uint64_t now);
    void choose_client();
    Activity serve(std::uint64_t now);
    Activity open_row(WordAddress address, std::uint64_t now);
    Activity serve_read(std::uint64_t now);
    Activity serve_write(std::uint64_t now);

    struct InFlight {
        int port = kNoClient;
        std::uint64_t data = 0;
    };

    MemorySettings settings_;
    Sdram& sdram_;
    std::vector<ReadPort> ports_;
    Fifo<MemoryWrite>& image_writes_;
    Fifo<Done>& view_written_;
    Fifo<MemoryWrite>& loads_;
    Fifo<Done>& object_loaded_;
    Counters counters_;

    std::vector<InFlight> in_flight_;  // ring buffer, indexed by the cycle of arrival
    std::vector<int> outstanding_;     // per port: outstanding answers
    int returned_ = kNoClient;         // port whose answer was pushed in the previous cycle
    int chosen_ = kNoClient;
    int batch_left_ = 0;
    bool starved_ = false;  // a port has a request, but no space for the answer
    Window window_ = Window::none;
    std::uint64_t next_window_ = 0;
    std::uint64_t refreshed_ = 0;  // cycle of the window's refresh
    bool load_row_open_ = false;
};

}  // namespace rs::engine::model
