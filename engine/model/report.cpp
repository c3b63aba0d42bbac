#include "engine/model/report.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace rs::engine::model {
namespace {

using Json = nlohmann::ordered_json;

Interval interval(const Board& board, const Snapshot& begin, const Snapshot& end) {
    Interval result;
    result.board_cycles = end.board_cycles - begin.board_cycles;
    result.seconds = double(result.board_cycles) / (1e6 * board.top().config.clock_mhz);
    const std::vector<const Block*> blocks = board.blocks();
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        BlockShare share{blocks[n]->name(), 0, {}};
        for (std::size_t a = 0; a < kActivities; ++a) {
            share.counts.cycles[a] = end.blocks[n].cycles[a] - begin.blocks[n].cycles[a];
        }
        share.cycles = share.counts.total();
        result.blocks.push_back(std::move(share));
    }
    const auto most = std::max_element(result.blocks.begin(), result.blocks.end(),
                                       [](const auto& a, const auto& b) { return a.occupied() < b.occupied(); });
    if (most != result.blocks.end()) result.limiting_block = most->name;
    return result;
}

Json json_of(const Interval& interval) {
    Json json{{"board_cycles", interval.board_cycles},
              {"seconds", interval.seconds},
              {"limiting_block", interval.limiting_block},
              {"blocks", Json::object()}};
    for (const BlockShare& block : interval.blocks) {
        Json cycles = Json::object();
        for (std::size_t a = 0; a < kActivities; ++a) {
            if (block.counts.cycles[a] > 0) {
                cycles[std::string(activity_name(static_cast<Activity>(a)))] = block.counts.cycles[a];
            }
        }
        json["blocks"][block.name] = {{"occupied", block.occupied()}, {"cycles", cycles}};
    }
    return json;
}

}  // namespace

BoardReport make_report(const Board& board, const BoardRun& run) {
    const BoardTop& top = board.top();
    BoardReport report;
    report.config = top.config.name;
    report.clock_mhz = top.config.clock_mhz;
    report.cycles = static_cast<int>(run.cycles.size());
    for (const RenderedCycle& cycle : run.cycles) {
        report.render_cycles += cycle.render_cycles();
        report.pictures += static_cast<int>(cycle.pictures.size());
        for (const Image<Rgba8>& picture : cycle.pictures) {
            report.pixels += static_cast<std::int64_t>(picture.pixels().size());
        }
    }
    const double clock_hz = 1e6 * top.config.clock_mhz;
    if (report.render_cycles > 0) {
        report.pixels_per_second = clock_hz * double(report.pixels) / double(report.render_cycles);
        report.cycles_per_second = clock_hz * report.cycles / double(report.render_cycles);
    }
    if (run.cycles.size() > 1) {
        report.arrivals_per_second =
            clock_hz * (report.cycles - 1) / double(run.cycles.back().arrived - run.cycles.front().arrived);
    }
    report.rendering = interval(board, run.begin, run.rendered);
    report.delivering = interval(board, run.first_rendered, run.end);
    report.board_cycles = run.end.board_cycles - run.begin.board_cycles;
    report.counters = top.memory.counters();
    report.bus = top.host_bus.counters();
    const std::vector<ReadPort>& ports = top.memory.read_ports();
    for (std::size_t n = 0; n < ports.size(); ++n) {
        report.memory.push_back({ports[n].client, report.counters.words_read[n], report.counters.nulls[n]});
    }
    report.memory.push_back({"image_writer", report.counters.image_words, 0});
    report.memory.push_back({"disk_controller", report.counters.load_words, 0});
    return report;
}

std::string report_json(const BoardReport& report) {
    Json memory = Json::object();
    for (const MemoryTraffic& traffic : report.memory) {
        memory[traffic.client] = {
            {"bytes", traffic.words * 8}, {"words", traffic.words}, {"null_reads", traffic.nulls}};
    }
    const Json json{{"config", report.config},
                    {"clock_mhz", report.clock_mhz},
                    {"rendering_cycles", report.cycles},
                    {"pictures", report.pictures},
                    {"pixels", report.pixels},
                    {"render_cycles", report.render_cycles},
                    {"mpixels_per_second", report.pixels_per_second / 1e6},
                    {"rendering_cycles_per_second", report.cycles_per_second},
                    {"arrivals_per_second", report.arrivals_per_second},
                    {"rendering", json_of(report.rendering)},
                    {"delivering", json_of(report.delivering)},
                    {"memory_channel_0",
                     {{"clients", memory},
                      {"row_misses", report.counters.row_misses},
                      {"write_batches", report.counters.write_batches},
                      {"maintenance_windows", report.counters.windows}}},
                    {"host_bus",
                     {{"image_bytes", report.bus.image_bytes},
                      {"bursts", report.bus.bursts},
                      {"retries", report.bus.retries},
                      {"register_writes", report.bus.register_writes}}}};
    return json.dump(2);
}

}  // namespace rs::engine::model
