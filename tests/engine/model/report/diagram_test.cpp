// DIAGRAM.md equals the tables generated from the code; waveform and report have valid formats.

#include "engine/model/report/report.hpp"
#include "engine/model/report/waveform.hpp"
#include "tests/engine/model/board_test_objects.hpp"
#include "tests/support/temporary_folder.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace rs::engine::model {
namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(Diagram, ThePageContainsTheTablesOfTheCode) {
    const std::string page = text_of(std::filesystem::path(RAYSPACE_SOURCE_DIR) / "engine/model/DIAGRAM.md");
    for (const std::string& name : built_in_configs()) {
        const BoardTop board(*read_board_config(name));
        EXPECT_NE(page.find(diagram_tables(board)), std::string::npos)
            << "engine/model/DIAGRAM.md differs from rs-engine simulate " << name << " --diagram:\n"
            << diagram_tables(board);
    }
}

TEST(Diagram, ThePageContainsTheRatesOfTheBuses) {
    const std::string page = text_of(std::filesystem::path(RAYSPACE_SOURCE_DIR) / "engine/model/DIAGRAM.md");
    EXPECT_NE(page.find(bus_table()), std::string::npos)
        << "engine/model/DIAGRAM.md differs from rs-engine board --buses:\n"
        << bus_table();
}

// Every key of a configuration has a row with its unit, by the last part of its path.
TEST(Diagram, ThePageContainsTheUnitOfEveryConfigurationKey) {
    const std::string page = text_of(std::filesystem::path(RAYSPACE_SOURCE_DIR) / "engine/model/DIAGRAM.md");
    for (const std::string& name : built_in_configs()) {
        const nlohmann::json config = nlohmann::json::parse(board_config_json(*read_board_config(name))).flatten();
        for (const auto& [path, value] : config.items()) {
            const std::string key = path.substr(path.rfind('/') + 1);
            EXPECT_NE(page.find("`" + key + "`"), std::string::npos) << path << " has no unit in DIAGRAM.md";
        }
    }
}

void expect_one_block_at_each_end(const BoardTop& board) {
    std::map<std::string, int> readers;
    std::map<std::string, int> writers;
    std::set<std::string> names;
    for (const Domain domain : {Domain::board, Domain::pci}) {
        for (const Block* block : board.simulator.parts(domain).blocks) {
            for (const Port& port : block->ports())
                ++(port.direction == Port::Direction::in ? readers : writers)[port.fifo];
        }
        for (const FifoState* fifo : board.simulator.parts(domain).fifos) names.insert(fifo->name());
        for (const CrossingState* fifo : board.simulator.parts(domain).written) names.insert(fifo->name());
    }
    EXPECT_GE(names.size(), 25U);
    EXPECT_EQ(readers.size(), names.size());
    EXPECT_EQ(writers.size(), names.size());
    for (const std::string& name : names) {
        EXPECT_EQ(readers[name], 1) << name;
        EXPECT_EQ(writers[name], 1) << name;
    }
}

TEST(Diagram, EveryFifoHasOneBlockAtEachEnd) {
    for (const std::string& name : built_in_configs()) expect_one_block_at_each_end(BoardTop(*read_board_config(name)));
}

// The page shows one pipe for all, so all pipes must declare the same blocks and FIFOs.
TEST(Diagram, AllPipesDeclareTheSame) {
    const BoardTop board(*read_board_config("parallel"));
    std::map<std::string, std::set<std::string>> declared;
    std::map<std::string, int> counts;
    for (const Block* block : board.simulator.parts(Domain::board).blocks) {
        std::string all = block->timing();
        for (const Port& port : block->ports()) {
            if (name_without_pipe(block->name()) == block->name()) continue;
            all += " " + name_without_pipe(port.fifo) + " " + std::to_string(port.depth) + "x" +
                   std::to_string(port.width_bits);
        }
        declared[name_without_pipe(block->name())].insert(all);
        ++counts[name_without_pipe(block->name())];
    }
    for (const auto& [name, kinds] : declared) EXPECT_EQ(kinds.size(), 1U) << name;
    EXPECT_EQ(counts["texel_tags"], 16);
    EXPECT_EQ(counts["view_dispatcher"], 1);
    EXPECT_EQ(name_without_pipe("tiles_0"), "tiles_0");
    EXPECT_EQ(name_without_pipe("tiles_0_p12"), "tiles_0");
    EXPECT_EQ(name_without_pipe("_p"), "_p");
}

struct SmallRun {
    SmallRun()
        : object(rs::test::ring_object({.views = 8, .planes = 4, .x_cells = 16, .u_cells = 16})),
          board(test::prototype()) {
        slot = *board.place(object);
        view = *board.view(
            slot, *prepare_view(object, test::upright_at(0, 3.5, 0, 0.9, 20, 20), engine::TexelFilter::kBilinear));
    }
    RaySpaceObject object;
    Board board;
    int slot = 0;
    BoardView view;
};

TEST(Report, SharesAddUpAndTheJsonEqualsTheReport) {
    SmallRun small;
    const Result<BoardRun> run = small.board.render({{small.view}, {small.view}});
    ASSERT_TRUE(run.ok());
    const BoardReport report = make_report(small.board, *run);
    for (const BlockShare& block : report.rendering.blocks) {
        double sum = 0;
        for (std::size_t a = 0; a < kActivities; ++a) sum += block.share(static_cast<Activity>(a));
        EXPECT_NEAR(sum, 1, 1e-9) << block.name;
    }
    const nlohmann::json json = nlohmann::json::parse(report_json(report));
    EXPECT_EQ(json["pictures"], 2);
    EXPECT_EQ(json["memory_channel_0"]["clients"]["image_writer"]["bytes"], 2 * 20 * 10 * 8);
    EXPECT_EQ(json["rendering"]["limiting_block"], report.rendering.limiting_block);
    const std::string svg = report_chart_svg(report, "a < b");
    EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
    EXPECT_NE(svg.find("memory_controller"), std::string::npos);
    EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
}

// Reads the VCD like a viewer: only declared signals, increasing times, values of the declared width.
TEST(Waveform, IsAValidVcd) {
    const rs::test::TemporaryFolder scratch;
    SmallRun small;
    auto wave = Waveform::open(scratch / "run.vcd", small.board.top(), 500);
    ASSERT_TRUE(wave.ok());
    ASSERT_TRUE(small.board.render({{small.view}}).ok());
    ASSERT_TRUE((*wave)->finish().ok());

    std::istringstream file(text_of(scratch / "run.vcd"));
    std::map<std::string, int> widths;
    std::uint64_t time = 0;
    int changes = 0;
    int times = 0;
    int scopes = 0;
    bool defined = false;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string first;
        words >> first;
        if (!defined) {
            if (first == "$var") {
                std::string kind, id, name;
                int bits = 0;
                words >> kind >> bits >> id >> name;
                EXPECT_TRUE(widths.emplace(id, bits).second) << id;
            }
            scopes += first == "$scope" ? 1 : first == "$upscope" ? -1 : 0;
            defined = first == "$enddefinitions";
        } else if (first[0] == '#') {
            const std::uint64_t next = std::stoull(first.substr(1));
            EXPECT_TRUE(times == 0 || next > time);
            time = next;
            ++times;
        } else if (first[0] == 'b') {
            std::string id;
            words >> id;
            ASSERT_TRUE(widths.count(id)) << line;
            EXPECT_EQ(static_cast<int>(first.size()) - 1, widths[id]);
            ++changes;
        } else {
            ASSERT_TRUE(widths.count(first.substr(1))) << line;
            EXPECT_EQ(widths[first.substr(1)], 1);
            ++changes;
        }
    }
    EXPECT_EQ(scopes, 0);
    EXPECT_EQ(times, 2 * 500);
    EXPECT_EQ(time, 499U * 25'000 + 12'500);
    EXPECT_GT(changes, 1000);  // the clock makes 1000 of them
}

}  // namespace
}  // namespace rs::engine::model
