#include "capture/tools/commands.hpp"

#include "capture/calibration/board/board_sheet.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace rs::capture {
namespace {

struct BoardCommandLine {
    std::filesystem::path output;
    std::string squares = "9x9";
    SheetOptions sheet;
};

// Checks one key of parse_board_design(), so that the command and import's --board accept the same values.
CLI::Validator board_word(const std::string& key) {
    return {[key](std::string& text) {
                const Result<BoardDesign> parsed = parse_board_design(key + "=" + text);
                return parsed ? std::string() : parsed.error().message;
            },
            ""};
}

Status run_board(const BoardCommandLine& given) {
    RS_TRY(write_board(given.output, given.sheet));
    const BoardDesign& design = given.sheet.design;
    std::printf("%s: %dx%d squares of %g mm (%g x %g mm); for import: --board %s\n", given.output.string().c_str(),
                design.squares_x, design.squares_y, design.square_mm, design.squares_x * design.square_mm,
                design.squares_y * design.square_mm, to_string(design).c_str());
    return {};
}

}  // namespace

void add_board_command(CLI::App& app, std::function<Status()>& run) {
    auto given = std::make_shared<BoardCommandLine>();
    BoardDesign& design = given->sheet.design;
    CLI::App* command = app.add_subcommand("board", "Prints a calibration board to lay on the turntable");
    command->add_option("-o,--output", given->output, "File to write: .pdf, .svg or .png")->required();
    command->add_option("--squares", given->squares, "Squares across and down: 9 or 9x7")
        ->check(board_word("dictionary=5x5_1000,squares"))
        ->capture_default_str();
    command->add_option("--square-mm", design.square_mm, "Side of a square in millimetres")
        ->check(board_word("square-mm"))
        ->capture_default_str();
    command->add_option("--marker", design.marker_share, "Side of a marker as a share of the square's")
        ->check(board_word("marker"))
        ->capture_default_str();
    command->add_option("--dictionary", design.dictionary, "ArUco dictionary: 4x4_50 .. 5x5_1000")
        ->capture_default_str();
    command->add_option("--blank-mm", design.blank_mm,
                        "Omit the squares that touch a central disc of this diameter, on which the object "
                        "is placed (default: none)");
    command->add_option("--paper", given->sheet.paper, "Sheet of the PDF")
        ->check(CLI::IsMember(paper_names()))
        ->capture_default_str();
    command->add_option("--dpi", given->sheet.dpi, "Pixels per inch of the PNG")
        ->check(CLI::Range(20.0, 2400.0))
        ->capture_default_str();
    command->footer("Example: rs-capture board -o board.pdf --blank-mm 60");
    command->callback([given, &run] {
        // The values of the design depend on each other, so they are also checked together.
        BoardDesign& whole = given->sheet.design;
        const Result<BoardDesign> squares = parse_board_design("dictionary=5x5_1000,squares=" + given->squares);
        if (!squares) throw CLI::ValidationError("--squares", squares.error().message);
        whole.squares_x = squares->squares_x;
        whole.squares_y = squares->squares_y;
        if (Status valid = check_board_design(whole); !valid) throw CLI::ValidationError(valid.error().message);
        run = [given] { return run_board(*given); };
    });
}

}  // namespace rs::capture
