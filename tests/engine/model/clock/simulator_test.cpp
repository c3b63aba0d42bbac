// Edges of the two clocks.

#include "engine/model/clock/simulator.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace rs::engine::model {
namespace {

// Records the edges of its clock in the order in which all blocks are ticked.
class EdgeRecorder final : public Block {
public:
    EdgeRecorder(const std::string& name, std::string& edges) : Block(name, ""), edges_(edges) {}
    Activity tick(std::uint64_t) override {
        edges_ += name();
        return Activity::busy;
    }
    [[nodiscard]] std::string state_text() const override { return {}; }

private:
    std::string& edges_;
};

std::string edges_of(int board_period, int bus_period, int steps) {
    Simulator simulator({.board_period = board_period, .pci_period = bus_period});
    std::string edges;
    EdgeRecorder board("B", edges);
    EdgeRecorder bus("p", edges);
    simulator.add(Domain::board, board);
    simulator.add(Domain::pci, bus);
    for (int n = 0; n < steps; ++n) simulator.step();
    return edges;
}

TEST(Simulator, ClocksOfAnyRatioAreTickedInTheOrderOfTime) {
    EXPECT_EQ(edges_of(5, 6, 7), "BBpBpBpBpBpB");  // 40 and 33 MHz: five edges of the bus for six
    EXPECT_EQ(edges_of(1, 1, 3), "BpBpBp");
    EXPECT_EQ(edges_of(10, 3, 3), "BpppBpppBpppp");  // 40 and 133 MHz
}

}  // namespace
}  // namespace rs::engine::model
