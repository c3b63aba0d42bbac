#include "engine/model/report/report.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace rs::engine::model {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Adds the share to that of the same block in other pipes, if any.
void add_block(BlockShare share, std::vector<BlockShare>& blocks) {
    share.name = name_without_pipe(share.name);
    const auto same =
        std::find_if(blocks.begin(), blocks.end(), [&](const BlockShare& b) { return b.name == share.name; });
    if (same == blocks.end()) {
        blocks.push_back(std::move(share));
        return;
    }
    same->cycles += share.cycles;
    for (std::size_t a = 0; a < kActivities; ++a) same->counts.cycles[a] += share.counts.cycles[a];
}

ActivityCounts difference(const ActivityCounts& end, const ActivityCounts& begin) {
    ActivityCounts counts;
    for (std::size_t a = 0; a < kActivities; ++a) counts.cycles[a] = end.cycles[a] - begin.cycles[a];
    return counts;
}

Interval interval(const Board& board, const Snapshot& begin, const Snapshot& end) {
    Interval result;
    result.board_cycles = end.board_cycles - begin.board_cycles;
    result.seconds = double(result.board_cycles) / (1e6 * board.top().config.clock_mhz);
    const std::vector<const Block*> blocks = board.blocks();
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        BlockShare share{blocks[n]->name(), 0, difference(end.blocks[n], begin.blocks[n])};
        share.cycles = share.counts.total();
        add_block(std::move(share), result.blocks);
    }
    const auto most = std::max_element(result.blocks.begin(), result.blocks.end(),
                                       [](const auto& a, const auto& b) { return a.occupied() < b.occupied(); });
    if (most != result.blocks.end()) result.limiting_block = most->name;
    return result;
}

ChannelReport channel_report(const MemoryController& memory, const ActivityCounts& begin, const ActivityCounts& end) {
    ChannelReport channel;
    channel.counters = memory.counters();
    const std::vector<ReadPort>& ports = memory.read_ports();
    for (std::size_t n = 0; n < ports.size(); ++n) {
        channel.clients.push_back({ports[n].client, channel.counters.words_read[n], channel.counters.nulls[n]});
    }
    channel.clients.push_back({"image_writer", channel.counters.image_words, 0});
    channel.clients.push_back({"disk_controller", channel.counters.load_words, 0});
    for (const MemoryTraffic& client : channel.clients) channel.words += client.words;
    channel.rendering = {memory.name(), 0, difference(end, begin)};
    channel.rendering.cycles = channel.rendering.counts.total();
    return channel;
}

OrderedJson json_of(const ChannelReport& channel) {
    OrderedJson clients = OrderedJson::object();
    for (const MemoryTraffic& traffic : channel.clients) {
        clients[traffic.client] = {
            {"bytes", traffic.words * 8}, {"words", traffic.words}, {"null_reads", traffic.nulls}};
    }
    return {{"clients", clients},
            {"row_misses", channel.counters.row_misses},
            {"write_batches", channel.counters.write_batches},
            {"maintenance_windows", channel.counters.windows},
            {"bytes", channel.words * 8},
            {"share_of_peak_while_rendering", channel.rendering.share(Activity::busy)},
            {"occupied_while_rendering", channel.rendering.occupied()}};
}

OrderedJson json_of(const Interval& interval) {
    OrderedJson json{{"board_cycles", interval.board_cycles},
                     {"seconds", interval.seconds},
                     {"limiting_block", interval.limiting_block},
                     {"blocks", OrderedJson::object()}};
    for (const BlockShare& block : interval.blocks) {
        OrderedJson cycles = OrderedJson::object();
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

RenderRates render_rates(const std::vector<RenderedCycle>& cycles, double clock_mhz) {
    RenderRates rates;
    rates.cycles = static_cast<int>(cycles.size());
    for (const RenderedCycle& cycle : cycles) {
        rates.render_cycles += cycle.render_cycles();
        rates.images += static_cast<int>(cycle.images.size());
        for (const Image<Rgba8>& image : cycle.images) rates.pixels += static_cast<std::int64_t>(image.pixels().size());
    }
    const double clock_hz = 1e6 * clock_mhz;
    if (rates.render_cycles > 0) {
        rates.pixels_per_second = clock_hz * double(rates.pixels) / double(rates.render_cycles);
        rates.cycles_per_second = clock_hz * rates.cycles / double(rates.render_cycles);
    }
    if (cycles.size() > 1) {
        rates.arrivals_per_second =
            clock_hz * (rates.cycles - 1) / double(cycles.back().arrived - cycles.front().arrived);
    }
    return rates;
}

BoardReport make_report(const Board& board, const BoardRun& run) {
    const BoardTop& top = board.top();
    BoardReport report;
    report.config = top.config.name;
    report.clock_mhz = top.config.clock_mhz;
    static_cast<RenderRates&>(report) = render_rates(run.cycles, report.clock_mhz);
    report.rendering = interval(board, run.begin, run.rendered);
    report.delivering = interval(board, run.first_rendered, run.end);
    report.board_cycles = run.end.board_cycles - run.begin.board_cycles;
    report.bus = top.host_bus.counters();
    const std::vector<const Block*> blocks = board.blocks();
    for (int c = 0; c < top.channels(); ++c) {
        const MemoryController& memory = top.memory(c);
        const auto at = static_cast<std::size_t>(std::find(blocks.begin(), blocks.end(), &memory) - blocks.begin());
        report.channels.push_back(channel_report(memory, run.begin.blocks[at], run.rendered.blocks[at]));
    }
    report.counters = report.channels.front().counters;
    report.memory = report.channels.front().clients;
    return report;
}

std::string report_json(const BoardReport& report) {
    OrderedJson json{{"config", report.config},
                     {"clock_mhz", report.clock_mhz},
                     {"rendering_cycles", report.cycles},
                     {"pictures", report.images},
                     {"pixels", report.pixels},
                     {"render_cycles", report.render_cycles},
                     {"mpixels_per_second", report.pixels_per_second / 1e6},
                     {"rendering_cycles_per_second", report.cycles_per_second},
                     {"arrivals_per_second", report.arrivals_per_second},
                     {"rendering", json_of(report.rendering)},
                     {"delivering", json_of(report.delivering)},
                     {"host_bus",
                      {{"image_bytes", report.bus.image_bytes},
                       {"bursts", report.bus.bursts},
                       {"retries", report.bus.retries},
                       {"register_writes", report.bus.register_writes}}}};
    for (std::size_t c = 0; c < report.channels.size(); ++c) {
        json["memory_channel_" + std::to_string(c)] = json_of(report.channels[c]);
    }
    return json.dump(2);
}

}  // namespace rs::engine::model
