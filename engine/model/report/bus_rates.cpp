#include "engine/model/report/report.hpp"
#include "rayspace/base/printable.hpp"

namespace rs::engine::model {
namespace {

constexpr int kShowroomImages = 9;  // of the paper's figure 11
constexpr int kShowroomSide_px = 256;

std::string bus_name(const PciSettings& pci) {
    return std::string(pci.dedicated != 0     ? "dedicated"
                       : pci.clock_mhz == 133 ? "PCI-X"
                                              : "PCI") +
           ", " + std::to_string(pci.width_bits) + " bit, " + std::to_string(pci.clock_mhz) + " MHz" +
           (pci.compression > 1 ? ", images compressed " + std::to_string(pci.compression) + " : 1" : "");
}

std::string bus_row(const BoardConfig& config) {
    const int words = config.pci.image_words_per_burst();
    const BusRates rates = bus_rates(config, kShowroomImages, kShowroomSide_px);
    return "| `" + config.name + "` | " + bus_name(config.pci) + " | " + std::to_string(words * 8) + " bytes in " +
           std::to_string(HostBus::burst_clocks(config.pci, words)) + " clocks | " +
           format_fixed(rates.image_bytes_per_second / 1e6, 1) + " | " + format_fixed(rates.cycle_seconds * 1e3, 1) +
           " | " + format_fixed(1 / rates.cycle_seconds, 1) + " |\n";
}

}  // namespace

BusRates bus_rates(const BoardConfig& config, int images, int side_px) {
    const PciSettings& pci = config.pci;
    const double hz = pci.mhz() * 1e6;
    const int words = pci.image_words_per_burst();
    const auto side = static_cast<std::uint64_t>(side_px);
    const std::uint64_t image_words = side * ((side + 1) / 2);
    return {words * 8 * hz / HostBus::burst_clocks(pci, words),
            images * static_cast<double>(HostBus::image_clocks(pci, image_words)) / hz};
}

std::string bus_table() {
    std::vector<std::string> names = bus_remedy_configs();
    names.insert(names.begin(), "prototype-2000");
    names.emplace_back("parallel");
    std::string table =
        "| CONFIG | bus | burst | MByte/s of images | 9 images, ms | per second |\n|---|---|---|---|---|---|\n";
    for (const std::string& name : names) table += bus_row(read_board_config(name).value());
    return table;
}

}  // namespace rs::engine::model
