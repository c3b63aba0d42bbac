#include "engine/model/signals/board_config.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>

namespace rs::engine::model {
namespace {

using Json = nlohmann::json;

constexpr int kPublishedObjects = 20;
// Registers for eight times the published number of objects, which the memory can hold. 512 bits each: 5 block RAMs.
constexpr int kCodedObjects = 160;
constexpr int kMaxPipes = 32;

BoardConfig prototype_2000() {
    BoardConfig config;  // the defaults are the published board
    config.name = "prototype-2000";
    return config;
}

BoardConfig compressed_2000() {
    BoardConfig config = prototype_2000();
    config.name = "compressed-2000";
    config.limits.kind = BoardKind::coded_images;
    config.limits.objects = kCodedObjects;
    // Images with and without references are in different banks, so that the hops of a prediction share no bank.
    config.memory.regions.objects = {
        {{"flat_tiles", 0, 2}, {"predicted_tiles", 2, 4}, {"tile_table", 6, 1}, {"tables", 7, 8}}};
    return config;
}

BoardConfig parallel() {
    BoardConfig config = compressed_2000();
    config.name = "parallel";
    config.pipes = 16;
    config.limits.kind = BoardKind::any_object;
    config.limits.shape_bands = kMaxBands;
    config.memory.regions.objects = {
        {{"flat_tiles", 0, 4}, {"predicted_tiles", 4, 4}, {"tile_table", 8, 1}, {"tables", 9, 5}}};
    config.memory.regions.images = {"images", 14, 2};
    config.memory.regions.image_parts = 2;
    config.pci.burst_words = 16;
    config.pci.wait_per_transfer = 0;
    return config;
}

// A burst of 128 bytes (PCI-X may disconnect there) without wait states, which PCI-X forbids. The driver takes the same
// 10 us between two images.
BoardConfig prototype_2000_pci_x() {
    BoardConfig config = prototype_2000();
    config.name = "prototype-2000-pci-x";
    config.pci.clock_mhz = 133;
    config.pci.width_bits = 64;
    config.pci.burst_words = 16;
    config.pci.wait_per_transfer = 0;
    config.pci.interrupt_clocks = 1330;
    return config;
}

// Same width, clock and wait states as the PCI bus, but no other master, no processor cache to snoop, and no driver
// between two images.
BoardConfig prototype_2000_dedicated() {
    BoardConfig config = prototype_2000();
    config.name = "prototype-2000-dedicated";
    config.pci.dedicated = 1;
    config.pci.grant_clocks = 1;
    config.pci.target_clocks = 1;
    config.pci.interrupt_clocks = 0;
    return config;
}

BoardConfig prototype_2000_compressed_transfer() {
    BoardConfig config = prototype_2000();
    config.name = "prototype-2000-compressed-transfer";
    config.pci.compression = 2;
    return config;
}

struct BusRemedy {
    const char* name;
    BoardConfig (*config)();
};
constexpr std::array<BusRemedy, 3> kBusRemedies = {
    {{"prototype-2000-pci-x", prototype_2000_pci_x},
     {"prototype-2000-dedicated", prototype_2000_dedicated},
     {"prototype-2000-compressed-transfer", prototype_2000_compressed_transfer}}};

// Kinds of boards, in the order of BoardKind. 0: boards of that kind do not have this setting.
struct BoardKindSettings {
    const char* base;
    BoardConfig (*built_in)();
    int most_objects;
    int most_pipes;
    int most_bands;
};
constexpr std::array<BoardKindSettings, 3> kKinds = {{{"prototype-2000", prototype_2000, kPublishedObjects, 0, 0},
                                                      {"compressed-2000", compressed_2000, kCodedObjects, 0, 0},
                                                      {"parallel", parallel, kCodedObjects, kMaxPipes, kMaxBands}}};

const BoardKindSettings& kind_of(const BoardConfig& config) {
    return kKinds.at(static_cast<std::size_t>(config.limits.kind));
}

// Calls visit(path, reference, least, most) for every number of a configuration: a single list for reading, writing and
// range checks.
template <class Config, class Visit>
void for_each_number(Config& c, Visit&& visit) {
    const BoardKindSettings& kind = kind_of(c);
    visit("clock_mhz", c.clock_mhz, 1, 1000);
    visit("queue_cycles", c.queue_cycles, 1, 2);
    visit("no_progress_cycles", c.no_progress_cycles, 1000, 1'000'000'000);
    if (kind.most_pipes > 0) visit("pipes", c.pipes, 1, kind.most_pipes);
    visit("limits/objects", c.limits.objects, 1, kind.most_objects);
    visit("limits/views_per_cycle", c.limits.views_per_cycle, 1, 15);
    visit("limits/pictures_per_object", c.limits.images_per_object, 1, 120);
    visit("limits/picture_side_px", c.limits.image_side_px, 1, 512);
    visit("limits/planes", c.limits.planes, 1, 12);
    visit("limits/map_side", c.limits.map_side, 1, 1024);
    if (kind.most_bands > 0) visit("limits/shape_bands", c.limits.shape_bands, 1, kind.most_bands);
    visit("limits/image_buffer_side_px", c.limits.image_buffer_side_px, 1, 512);
    visit("memory/bank_bits", c.memory.shape.bank_bits, 1, 4);
    visit("memory/row_bits", c.memory.shape.row_bits, 1, 14);
    visit("memory/column_bits", c.memory.shape.column_bits, 5, 12);
    visit("memory/activate_to_column", c.memory.timing.activate_to_column, 1, 15);
    visit("memory/precharge_to_activate", c.memory.timing.precharge_to_activate, 1, 15);
    visit("memory/activate_to_precharge", c.memory.timing.activate_to_precharge, 1, 15);
    visit("memory/activate_to_activate", c.memory.timing.activate_to_activate, 1, 31);
    visit("memory/write_to_precharge", c.memory.timing.write_to_precharge, 1, 15);
    visit("memory/refresh_to_any", c.memory.timing.refresh_to_any, 1, 31);
    visit("memory/read_latency", c.memory.timing.read_latency, 1, 4);
    visit("memory/interface_latency", c.memory.timing.interface_latency, 0, 4);
    const auto visit_banks = [&](auto& banks) {
        const std::string region = std::string("memory/") + banks.name;
        visit(region + "/first", banks.first, 0, 15);
        visit(region + "/count", banks.count, 1, 16);
    };
    for (auto& banks : c.memory.regions.objects) visit_banks(banks);
    visit_banks(c.memory.regions.images);
    visit("memory/maintenance_interval", c.memory.maintenance_interval, 64, 100'000);
    visit("memory/load_words_per_window", c.memory.load_words_per_window, 1, 1024);
    visit("memory/write_batch", c.memory.write_batch, 1, 15);
    visit("pci/clock_mhz", c.pci.clock_mhz, 33, 133);
    visit("pci/width_bits", c.pci.width_bits, 32, 64);
    visit("pci/burst_words", c.pci.burst_words, 1, 16);
    visit("pci/grant_clocks", c.pci.grant_clocks, 1, 1000);
    visit("pci/target_clocks", c.pci.target_clocks, 1, 1000);
    visit("pci/wait_per_transfer", c.pci.wait_per_transfer, 0, 100);
    visit("pci/register_clocks", c.pci.register_clocks, 1, 1000);
    visit("pci/interrupt_clocks", c.pci.interrupt_clocks, 0, 1'000'000);
    visit("pci/dedicated", c.pci.dedicated, 0, 1);
    visit("pci/compression", c.pci.compression, 1, 2);
    visit("pci/retry_every", c.pci.retry_every, 0, 1'000'000);
    visit("disk/cycles_per_transfer", c.disk.cycles_per_transfer, 1, 1000);
    visit("disk/start_cycles", c.disk.start_cycles, 0, 1'000'000'000);
    visit("disk/media_cycles_per_sector", c.disk.media_cycles_per_sector, 1, 1'000'000);
    visit("disk/buffer_sectors", c.disk.buffer_sectors, 1, 4096);
    visit("disk/stall_after_bytes", c.disk.stall_after_bytes, 0, 2'000'000'000);
    visit("disk/stall_cycles", c.disk.stall_cycles, 0, 2'000'000'000);
    visit("disk/timeout_cycles", c.disk.timeout_cycles, 1, 2'000'000'000);
}

// Validates the values of the bus; "" if valid.
std::string bus_error(const PciSettings& pci) {
    if (pci.clock_mhz != 33 && pci.clock_mhz != 66 && pci.clock_mhz != 133) {
        return "pci/clock_mhz: must be 33 or 66 (PCI) or 133 (PCI-X)";
    }
    if (pci.width_bits != 32 && pci.width_bits != 64) return "pci/width_bits: must be 32 or 64";
    if (pci.compression > 1 && pci.width_bits == 64) {
        return "pci/compression: 2 needs pci/width_bits 32, since the board gives the bus one word a clock";
    }
    if (pci.image_words_per_burst() > 16) {
        return "pci/burst_words times pci/compression is above 16, the words that the board holds for a burst";
    }
    return {};
}

// Cross-field validation; "" if valid.
std::string cross_field_error(const BoardConfig& c) {
    const MemoryRegions& r = c.memory.regions;
    const int banks = 1 << c.memory.shape.bank_bits;
    std::vector<int> owners(static_cast<std::size_t>(banks));
    std::vector<RegionBanks> regions(r.objects.begin(), r.objects.end());
    regions.push_back(r.images);
    for (const RegionBanks& region : regions) {
        for (int b = region.first; b < region.first + region.count; ++b) {
            if (b >= banks) return "a memory region lies beyond the last of " + std::to_string(banks) + " banks";
            if (owners[static_cast<std::size_t>(b)]++ != 0) return "two memory regions share bank " + std::to_string(b);
        }
    }
    const SdramTiming& t = c.memory.timing;
    const int window = t.precharge_to_activate * 2 + t.refresh_to_any + t.activate_to_column +
                       c.memory.load_words_per_window + t.write_to_precharge + 8;
    if (window * 2 > c.memory.maintenance_interval) {
        return "the maintenance window of about " + std::to_string(window) +
               " cycles takes more than half of memory/maintenance_interval; lower memory/load_words_per_window";
    }
    const int load_row = t.activate_to_column + c.memory.load_words_per_window + t.write_to_precharge;
    if (load_row < t.activate_to_precharge || load_row + t.precharge_to_activate < t.activate_to_activate) {
        return "memory/load_words_per_window is too small: a row would be closed before its minimum open time";
    }
    if (c.memory.load_words_per_window > 1 << c.memory.shape.column_bits) {
        return "memory/load_words_per_window is larger than a row of the memory";
    }
    if (std::string bad = bus_error(c.pci); !bad.empty()) return bad;
    const auto side = static_cast<std::uint64_t>(c.limits.image_buffer_side_px);
    const std::uint64_t image_words =
        2 * static_cast<std::uint64_t>(c.limits.views_per_cycle) * side * ((side + 1) / 2);
    if (r.images.count % r.image_parts != 0)
        return "memory/images/count is odd: each image buffer has banks of its own";
    if (image_words > c.memory.shape.words_per_bank() * static_cast<std::uint64_t>(r.images.count)) {
        return "the two image buffers do not fit the banks of memory/images";
    }
    return {};
}

BoardConfig with_memory(BoardConfig config) {
    config.limits.memory_bytes = config.memory.shape.words() * 8;
    return config;
}

// JSON objects of a configuration by path, such as "memory/alpha".
class JsonObjects {
public:
    explicit JsonObjects(JsonObject& top) : top_(top) {}

    // Null if the text has none.
    JsonObject* at(const std::string& path) {
        if (path.empty()) return &top_;
        const auto [known, is_new] = by_path_.try_emplace(path);
        if (is_new) {
            const std::size_t slash = path.rfind('/');
            JsonObject* const parent = at(slash == std::string::npos ? "" : path.substr(0, slash));
            const auto value = parent == nullptr ? std::nullopt : parent->find(path.substr(slash + 1));
            if (value) known->second.emplace(*value);
        }
        return known->second ? &*known->second : nullptr;
    }
    void expect_no_unknown_keys() const {
        for (const auto& [path, object] : by_path_) {
            if (object) object->expect_no_unknown_keys();
        }
    }

private:
    JsonObject& top_;
    std::map<std::string, std::optional<JsonObject>> by_path_;
};

Json to_json(const BoardConfig& config) {
    Json json = Json::object();
    for_each_number(config, [&](const std::string& path, const auto& value, int, int) {
        json[Json::json_pointer("/" + path)] = value;
    });
    return json;
}

std::optional<BoardConfig> built_in(const std::string& name) {
    for (const BoardKindSettings& kind : kKinds) {
        if (name == kind.base) return kind.built_in();
    }
    for (const BusRemedy& remedy : kBusRemedies) {
        if (name == remedy.name) return remedy.config();
    }
    return std::nullopt;
}

// Keys of versions up to 0.41, where the bus clock was a ratio to the board's.
void refuse_former_keys(JsonObject& top, JsonObject* pci) {
    if (top.has("clock_period")) {
        throw top.take("clock_period").wrong("is no longer a key; remove it, and give the bus clock as pci.clock_mhz");
    }
    if (pci != nullptr && pci->has("period")) {
        throw pci->take("period").wrong("is no longer a key; give the bus clock as pci.clock_mhz: 33, 66 or 133");
    }
}

std::string listed_built_ins() {
    std::vector<std::string> names = built_in_configs();
    for (const BusRemedy& remedy : kBusRemedies) names.emplace_back(remedy.name);
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

}  // namespace

std::vector<std::string> built_in_configs() {
    std::vector<std::string> names;
    for (const BoardKindSettings& kind : kKinds) names.emplace_back(kind.base);
    return names;
}

std::vector<std::string> bus_remedy_configs() {
    std::vector<std::string> names;
    for (const BusRemedy& remedy : kBusRemedies) names.emplace_back(remedy.name);
    return names;
}

BoardConfig::Periods BoardConfig::clock_periods() const {
    const int board = pci.thirds_of_mhz();
    const int bus = 3 * clock_mhz;
    const int unit = std::gcd(board, bus);
    return {board / unit, bus / unit};
}

Result<BoardConfig> parse_board_config(const std::string& text, const std::string& where) {
    return read_json(text, where, [&](JsonObject& top) {
        std::string base = "prototype-2000";
        top.read("base", base);
        const std::optional<BoardConfig> known = built_in(base);
        if (!known) {
            throw top.take("base").wrong("\"" + base + "\" is no built-in configuration; give one of " +
                                         listed_built_ins());
        }
        BoardConfig config = *known;
        config.name = where;
        top.read("name", config.name);
        JsonObjects objects(top);
        refuse_former_keys(top, objects.at("pci"));
        for_each_number(config, [&](const std::string& path, auto& value, int least, int most) {
            const std::size_t slash = path.rfind('/');
            JsonObject* const object = objects.at(slash == std::string::npos ? "" : path.substr(0, slash));
            const auto given = object == nullptr ? std::nullopt : object->find(path.substr(slash + 1));
            if (given) value = static_cast<std::remove_reference_t<decltype(value)>>(given->whole_number(least, most));
        });
        objects.expect_no_unknown_keys();
        if (const std::string bad = cross_field_error(config); !bad.empty()) throw top.wrong(bad);
        return with_memory(std::move(config));
    });
}

Result<BoardConfig> read_board_config(const std::string& name_or_path) {
    if (std::optional<BoardConfig> known = built_in(name_or_path)) return with_memory(*std::move(known));
    constexpr std::uint64_t kCap_bytes = 1 << 20;
    if (!std::filesystem::exists(name_or_path)) {
        return Error{name_or_path + ": neither a built-in configuration (" + listed_built_ins() + ") nor a file"};
    }
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(name_or_path, kCap_bytes));
    return parse_board_config(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name_or_path);
}

std::string board_config_json(const BoardConfig& config) {
    Json json = to_json(config);
    json["name"] = config.name;
    json["base"] = kind_of(config).base;
    return json.dump(2);
}

}  // namespace rs::engine::model
